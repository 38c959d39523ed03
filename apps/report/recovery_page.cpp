// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <filesystem>

#include "report/fit_plots.h"
#include "report/html.h"
#include "report/identification_page.h"
#include "report/identification_tables.h"
#include "report/measured_picture.h"
#include "report/page_parts.h"
#include "terminal.h"

namespace palpate::app {
namespace {

Eigen::Vector3d vectorAt(vtkPolyData* model, const char* name, vtkIdType tuple) {
  Eigen::Vector3d value;
  model->GetFieldData()->GetArray(name)->GetTuple(tuple, value.data());
  return value;
}

vtkIdType contactCount(vtkPolyData* model) {
  return model->GetFieldData()->GetArray("ContactForce")->GetNumberOfTuples();
}

std::string contactTable(vtkPolyData* model) {
  std::vector<std::vector<std::string>> rows;
  for (vtkIdType c = 0; c < contactCount(model); ++c) {
    const Eigen::Vector3d force = vectorAt(model, "ContactForce", c);
    rows.push_back({std::to_string(c + 1), number(force.norm()), vectorIn(force),
                    vectorIn(vectorAt(model, "ContactForceDeviation", c), 2),
                    vectorIn(vectorAt(model, "ContactCentre", c)),
                    number(fieldComponentAt(model, "ContactCentreDeviation", c), 2),
                    number(fieldComponentAt(model, "ContactPeakPressure", c)),
                    number(fieldComponentAt(model, "ContactPeak", c), 9),
                    number(fieldComponentAt(model, "ContactArea", c))});
  }
  const Eigen::Vector3d all = vectorAt(model, "RecoveredForce", 0);
  rows.push_back({"all together", number(all.norm()), vectorIn(all),
                  vectorIn(vectorAt(model, "RecoveredForceDeviation", 0), 2), "", "", "", "", ""});
  return html::table({"contact", "force, N", "its components, N", "± of these, N", "centre, m",
                      "± of its place, m", "largest pressure, Pa", "at vertex", "area, m²"},
                     rows);
}

/// A view turned to the side: of a force towards the eye or away from it no arrow would be seen.
Eigen::Vector3d aside(const Eigen::Vector3d& towards, const Eigen::Vector3d& force) {
  constexpr double kTurn = 0.6;  // rad
  const Eigen::Vector3d level = force.cross(Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d axis =
      (level.norm() > 0.1 * force.norm() ? force.cross(level) : Eigen::Vector3d::UnitX())
          .normalized();
  const Eigen::Vector3d one = Eigen::AngleAxisd(kTurn, axis) * towards,
                        other = Eigen::AngleAxisd(-kTurn, axis) * towards;
  return std::abs(one.dot(force)) < std::abs(other.dot(force)) ? one : other;
}

/// Pressures with the forces, and their deviations, from where the strongest contacts are seen.
std::string pressurePicture(vtkPolyData* model) {
  View pressure{model, "recovered pressure", "ContactPressure", "pressure\n(Pa)", false, {}};
  View deviation{
      model, "its standard deviation", "ContactPressureDeviation", "deviation\n(Pa)", false, {}};
  const SurfacePlaces places(model);
  double strongest = 0;
  for (vtkIdType c = 0; c < contactCount(model); ++c)
    strongest = std::max(strongest, vectorAt(model, "ContactForce", c).norm());
  Eigen::Vector3d towards(0, 0, 0), largest(0, 0, 0);
  for (vtkIdType c = 0; c < contactCount(model); ++c) {
    const Eigen::Vector3d force = vectorAt(model, "ContactForce", c);
    const double share = force.norm() / strongest;
    const PlaceOnSurface at = places.at(vectorAt(model, "ContactCentre", c));
    towards += share * at.normal;
    if (share == 1) largest = force;
    Glyph arrow = forceArrow(at, force, share, places.diagonal());
    arrow.label = std::to_string(c + 1);
    pressure.glyphs.push_back(arrow);
  }
  towards = aside(towards, largest);
  const Picture picture{{pressure, deviation}, {towards.x(), towards.y(), towards.z()}};
  return figure(drawn(picture, "recovered pressures"),
                "The pressures that explain the displacements, with the forces of the contacts, "
                "and how well noise lets them be known.");
}

std::string fit(vtkPolyData* model, const MeasuredData& data) {
  std::string text =
      "<h2>How it fits</h2>\n<p>A component of a residual has a standard deviation "
      "of " +
      number(fieldNumber(model, "ObservationNoise", -1), 3) + " m";
  if (const double misfit = fieldNumber(model, "ObservationMisfit", -1); misfit >= 0)
    text += ", " + number(misfit, 3) + " times that given";
  const double radius = fieldNumber(model, "LoadPatchRadius", 0);
  text += "; forces are spread over " +
          (radius > 0 ? "patches of " + number(radius, 3) + " m" : std::string("single vertices"));
  if (const double share = fieldNumber(model, "SupportYieldShare", 0); share > 0)
    text += "; the support yields otherwise than the model's, which makes " + percent(share) +
            " of the displacements";
  return text + ".</p>\n" +
         figure(drawn(measuredPicture(model, data, {}), "markers"),
                "Markers, coloured by the root mean square of their residuals' components; what is "
                "blue is held.") +
         predictionPlot(data) + residualPlot(data);
}

std::string warningsOf(vtkPolyData* model) {
  std::vector<std::string> warnings = fieldStrings(model, "RecoveryWarnings");
  for (const std::string& warning : fieldStrings(model, "Warnings")) warnings.push_back(warning);
  std::string text = listOf(warnings);
  if (const double error = fieldNumber(model, "ErrorEstimate", -1); error >= 0)
    text += "<p>The model's own error is " + percent(error) +
            ", which its mesh may add to forces.</p>\n";
  return text;
}

}  // namespace

std::string recoveryPage(vtkPolyData* model, const RunDescription& run) {
  const MeasuredData data = observedDataOf(model);
  const std::string title =
      std::filesystem::path(run["input"]).stem().string() + ": contacts from displacements";
  const vtkIdType count = contactCount(model);
  const std::string body =
      "<h1>" + html::escaped(title) + "</h1>\n<p>Model " + html::escaped(fileName(run["input"])) +
      ", displacements " + html::escaped(fileName(run["table"])) + " (lengths in " +
      html::escaped(run["--length-unit"]) +
      "). This page is in metres, newtons and pascals.</p>\n<p class=\"lead\">" +
      std::to_string(data.readings.size()) + " displacements tell <b>" + std::to_string(count) +
      (count == 1 ? " contact" : " contacts") + "</b>, together <b>" +
      number(vectorAt(model, "RecoveredForce", 0).norm()) +
      " N</b>.</p>\n<h2>What was found</h2>\n" + contactTable(model) + pressurePicture(model) +
      warningsOf(model) + fit(model, data) + "<h2>How it was made</h2>\n" + provenance(model, run);
  return html::page(title, body);
}

}  // namespace palpate::app
