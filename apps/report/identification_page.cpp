// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/identification_page.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>
#include <filesystem>

#include "file_kinds.h"
#include "report/field_pictures.h"
#include "report/fit_plots.h"
#include "report/html.h"
#include "report/identification_tables.h"
#include "report/measured_picture.h"
#include "report/page_parts.h"
#include "terminal.h"

namespace palpate::app {
namespace {

constexpr double kStrong = 0.9;  ///< correlation of what is hard to tell apart
constexpr double kVague = 0.1;   ///< deviation of it, over its value

bool isCorrection(vtkPolyData* model) {
  return model->GetFieldData()->GetArray("PriorHoldOutError");
}

std::string titleOf(vtkPolyData* model, const RunDescription& run) {
  const std::string stem = std::filesystem::path(run["input"]).stem().string();
  return stem +
         (isCorrection(model) ? ": corrected by measurements" : ": identified from measurements");
}

/// What is measured in which units.
std::string subtitle(const RunDescription& run) {
  return "<p>Body " + html::escaped(fileName(run["input"])) + ", model " +
         html::escaped(fileName(run["output"])) + ", measurements " +
         html::escaped(fileName(run["--measurements"])) + " (lengths in " +
         html::escaped(run["--length-unit"]) + ", forces in " + html::escaped(run["--force-unit"]) +
         "). This page is in metres, newtons and pascals, or as it says.</p>\n";
}

std::string lead(vtkPolyData* model, const MeasuredData& data) {
  const std::vector<std::string> names = fieldStrings(model, "IdentifiedNames"),
                                 units = fieldStrings(model, "IdentifiedUnits");
  std::string text = "<p class=\"lead\">From " + std::to_string(data.readings.size()) +
                     " displacements under " + std::to_string(data.probes.size()) + " probes: ";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto value = [&](int c) { return fieldComponentAt(model, "IdentifiedParameters", i, c); };
    text += (i > 0 ? ", " : "") + html::escaped(names[i]) + " <b>" + number(value(0)) + "</b>" +
            (value(1) > 0 ? " ± " + number(value(1), 2) : "") +
            (units[i].empty() ? "" : " " + html::escaped(units[i]));
  }
  const double error = fieldNumber(model, "HoldOutError", -1);
  if (error >= 0)
    text += ". Displacements under probes that it was not made from are predicted within <b>" +
            percent(error) + "</b>, noise and all";
  return text + ".</p>\n";
}

std::string identified(vtkPolyData* model) {
  std::string text = "<h2>What was found</h2>\n" + parameterTable(model) + correlationTable(model);
  if (isCorrection(model))
    return text +
           "<p>The prior's compliance was multiplied by that factor, and what it does not "
           "explain was corrected with a smoothing of " +
           number(fieldNumber(model, "CorrectionSmoothing", -1), 3) +
           " (noise over correction, variances).</p>\n";
  text += "<p>Deviations and intervals are those that the noise of the measurements makes";
  if (lacksFit(model))
    text += " <b>and too small here</b>, as the model differs from the body by more (below)";
  const double error = fieldNumber(model, "ErrorEstimate", -1);
  const std::string off = offByMeshText(model);
  text += !off.empty() ? "; the mesh makes too large <b>" + html::escaped(off) + "</b>"
          : error >= 0 ? "; the mesh may add <b>" + percent(error) + "</b> to Young's modulus"
                       : "; what the mesh adds was not estimated: compare with a finer one";
  text += ".";
  if (const double length = fieldNumber(model, "SupportYieldLength", 0); length > 0)
    text += " The support yields like an elastic foundation of E / " + number(length) + " m.";
  if (const double distance = fieldNumber(model, "RegistrationDistance", -1); distance >= 0)
    text += " After registration, by a turn of " + registrationText(model).turn +
            " degrees about x, y, z and a shift of " + registrationText(model).shift +
            " m, places are " + number(distance, 3) + " m (rms) off the surface; " +
            html::escaped(registrationShareText(model)) + ".";
  return text + "</p>\n";
}

/// Whether the deviation of a number is more than a tenth of it.
bool isVague(vtkPolyData* model, std::size_t parameter) {
  const auto value = [&](int c) {
    return fieldComponentAt(model, "IdentifiedParameters", parameter, c);
  };
  return value(1) > kVague * std::abs(value(0));
}

/// Pairs that are hard to tell apart: as good as one number, of which little is known.
std::vector<std::string> confusions(vtkPolyData* model) {
  const std::vector<std::string> names = fieldStrings(model, "IdentifiedNames");
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double correlation =
          fieldComponentAt(model, "IdentifiedCorrelations", i, static_cast<int>(j));
      if (std::abs(correlation) >= kStrong && (isVague(model, i) || isVague(model, j)))
        sentences.push_back("the data hardly tell " + names[i] + " from " + names[j] +
                            ": their correlation is " + number(correlation, 2) +
                            ", so that what one is off by goes with what the other is");
    }
  return sentences;
}

std::string observability(vtkPolyData* model, bool hasField) {
  std::vector<std::string> unseen, others;
  for (const std::string& warning : fieldStrings(model, "Warnings"))
    (warning.rfind("the data ", 0) == 0 ? unseen : others).push_back(warning);
  for (const std::string& sentence : confusions(model)) unseen.push_back(sentence);
  std::string text = "<h2>What the data cannot see</h2>\n";
  if (hasField)
    text += "<p>The data determine <b>" + number(fieldNumber(model, "DeterminedUnknowns", 0), 3) +
            "</b> of the field's unknowns; the others stay as they were expected.</p>\n";
  else if (unseen.empty() && !isCorrection(model))
    text += "<p>The data tell all that was looked for.</p>\n";
  else if (isCorrection(model))
    text += "<p>Far from the probes the corrected model is the prior times its factor.</p>\n";
  text += listOf(unseen) + proposalTable(model);
  if (!others.empty()) text += "<p>Also:</p>\n" + listOf(others);
  return text;
}

std::vector<ProposedProbe> proposalsOf(vtkPolyData* model) {
  std::vector<ProposedProbe> probes;
  vtkDataArray* vertices = model->GetFieldData()->GetArray("NextProbeVertex");
  if (!vertices) return probes;
  const SurfacePlaces places(model);
  for (vtkIdType i = 0; i < vertices->GetNumberOfTuples(); ++i) {
    ProposedProbe probe{places.atVertex(static_cast<int>(vertices->GetComponent(i, 0))),
                        {},
                        "next " + std::to_string(i + 1)};
    model->GetFieldData()->GetArray("NextProbeForce")->GetTuple(i, probe.force.data());
    probes.push_back(probe);
  }
  return probes;
}

std::string places(vtkPolyData* model, const MeasuredData& data) {
  const std::vector<ProposedProbe> proposed = proposalsOf(model);
  std::string caption =
      "Arrows are the forces of the probes, balls the markers; both are coloured by the root mean "
      "square of their residuals' components. ";
  if (fieldStrings(model, "ProbeNames").size() > 1)
    caption += "A marker's is over all probes that it was seen under. ";
  caption += "Red rings are around markers with outliers, which do not count; ";
  if (!proposed.empty()) caption += "dark arrows are probes that would tell most next; ";
  caption += "what is blue is held.";
  return "<h2>Where it was measured</h2>\n" +
         figure(drawn(measuredPicture(model, data, proposed), "probes and markers"), caption) +
         probeTable(data);
}

std::string fit(vtkPolyData* model, const MeasuredData& data, const RunDescription& run) {
  std::string text =
      "<h2>How it fits</h2>\n<p>A residual's component has a standard deviation of " +
      number(fieldNumber(model, "MeasurementNoise", -1), 3) + " m";
  if (const double misfit = fieldNumber(model, "MeasurementMisfit", -1); misfit >= 0)
    text += ", " + number(misfit, 3) + " times that given";
  if (!isCorrection(model)) text += "; residuals of neighbouring markers: " + neighboursText(model);
  const bool isPolydata = isTableInArrays(run["--measurements"]);
  return text + ".</p>\n" + predictionPlot(data) + residualPlot(data) +
         outlierTable(data, isPolydata ? "tuple" : "line");
}

/// What was chosen among.
std::string triedTable(vtkPolyData* model) {
  const std::vector<std::string> names = fieldStrings(model, "TriedModels");
  if (names.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double error = fieldComponentAt(model, "TriedHoldOutErrors", i);
    rows.push_back({html::escaped(names[i]), std::isnan(error) ? "none" : percent(error)});
  }
  return "<p>The simplest was taken that predicts probes left out about as well as any, by the "
         "same "
         "displacements of all:</p>\n" +
         html::table({"model", "error"}, rows);
}

std::string heldOut(vtkPolyData* model, const MeasuredData& data, const RunDescription& run) {
  const double error = fieldNumber(model, "HoldOutError", -1),
               prior = fieldNumber(model, "PriorHoldOutError", -1);
  std::string text = "<h2>Probes left out</h2>\n<p>";
  if (error < 0) return text + "There was no cross-validation.</p>\n";
  text += "Cross-validation in " + run["--folds"] + " folds by " +
          (data.probes.size() > 1 ? "probes" : "markers") +
          ", each predicted by what was found from the others: off by <b>" + percent(error) +
          "</b> of the displacements, noise and all";
  if (prior >= 0) text += "; by the prior with one factor it is " + percent(prior);
  return text + ".</p>\n" + triedTable(model);
}

}  // namespace

std::string identificationPage(vtkPolyData* model, vtkUnstructuredGrid* field,
                               const RunDescription& run) {
  const MeasuredData data = measuredDataOf(model);
  const std::string title = titleOf(model, run);
  std::string body = "<h1>" + html::escaped(title) + "</h1>\n" + subtitle(run) + lead(model, data) +
                     identified(model) + observability(model, field);
  if (field) body += fieldText(model, field, fieldNumber(model, "FieldDeviation", 1));
  body += places(model, data) + fit(model, data, run) + heldOut(model, data, run) +
          "<h2>How it was made</h2>\n" + provenance(model, run);
  return html::page(title, body);
}

}  // namespace palpate::app
