// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/identification_tables.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPolyData.h>
#include <vtkVariant.h>

#include <cmath>
#include <Eigen/Geometry>
#include <filesystem>

#include "report/html.h"
#include "report/page_parts.h"
#include "terminal.h"

namespace palpate::app {
namespace {

constexpr std::size_t kMostRows = 60;  ///< of a table

std::string withUnit(const std::string& name, const std::string& unit) {
  return html::escaped(name) + (unit.empty() ? "" : ", " + html::escaped(unit));
}

/// Ends a table that was cut short.
std::string moreText(std::size_t count, const std::string& what) {
  return count <= kMostRows
             ? ""
             : "<p>And " + std::to_string(count - kMostRows) + " more " + what + ".</p>\n";
}

}  // namespace

double fieldComponentAt(vtkPolyData* model, const char* name, std::size_t tuple, int component) {
  return model->GetFieldData()->GetArray(name)->GetComponent(static_cast<vtkIdType>(tuple),
                                                             component);
}

std::string vectorIn(const Eigen::Vector3d& v, int digits) {
  return "(" + number(v.x(), digits) + ", " + number(v.y(), digits) + ", " + number(v.z(), digits) +
         ")";
}

RegistrationText registrationText(vtkPolyData* model) {
  if (!model->GetFieldData()->GetArray("RegistrationDistance")) return {};
  constexpr double kDegrees = 180 / EIGEN_PI;
  const auto vector = [&](const char* name, int first) {
    Eigen::Vector3d v;
    for (int c = 0; c < 3; ++c) v[c] = fieldComponentAt(model, name, 0, first + c);
    return v;
  };
  Eigen::Matrix3d rotation;
  for (int row = 0; row < 3; ++row) rotation.row(row) = vector("RegistrationRotation", 3 * row);
  const Eigen::AngleAxisd turn(rotation);
  return {vectorIn(kDegrees * turn.angle() * turn.axis()) + " +- " +
              vectorIn(kDegrees * vector("RegistrationDeviation", 0), 2),
          vectorIn(vector("RegistrationTranslation", 0)) + " +- " +
              vectorIn(vector("RegistrationDeviation", 3), 2)};
}

std::string registrationShareText(vtkPolyData* model) {
  if (!model->GetFieldData()->GetArray("ParameterDeviationByRegistration"))
    return "what it leaves open is not in the intervals";
  const std::vector<std::string> names = fieldStrings(model, "IdentifiedNames"),
                                 units = fieldStrings(model, "IdentifiedUnits");
  std::string text = "what it leaves open is in the intervals:";
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i > 0 ? ", " : " ") + names[i] + " +- " +
            number(fieldComponentAt(model, "ParameterDeviationByRegistration", i), 2) +
            (units[i].empty() ? "" : " ") + units[i];
  return text;
}

std::string offByMeshText(vtkPolyData* model) {
  if (!model->GetFieldData()->GetArray("ParametersOffByMesh")) return {};
  const std::vector<std::string> names = fieldStrings(model, "IdentifiedNames"),
                                 units = fieldStrings(model, "IdentifiedUnits");
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i > 0 ? ", " : "") + names[i] + " by " +
            number(fieldComponentAt(model, "ParametersOffByMesh", i), 2) +
            (units[i].empty() ? "" : " ") + units[i];
  return text;
}

std::string neighboursText(vtkPolyData* model) {
  const auto value = [&](int c) { return fieldComponentAt(model, "NeighbourCorrelation", 0, c); };
  return "correlation " + number(value(0), 2) + ", as much in " + percent(value(1)) +
         " of tables of noise";
}

bool lacksFit(vtkPolyData* model) {
  for (const std::string& warning : fieldStrings(model, "Warnings"))
    if (warning.rfind("residuals of neighbouring markers", 0) == 0) return true;
  return false;
}

std::string fileName(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

std::string listOf(const std::vector<std::string>& sentences) {
  if (sentences.empty()) return {};
  std::string result = "<ul>\n";
  for (const std::string& sentence : sentences)
    result += "<li>" + html::escaped(sentence) + ".</li>\n";
  return result + "</ul>\n";
}

std::string parameterTable(vtkPolyData* model) {
  const std::vector<std::string> names = fieldStrings(model, "IdentifiedNames"),
                                 units = fieldStrings(model, "IdentifiedUnits");
  std::vector<std::string> head{"", "value", "standard deviation", "95 % from", "to"};
  if (lacksFit(model)) head.emplace_back("deviation by probes left out");
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto value = [&](int c) { return fieldComponentAt(model, "IdentifiedParameters", i, c); };
    const bool isKnown = value(1) > 0;
    rows.push_back({withUnit(names[i], units[i]), number(value(0)),
                    isKnown ? number(value(1), 2) : "–", isKnown ? number(value(2)) : "–",
                    isKnown ? number(value(3)) : "–"});
    if (!lacksFit(model)) continue;
    const double byProbes = fieldComponentAt(model, "ProbewiseDeviation", i);
    rows.back().push_back(byProbes >= 0 ? number(byProbes, 2) : "–");
  }
  return html::table(head, rows);
}

std::string correlationTable(vtkPolyData* model) {
  const std::vector<std::string> names = fieldStrings(model, "IdentifiedNames");
  if (names.size() < 2) return {};
  std::vector<std::string> head{"correlation"};
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < names.size(); ++i) {
    head.push_back(html::escaped(names[i]));
    rows.push_back({html::escaped(names[i])});
    for (std::size_t j = 0; j < names.size(); ++j)
      rows.back().push_back(
          number(fieldComponentAt(model, "IdentifiedCorrelations", i, static_cast<int>(j)), 2));
  }
  return html::table(head, rows);
}

std::string probeTable(const MeasuredData& data) {
  std::vector<std::vector<std::string>> rows;
  for (const ProbeReading& probe : data.probes) {
    if (rows.size() == kMostRows) break;
    rows.push_back({html::escaped(probe.name), vectorIn(probe.at.place), vectorIn(probe.force),
                    cell(probe.radius), std::to_string(probe.markers),
                    std::to_string(probe.outliers), number(probe.residual, 3),
                    percent(probe.relative)});
  }
  return html::table({"probe", "contact, m", "force, N", "radius, m", "markers", "outliers",
                      "residual, rms, m", "of displacements"},
                     rows) +
         moreText(data.probes.size(), "probes");
}

std::string outlierTable(const MeasuredData& data, const std::string& rowWord) {
  std::vector<std::vector<std::string>> rows;
  std::size_t count = 0;
  for (const Reading& reading : data.readings) {
    if (!reading.isOutlier || ++count > kMostRows) continue;
    double most = 0;
    for (int axis = 0; axis < 3; ++axis)
      if (reading.deviation[axis] > 0 && !std::isnan(reading.residual[axis]))
        most = std::max(most, std::abs(reading.residual[axis]) / reading.deviation[axis]);
    rows.push_back({std::to_string(reading.row), html::escaped(data.probes[reading.probe].name),
                    vectorIn(reading.at.place), vectorIn(reading.measured),
                    vectorIn(reading.measured - reading.residual), number(most, 3)});
  }
  if (count == 0) return "<p>No displacement is an outlier.</p>\n";
  return "<p>" + std::to_string(count) + " of " + std::to_string(data.readings.size()) +
         " displacements are outliers: they contradict the rest and were left out.</p>\n" +
         html::table({rowWord, "probe", "marker, m", "measured, m", "predicted, m",
                      "off by, standard deviations"},
                     rows) +
         moreText(count, "outliers");
}

std::string proposalTable(vtkPolyData* model) {
  vtkDataArray* vertices = model->GetFieldData()->GetArray("NextProbeVertex");
  if (!vertices) return {};
  const std::vector<std::string> names = fieldStrings(model, "IdentifiedNames"),
                                 units = fieldStrings(model, "IdentifiedUnits");
  std::vector<std::string> head{"probe", "vertex", "contact, m", "force, N"};
  for (std::size_t i = 0; i < names.size(); ++i)
    head.push_back("then ± of " + withUnit(names[i], units[i]));
  std::vector<std::vector<std::string>> rows;
  for (vtkIdType i = 0; i < vertices->GetNumberOfTuples(); ++i) {
    const auto vertex = static_cast<vtkIdType>(vertices->GetComponent(i, 0));
    Eigen::Vector3d force;
    model->GetFieldData()->GetArray("NextProbeForce")->GetTuple(i, force.data());
    rows.push_back({"next " + std::to_string(i + 1), std::to_string(vertex),
                    vectorIn(Eigen::Vector3d(model->GetPoint(vertex))), vectorIn(force)});
    for (std::size_t p = 0; p < names.size(); ++p)
      rows.back().push_back(
          number(fieldComponentAt(model, "NextProbeDeviations", i, static_cast<int>(p)), 2));
  }
  return "<p>Of the probes that could be measured next, these would tell most; each row counts "
         "those above it, too.</p>\n" +
         html::table(head, rows);
}

std::string provenance(vtkPolyData* model, const RunDescription& run) {
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const std::string& name, const std::string& value) {
    rows.push_back({name, html::escaped(value)});
  };
  for (const std::string& source : fieldStrings(model, "GreensFunctionSource"))
    add("made by", source);
  if (vtkDataArray* fingerprint = model->GetFieldData()->GetArray("MeshFingerprint"))
    add("mesh", std::to_string(model->GetNumberOfPoints()) + " vertices, fingerprint " +
                    fingerprint->GetVariantValue(0).ToString());
  add("seconds in all", number(run.seconds, 3));
  const std::vector<std::string> stages = fieldStrings(model, "StageNames");
  std::string seconds;
  for (std::size_t i = 0; i < stages.size(); ++i)
    seconds += (i > 0 ? ", " : "") + stages[i] + " " +
               number(fieldComponentAt(model, "StageSeconds", i), 3);
  if (!seconds.empty()) add("of them the final Green's functions", seconds);
  add("program", "Palpate " PALPATE_VERSION);
  for (const auto& [name, value] : run.settings) add(name, value);
  return "<div class=\"pairs\">" + html::table({"", ""}, rows) + "</div>\n";
}

}  // namespace palpate::app
