// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/measurement_file.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <ostream>

#include "sentence.h"
#include "text_lines.h"
#include "whole_file.h"

namespace palpate {
namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
constexpr double kMostVertices = 1e9;

enum Column {
  ProbeName,
  ContactVertex,
  ContactX,
  ContactY,
  ContactZ,
  Radius,
  ForceX,
  ForceY,
  ForceZ,
  Vertex,
  X,
  Y,
  Z,
  Ux,
  Uy,
  Uz,
  Sd,
  SdX,
  SdY,
  SdZ,
  ColumnCount,
};
constexpr const char* kNames[] = {"probe",     "contact_vertex",
                                  "contact_x", "contact_y",
                                  "contact_z", "radius",
                                  "force_x",   "force_y",
                                  "force_z",   "vertex",
                                  "x",         "y",
                                  "z",         "u_x",
                                  "u_y",       "u_z",
                                  "sd",        "sd_x",
                                  "sd_y",      "sd_z"};
static_assert(std::size(kNames) == ColumnCount);

std::string_view unquoted(std::string_view word) {
  const bool isQuoted = word.size() > 1 && word.front() == '"' && word.back() == '"';
  return isQuoted ? word.substr(1, word.size() - 2) : word;
}

std::string inSmallLetters(std::string_view word) {
  std::string small(word);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

/// One table on its way into Measurements.
class Table {
 public:
  Table(std::string_view text, const std::string& path, const MeasurementUnits& units,
        bool hasForces)
      : lines_(text, path), units_(units) {
    result_.source = path;
    result_.hasForces = hasForces;
    readNames();
    while (lines_.nextWith('#')) readLine();
  }

  Measurements result() { return std::move(result_); }

 private:
  bool has(Column column) const { return place_[column] >= 0; }
  bool hasAll(Column first) const {
    return has(first) && has(Column(first + 1)) && has(Column(first + 2));
  }
  bool hasAny(Column first) const {
    return has(first) || has(Column(first + 1)) || has(Column(first + 2));
  }

  void readNames();
  void requireColumns() const;
  void readLine();
  std::string_view word(Column column) const {
    return has(column) ? unquoted(words_[place_[column]]) : std::string_view();
  }
  double value(Column column, double unit) const { return unit * lines_.number(word(column)); }
  Eigen::Vector3d vector(Column first, double unit) const;
  RestPlace placeBy(Column vertex, Column x, const char* what) const;
  Probe probeHere(bool isNew, const Probe& before) const;
  void requireSame(const Probe& before, const Probe& here) const;
  double displacement(Column column) const;
  Eigen::Vector3d deviation() const;

  TextLines lines_;
  MeasurementUnits units_;
  char separator_ = ',';
  int place_[ColumnCount];
  std::size_t columnCount_ = 0;
  std::vector<std::string_view> words_;
  std::map<std::string, int, std::less<>> probes_;
  Measurements result_;
};

void Table::readNames() {
  std::fill(std::begin(place_), std::end(place_), -1);
  if (!lines_.nextWith('#')) lines_.refuse("there is no line of names");
  separator_ = separatorOf(lines_.line());
  // Single tabs leave room for gaps, several are but blanks.
  if (separator_ == ' ' && wordsOf(lines_.line(), '\t').size() == wordsOf(lines_.line()).size())
    separator_ = '\t';
  std::vector<std::string_view> names = wordsOf(lines_.line(), separator_);
  for (std::string_view& name : names) name = unquoted(name);
  columnCount_ = names.size();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = std::find(std::begin(kNames), std::end(kNames), inSmallLetters(names[i]));
    if (found == std::end(kNames))
      lines_.refuse("there is no column ", shown(names[i]),
                    ": the first line names those of probe, contact_vertex, contact_x .. _z, "
                    "radius, force_x .. _z, vertex, x .. z, u_x .. _z, sd, sd_x .. _z");
    int& place = place_[found - std::begin(kNames)];
    if (place >= 0) lines_.refuse("the column ", *found, " is there twice");
    place = static_cast<int>(i);
  }
  requireColumns();
}

void Table::requireColumns() const {
  const bool hasForces = result_.hasForces;
  if (hasForces && !has(ProbeName)) lines_.refuse("there is no column probe");
  if (hasForces && !has(ContactVertex) && !hasAll(ContactX))
    lines_.refuse(
        "where probes press is missing: contact_vertex, or contact_x, contact_y and "
        "contact_z");
  if (!has(Vertex) && !hasAll(X))
    lines_.refuse("where markers are is missing: vertex, or x, y and z");
  if (hasForces && !hasAll(ForceX))
    lines_.refuse("forces are missing: force_x, force_y and force_z");
  if (!hasAny(Ux)) lines_.refuse("displacements are missing: u_x, u_y and u_z");
  if (hasAny(SdX) && (has(Sd) || !hasAll(SdX)))
    lines_.refuse("standard deviations are sd, or sd_x, sd_y and sd_z");
}

Eigen::Vector3d Table::vector(Column first, double unit) const {
  return {value(first, unit), value(Column(first + 1), unit), value(Column(first + 2), unit)};
}

RestPlace Table::placeBy(Column vertex, Column x, const char* what) const {
  RestPlace place;
  if (!word(vertex).empty()) {
    place.vertex = static_cast<int>(lines_.wholeNumber(word(vertex), 0, kMostVertices));
    return place;
  }
  if (!hasAll(x)) lines_.refuse("the ", what, "'s vertex is missing");
  place.point = vector(x, units_.length);
  return place;
}

Probe Table::probeHere(bool isNew, const Probe& before) const {
  Probe probe = before;
  probe.name = std::string(word(ProbeName));
  if (!result_.hasForces) return probe;
  if (isNew || !word(ContactVertex).empty() || !word(ContactX).empty())
    probe.contact = placeBy(ContactVertex, ContactX, "contact");
  if (isNew || !word(ForceX).empty()) probe.force = vector(ForceX, units_.force);
  if (!word(Radius).empty()) probe.radius = value(Radius, units_.length);
  return probe;
}

void Table::requireSame(const Probe& before, const Probe& here) const {
  const auto differs = [&](const char* what) {
    lines_.refuse("the ", what, " of probe ", shown(here.name),
                  " differs from that in its first line: another ", what, " is another probe");
  };
  if (before.force != here.force) differs("force");
  if (before.radius != here.radius) differs("radius");
  if (before.contact.vertex != here.contact.vertex || before.contact.point != here.contact.point)
    differs("contact");
}

double Table::displacement(Column column) const {
  if (word(column).empty()) return kNotMeasured;
  const std::optional<double> value = numberOf(word(column));
  if (!value || !std::isfinite(*value))
    lines_.refuse(shown(word(column)), " is not a ", value ? "finite " : "", "number: where ",
                  kNames[column], " was not measured, ",
                  separator_ == ' ' ? "separate columns by commas and " : "", "leave it empty");
  return units_.length * *value;
}

Eigen::Vector3d Table::deviation() const {
  if (has(Sd) && !word(Sd).empty()) return Eigen::Vector3d::Constant(value(Sd, units_.length));
  if (hasAll(SdX) && !word(SdX).empty()) return vector(SdX, units_.length);
  return Eigen::Vector3d::Zero();
}

void Table::readLine() {
  words_ = wordsOf(lines_.line(), separator_);
  if (words_.size() != columnCount_)
    lines_.refuse("there are ", words_.size(), " words, but ", columnCount_, " columns",
                  separator_ == ' ' ? ": separate columns by commas where words are missing" : "");
  if (has(ProbeName) && word(ProbeName).empty()) lines_.refuse("the probe's name is missing");
  const auto known = probes_.find(word(ProbeName));
  const bool isNew = known == probes_.end();
  const int probe = isNew ? static_cast<int>(result_.probes.size()) : known->second;
  const Probe here = probeHere(isNew, isNew ? Probe() : result_.probes[probe]);
  if (isNew) {
    probes_.emplace(here.name, probe);
    result_.probes.push_back(here);
  } else {
    requireSame(result_.probes[probe], here);
  }
  MeasuredDisplacement measured;
  measured.probe = probe;
  measured.marker = placeBy(Vertex, X, "marker");
  for (int c = 0; c < 3; ++c) measured.displacement[c] = displacement(Column(Ux + c));
  measured.deviation = deviation();
  if (has(Sd) || has(SdX)) {
    if (word(has(Sd) ? Sd : SdX).empty())
      lines_.refuse("the standard deviation is missing: give all, or leave out the columns");
    if (!(measured.deviation.minCoeff() > 0))
      lines_.refuse("a standard deviation must be positive");
  }
  measured.row = static_cast<int>(lines_.lineNumber());
  result_.displacements.push_back(measured);
}

void writeNumber(std::ostream& out, double value) {
  if (!std::isnan(value)) out << value;
}

void writePlace(std::ostream& out, const RestPlace& place) {
  if (place.vertex >= 0)
    out << place.vertex << ",,,";
  else
    out << "," << place.point.x() << "," << place.point.y() << "," << place.point.z();
}

void requireUnits(const MeasurementUnits& units) {
  const auto isUnit = [](double unit) { return unit > 1e-30 && unit < 1e30; };
  if (!isUnit(units.length) || !isUnit(units.force))
    refuse("units must be positive, not ", units.length, " m and ", units.force, " N");
}

Measurements tableIn(const std::string& path, const MeasurementUnits& units, bool hasForces) {
  const std::string text = readBytes(path);
  Measurements measurements = Table(text, path, units, hasForces).result();
  requireSound(measurements);
  return measurements;
}

/// What tells of the probe, besides its name.
bool isOfProbe(int column) {
  return column >= ContactVertex && column <= ForceZ;
}

}  // namespace

Measurements readMeasurementFile(const std::string& path, const MeasurementUnits& units) {
  requireUnits(units);
  return tableIn(path, units, true);
}

Measurements readObservationFile(const std::string& path, double length) {
  requireUnits({length, 1});
  return tableIn(path, {length, 1}, false);
}

void writeMeasurementFile(const std::string& path, const Measurements& measurements) {
  writeWholeFile(path, [&](std::ostream& out) {
    const bool hasDeviations = measurements.hasDeviations();
    out.precision(17);
    for (int i = 0; i < (hasDeviations ? int(ColumnCount) : int(Sd)); ++i)
      if (i != Sd && (measurements.hasForces || !isOfProbe(i)))
        out << (i > 0 ? "," : "") << kNames[i];
    out << "\n";
    for (const MeasuredDisplacement& measured : measurements.displacements) {
      const Probe& probe = measurements.probes[measured.probe];
      out << probe.name << ",";
      if (measurements.hasForces) {
        writePlace(out, probe.contact);
        out << "," << probe.radius << "," << probe.force.x() << "," << probe.force.y() << ","
            << probe.force.z() << ",";
      }
      writePlace(out, measured.marker);
      for (double u : measured.displacement) {
        out << ",";
        writeNumber(out, u);
      }
      for (int c = 0; c < 3 && hasDeviations; ++c) out << "," << measured.deviation[c];
      out << "\n";
    }
  });
}

}  // namespace palpate
