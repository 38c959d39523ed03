// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/measured_picture.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace palpate::app {
namespace {

constexpr double kArrow = 0.14, kShortestArrow = 0.06;  ///< of diagonals
constexpr double kSeen = 0.15;  ///< cosine up to which a place is seen from aside
constexpr int kWidth = 620, kHeight = 560, kBar = 150;

std::array<double, 3> arrayOf(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// Markers at one place, under all probes.
struct MarkerFit {
  PlaceOnSurface at;
  double squares = 0;
  int count = 0;
  bool hasOutlier = false;
  void add(const Reading& reading) {
    at = reading.at;
    hasOutlier = hasOutlier || reading.isOutlier;
    if (reading.isOutlier) return;
    for (double residual : reading.residual)
      if (!std::isnan(residual)) {
        squares += residual * residual;
        ++count;
      }
  }
  double residual() const { return std::sqrt(squares / count); }
};

std::vector<MarkerFit> markersOf(const MeasuredData& data) {
  std::map<std::array<double, 3>, MarkerFit> byPlace;
  for (const Reading& reading : data.readings) byPlace[arrayOf(reading.at.place)].add(reading);
  std::vector<MarkerFit> markers;
  for (const auto& entry : byPlace) markers.push_back(entry.second);
  return markers;
}

/// One direction, or two where the first does not show every place.
std::vector<Eigen::Vector3d> directionsOnto(vtkPolyData* model,
                                            const std::vector<PlaceOnSurface>& places) {
  std::vector<Eigen::Vector3d> directions{
      Eigen::Vector3d(directionOntoFreeSurface(model).data()).stableNormalized()};
  Eigen::Vector3d hidden = Eigen::Vector3d::Zero();
  bool areAllSeen = true;
  for (const PlaceOnSurface& at : places) {
    if (at.normal.dot(directions[0]) >= kSeen) continue;
    areAllSeen = false;
    hidden += at.normal;
  }
  if (areAllSeen) return directions;
  const double size = hidden.norm();
  Eigen::Vector3d second = size > 1e-6 ? Eigen::Vector3d(hidden / size) : -directions[0];
  second += Eigen::Vector3d(0, 0, 0.2);
  directions.push_back(second.normalized());
  return directions;
}

/// Those that are alike as one, with all their names.
std::vector<ProposedProbe> withoutRepeats(const std::vector<ProposedProbe>& probes) {
  std::vector<ProposedProbe> result;
  for (const ProposedProbe& probe : probes) {
    const auto same = std::find_if(result.begin(), result.end(), [&](const ProposedProbe& other) {
      return other.at.place == probe.at.place && other.force == probe.force;
    });
    if (same == result.end())
      result.push_back(probe);
    else
      same->name += ", " + probe.name;
  }
  return result;
}

}  // namespace

Glyph forceArrow(const PlaceOnSurface& at, const Eigen::Vector3d& force, double share,
                 double diagonal) {
  const Eigen::Vector3d arrow =
      diagonal * std::max(kArrow * share, kShortestArrow) * force.normalized();
  const bool isPull = force.dot(at.normal) > 0;
  const Eigen::Vector3d foot = isPull ? at.place : Eigen::Vector3d(at.place - arrow);
  return {Glyph::Kind::Arrow, arrayOf(foot), arrayOf(arrow)};
}

Picture measuredPicture(vtkPolyData* model, const MeasuredData& data,
                        const std::vector<ProposedProbe>& proposed) {
  const std::vector<MarkerFit> markers = markersOf(data);
  std::vector<PlaceOnSurface> places;
  double most = 0, strongest = 0;
  for (const MarkerFit& marker : markers) {
    places.push_back(marker.at);
    if (marker.count > 0) most = std::max(most, marker.residual());
  }
  for (const ProbeReading& probe : data.probes) {
    places.push_back(probe.at);
    most = std::max(most, probe.residual);
    strongest = std::max(strongest, probe.force.norm());
  }
  for (const ProposedProbe& probe : proposed) {
    places.push_back(probe.at);
    strongest = std::max(strongest, probe.force.norm());
  }
  const LengthUnit unit = unitFor(most);
  const std::vector<Eigen::Vector3d> directions = directionsOnto(model, places);
  const auto arrowOf = [&](const PlaceOnSurface& at, const Eigen::Vector3d& force,
                           const std::string& name) {
    Glyph arrow = forceArrow(at, force, force.norm() / strongest, data.diagonal);
    arrow.label = name;
    return arrow;
  };

  Picture picture;
  for (const Eigen::Vector3d& direction : directions) {
    View view{model,
              !picture.views.empty() ? "from the other side"
              : data.probes.empty()  ? "markers"
                                     : "probes and markers",
              "",
              "residual,\nrms (" + unit.name + ")",
              false,
              std::array<double, 2>{0, unit.perMetre * most}};
    view.hasEdges = false;  // markers are hard to see among them
    view.towardsViewer = arrayOf(direction);
    view.glyphRadius =
        data.diagonal * std::clamp(0.25 / std::sqrt(double(markers.size())), 0.004, 0.01);
    picture.views.push_back(view);
  }
  for (const MarkerFit& marker : markers)
    for (View& view : picture.views) {
      const std::array<double, 3> place = arrayOf(marker.at.place);
      if (marker.count > 0)
        view.glyphs.push_back({Glyph::Kind::Ball, place, {}, unit.perMetre * marker.residual()});
      if (marker.hasOutlier) view.glyphs.push_back({Glyph::Kind::Ring, place});
    }
  // A probe in the view that shows it best.
  const auto viewOf = [&](const PlaceOnSurface& at) -> View& {
    const bool isBehind =
        directions.size() > 1 && at.normal.dot(directions[1]) > at.normal.dot(directions[0]);
    return picture.views[isBehind];
  };
  for (const ProbeReading& probe : data.probes) {
    Glyph arrow = arrowOf(probe.at, probe.force, probe.name);
    arrow.value = unit.perMetre * probe.residual;
    viewOf(probe.at).glyphs.push_back(arrow);
  }
  for (const ProposedProbe& probe : withoutRepeats(proposed))
    viewOf(probe.at).glyphs.push_back(arrowOf(probe.at, probe.force, probe.name));
  picture.width = kWidth * static_cast<int>(directions.size()) + kBar;
  picture.height = kHeight;
  picture.sharesBar = true;
  return picture;
}

}  // namespace palpate::app
