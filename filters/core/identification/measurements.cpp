// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/measurements.h"

#include <cmath>
#include <map>
#include <memory>
#include <tuple>

#include "mesh/surface_locator.h"
#include "sentence.h"

namespace palpate {
namespace {

constexpr double kLargestDisplacement = 0.5;  // of the diagonal, as linear theory goes

std::string shownVector(const Eigen::Vector3d& v) {
  return sentence("(", shortly(v.x()), ", ", shortly(v.y()), ", ", shortly(v.z()), ")");
}

void requireFinite(const Measurements& all, const MeasuredDisplacement& measured) {
  const auto name = [&] { return all.nameOf(measured); };
  if (measured.probe < 0 || measured.probe >= int(all.probes.size()))
    refuse(name(), ": there is no probe ", measured.probe);
  if (measured.marker.vertex < 0 && !measured.marker.point.allFinite())
    refuse(name(), ": the marker's place ", shownVector(measured.marker.point), " is not finite");
  const Eigen::Vector3d& u = measured.displacement;
  if (u.array().isInf().any()) refuse(name(), ": the displacement is not finite");
  if (u.array().isNaN().all())
    refuse(name(), ": no component of the displacement was measured: leave the row out");
  const Eigen::Vector3d& deviation = measured.deviation;
  if (!deviation.allFinite() || deviation.minCoeff() < 0 ||
      (deviation.maxCoeff() > 0 && deviation.minCoeff() == 0))
    refuse(name(), ": standard deviations must be positive, not ", shownVector(deviation));
  if ((deviation.maxCoeff() > 0) != all.hasDeviations())
    refuse(name(), ": standard deviations are given of all displacements or of none");
}

void requireForce(const Probe& probe) {
  if (!probe.force.allFinite())
    refuse("probe ", probe.name, ": the force ", shownVector(probe.force), " is not finite");
  if (probe.force.isZero(0))
    refuse("probe ", probe.name, " has no force: what moves without one says nothing of the body");
  if (!(probe.radius >= 0 && std::isfinite(probe.radius)))
    refuse("probe ", probe.name, ": the radius must not be negative, not ", probe.radius);
  if (probe.contact.vertex < 0 && !probe.contact.point.allFinite())
    refuse("probe ", probe.name, ": the contact's place is not finite");
}

bool areSame(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  for (int c = 0; c < 3; ++c)
    if (a[c] != b[c] && !(std::isnan(a[c]) && std::isnan(b[c]))) return false;
  return true;
}

void requireOnce(const Measurements& all) {
  using Key = std::tuple<int, int, double, double, double>;
  std::map<Key, const MeasuredDisplacement*> first;
  for (const MeasuredDisplacement& measured : all.displacements) {
    const RestPlace& at = measured.marker;
    const Key key(measured.probe, at.vertex, at.vertex < 0 ? at.point.x() : 0,
                  at.vertex < 0 ? at.point.y() : 0, at.vertex < 0 ? at.point.z() : 0);
    const auto [found, isNew] = first.emplace(key, &measured);
    if (isNew) continue;
    if (areSame(found->second->displacement, measured.displacement))
      refuse(all.nameOf(measured), " repeats ", all.rowWord, " ", found->second->row,
             ": leave one of the two out");
    refuse(all.nameOf(measured), " and ", all.rowWord, " ", found->second->row,
           " give different displacements of one marker under probe ",
           all.probes[measured.probe].name,
           ": average them, or number the repetition as a probe of its own");
  }
}

/// Powers of ten between units of length that measurements are mistaken for.
constexpr double kUnits[] = {1e-3, 1e3, 1e-2, 1e2, 1e-6, 1e6, 0.0254};

/// Places of one kind, with their names.
class Locator {
 public:
  Locator(const SurfaceMesh& mesh, double tolerance)
      : mesh_(mesh),
        locator_(std::make_shared<SurfaceMesh>(mesh.points(), mesh.triangles(), mesh.rims())),
        tolerance_(tolerance) {
    if (!(tolerance >= 0))
      refuse("the tolerance of places must not be negative, but is ", tolerance, " m");
  }

  SurfacePoint at(const RestPlace& place, const std::string& name) const {
    if (place.vertex >= mesh_.vertexCount())
      refuse(name, ": there is no vertex ", place.vertex, ", the surface has ",
             mesh_.vertexCount());
    if (place.vertex >= 0) return cornerAt(place.vertex);
    const SurfacePoint nearest = locator_.nearest(place.point);
    const double distance = distanceOf(place.point);
    if (distance <= tolerance_) return nearest;
    refuse(name, ": the place ", shownVector(place.point), " is ", shortly(distance),
           " m off the surface (at most ", shortly(tolerance_), " m): ", cureFor(place.point));
  }

 private:
  SurfacePoint cornerAt(int vertex) const {
    SurfacePoint point{*mesh_.trianglesOfVertex(vertex).begin(), Eigen::Vector3d::Zero()};
    for (int k = 0; k < 3; ++k)
      point.barycentric[k] = mesh_.triangles()(k, point.triangle) == vertex;
    return point;
  }
  double distanceOf(const Eigen::Vector3d& place) const {
    return (placeOf(mesh_, locator_.nearest(place)) - place).norm();
  }
  std::string cureFor(const Eigen::Vector3d& place) const {
    for (double unit : kUnits)
      if (distanceOf(unit * place) <= tolerance_)
        return sentence("times ", unit,
                        " it would be on it, so the table's unit of length seems not to be that "
                        "which was given");
    return "register the measurements to the surface, or correct the place";
  }

  const SurfaceMesh& mesh_;
  SurfaceLocator locator_;
  double tolerance_;
};

void requireSmall(const SurfaceMesh& mesh, const Measurements& all) {
  const double most = kLargestDisplacement * mesh.diagonal();
  for (const MeasuredDisplacement& measured : all.displacements)
    for (double u : measured.displacement)
      if (std::abs(u) > most)
        refuse(all.nameOf(measured), ": a displacement of ", shortly(u), " m is ",
               shortly(std::abs(u) / mesh.diagonal()),
               " times the size of the body: check the table's unit of length");
}

}  // namespace

std::string Measurements::nameOf(const MeasuredDisplacement& measured) const {
  return sentence(source, ", ", rowWord, " ", measured.row);
}

int Measurements::valueCount() const {
  int count = 0;
  for (const MeasuredDisplacement& measured : displacements)
    for (double u : measured.displacement) count += !std::isnan(u);
  return count;
}

void requireSound(const Measurements& measurements) {
  if (measurements.displacements.empty())
    refuse(measurements.source, ": there is no measured displacement");
  for (const MeasuredDisplacement& measured : measurements.displacements)
    requireFinite(measurements, measured);
  if (measurements.hasForces)
    for (const Probe& probe : measurements.probes) requireForce(probe);
  requireOnce(measurements);
}

std::vector<SurfacePoint> markersOn(const SurfaceMesh& mesh, const Measurements& measurements,
                                    double tolerance) {
  const Locator locator(mesh, tolerance);
  std::vector<SurfacePoint> markers;
  for (const MeasuredDisplacement& measured : measurements.displacements)
    markers.push_back(locator.at(measured.marker, measurements.nameOf(measured)));
  requireSmall(mesh, measurements);
  return markers;
}

MeasuredPlaces placesOn(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                        const Measurements& measurements, double tolerance) {
  const Locator locator(mesh, tolerance);
  MeasuredPlaces places;
  for (const Probe& probe : measurements.probes) {
    places.contacts.push_back(locator.at(probe.contact, "probe " + probe.name));
    const SurfacePoint& contact = places.contacts.back();
    bool isFree = false;
    for (int k = 0; k < 3; ++k)
      isFree = isFree || (contact.barycentric[k] > 0 &&
                          !conditions.isFixed(mesh.triangles()(k, contact.triangle)));
    if (!isFree) refuse("probe ", probe.name, " presses on the support, where nothing gives way");
    if (probe.radius > mesh.diagonal())
      refuse("probe ", probe.name, ": a tip of radius ", shortly(probe.radius),
             " m is larger than the body, ", shortly(mesh.diagonal()),
             " m: check the table's unit of length");
  }
  places.markers = markersOn(mesh, measurements, tolerance);
  return places;
}

}  // namespace palpate
