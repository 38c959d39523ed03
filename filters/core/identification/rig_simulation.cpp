// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/rig_simulation.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <random>

#include "identification/measured_response.h"
#include "mesh/surface_locator.h"
#include "sentence.h"

namespace palpate {
namespace {

constexpr double kUsualDisplacement = 0.01;  // of the diagonal
constexpr int kMostRows = 1000000, kMostProbes = 1000;

/// Numbers that are the same on all platforms, unlike those of the standard's distributions.
class Chance {
 public:
  explicit Chance(unsigned seed) : engine_(seed) {}
  double uniform() { return engine_() / 4294967296.0; }  ///< 0 to below 1
  double normal() {
    const double size = std::sqrt(-2 * std::log(1 - uniform()));
    return size * std::cos(2 * M_PI * uniform());
  }
  Eigen::Vector3d normals() {
    const double x = normal(), y = normal(), z = normal();
    return {x, y, z};
  }

 private:
  std::mt19937 engine_;
};

void requireSense(const RigSettings& s) {
  const auto isShare = [](double share) { return share >= 0 && share < 1; };
  if (s.probes < 1 || s.markers < 1 || s.probes > kMostProbes ||
      s.probes > kMostRows / std::max(1, s.markers))
    refuse("a rig has 1 to ", kMostProbes, " probes, and markers, together up to ", kMostRows,
           " displacements, not ", s.probes, " and ", s.markers);
  if (!(s.foundationLength >= 0 && s.foundationLength < 1e6))
    refuse("the length by which a support yields must be from 0 to 1e6 m, not ",
           s.foundationLength);
  if (!(s.radius >= 0 && std::isfinite(s.radius)))
    refuse("the radius of a tip must not be negative, not ", s.radius);
  if (!(s.force >= 0 && s.force <= 1e12))
    refuse("the force must be from 0 to 1e12 N, not ", s.force);
  if (!(s.tilt >= 0 && s.tilt <= 90)) refuse("forces are tilted by 0 to 90 degrees, not ", s.tilt);
  if (!(s.noise >= 0 && s.noise < 1))
    refuse("the noise must be at least 0 and below 1, not ", s.noise);
  if (!isShare(s.outliers) || !isShare(s.missing))
    refuse("shares of outliers and missing displacements must be at least 0 and below 1, not ",
           s.outliers, " and ", s.missing);
  if (!(s.placeNoise >= 0 && std::isfinite(s.placeNoise)))
    refuse("the noise of places must not be negative, not ", s.placeNoise, " m");
  if (!s.rotation.allFinite() || !s.translation.allFinite())
    refuse("the rig's frame must be finite");
  if (s.withDeviations && s.noise == 0) refuse("without noise there are no standard deviations");
}

/// Triangles that can be pressed and looked at.
class FreeSurface {
 public:
  FreeSurface(const GreensFunctions& greens, const SurfaceMesh& mesh) : mesh_(mesh) {
    for (int t = 0; t < mesh.triangleCount(); ++t) {
      bool isFree = true;
      for (int vertex : mesh.triangles().col(t))
        isFree = isFree && !greens.isFixed(vertex) && greens.hasColumn(vertex);
      if (!isFree) continue;
      area_ += mesh.triangleAreas()[t];
      triangles_.push_back(t);
      upTo_.push_back(area_);
    }
    if (triangles_.empty()) refuse("no triangle is free all round: there is nothing to press on");
  }

  /// Evenly by area.
  SurfacePoint anywhere(Chance& chance) const {
    const double at = area_ * chance.uniform();
    const std::size_t found = std::min<std::size_t>(
        std::upper_bound(upTo_.begin(), upTo_.end(), at) - upTo_.begin(), upTo_.size() - 1);
    double a = chance.uniform(), b = chance.uniform();
    if (a + b > 1) {
      a = 1 - a;
      b = 1 - b;
    }
    return {triangles_[found], {1 - a - b, a, b}};
  }

  /// Far from each other: each the farthest of some from those before.
  std::vector<SurfacePoint> apart(int count, Chance& chance) const {
    std::vector<SurfacePoint> points{anywhere(chance)};
    while (int(points.size()) < count) {
      SurfacePoint best = points.front();
      double most = -1;
      for (int trial = 0; trial < 40; ++trial) {
        const SurfacePoint point = anywhere(chance);
        double nearest = INFINITY;
        for (const SurfacePoint& other : points)
          nearest = std::min(nearest, (placeOf(mesh_, point) - placeOf(mesh_, other)).norm());
        if (nearest > most) {
          most = nearest;
          best = point;
        }
      }
      points.push_back(best);
    }
    return points;
  }

 private:
  const SurfaceMesh& mesh_;
  double area_ = 0;
  std::vector<int> triangles_;
  std::vector<double> upTo_;
};

Eigen::Vector3d tilted(const Eigen::Vector3d& normal, double most, Chance& chance) {
  const double angle = most * M_PI / 180 * std::sqrt(chance.uniform()),
               turn = 2 * M_PI * chance.uniform();
  const Eigen::Vector3d across = normal.unitOrthogonal();
  return -std::cos(angle) * normal +
         std::sin(angle) * (std::cos(turn) * across + std::sin(turn) * normal.cross(across));
}

Eigen::Matrix3d turnBy(const Eigen::Vector3d& degrees) {
  const double angle = degrees.norm() * M_PI / 180;
  return angle > 0 ? Eigen::AngleAxisd(angle, degrees.normalized()).toRotationMatrix()
                   : Eigen::Matrix3d::Identity().eval();
}

/// Markers keep their place, as the rig tells it, under all probes.
void blur(Measurements& measurements, const RigSettings& s) {
  if (s.placeNoise == 0) return;
  Chance chance(s.seed + 1000003);  // so that all else stays as it is without
  std::vector<Eigen::Vector3d> shifts;
  for (int m = 0; m < s.markers; ++m) shifts.push_back(s.placeNoise * chance.normals());
  for (std::size_t i = 0; i < measurements.displacements.size(); ++i)
    measurements.displacements[i].marker.point += shifts[i % s.markers];
  for (Probe& probe : measurements.probes) probe.contact.point += s.placeNoise * chance.normals();
}

/// Noise, outliers, what is not seen, and the rig's own frame.
void spoil(Measurements& measurements, const RigSettings& s, double largest, Chance& chance) {
  const double deviation = s.noise * largest;
  const Eigen::Matrix3d turn = turnBy(s.rotation);
  std::vector<MeasuredDisplacement> seen;
  for (MeasuredDisplacement measured : measurements.displacements) {
    measured.displacement += deviation * chance.normals();
    if (chance.uniform() < s.outliers)
      measured.displacement += largest * (1 + chance.uniform()) * chance.normals().normalized();
    if (chance.uniform() < s.missing) continue;
    measured.displacement = turn * measured.displacement;
    measured.marker.point = turn * measured.marker.point + s.translation;
    if (s.withDeviations) measured.deviation.setConstant(deviation);
    measured.row = static_cast<int>(seen.size()) + 2;  // behind the names
    seen.push_back(measured);
  }
  measurements.displacements = std::move(seen);
  for (Probe& probe : measurements.probes) {
    probe.force = turn * probe.force;
    probe.contact.point = turn * probe.contact.point + s.translation;
  }
}

}  // namespace

Measurements simulateMeasurements(
    const GreensFunctions& greens, const SurfaceMesh& mesh,
    const std::function<SpreadForce(const SurfacePoint&, double radius)>& loadAt,
    const RigSettings& settings) {
  requireSense(settings);
  if (settings.radius > mesh.diagonal())
    refuse("a tip of radius ", settings.radius, " m is larger than the body, ", mesh.diagonal(),
           " m: are both in metres?");
  for (int node : greens.info().conditions.fixedNodes())
    if (settings.foundationLength > 0 && !greens.hasColumn(node))
      refuse("the Green's functions of the support (vertex ", node,
             ") were not computed, so that it cannot give way: precompute with "
             "--support-columns (in Python columns=np.arange(n))");
  Chance chance(settings.seed);
  const FreeSurface surface(greens, mesh);
  Measurements measurements;
  measurements.source = "simulated rig";
  MeasuredPlaces places;
  places.contacts = surface.apart(settings.probes, chance);
  std::vector<SpreadForce> loads;
  std::vector<SurfacePoint> markers;
  for (int m = 0; m < settings.markers; ++m) markers.push_back(surface.anywhere(chance));
  for (int p = 0; p < settings.probes; ++p) {
    const SurfacePoint& contact = places.contacts[p];
    Probe probe;
    probe.name = std::to_string(p + 1);
    probe.contact.point = placeOf(mesh, contact);
    probe.radius = settings.radius;
    probe.force = tilted(mesh.triangleNormals().col(contact.triangle), settings.tilt, chance);
    measurements.probes.push_back(probe);
    loads.push_back(loadAt(contact, settings.radius));
    for (const SurfacePoint& marker : markers) {
      MeasuredDisplacement measured;
      measured.probe = p;
      measured.marker.point = placeOf(mesh, marker);
      measurements.displacements.push_back(measured);
      places.markers.push_back(marker);
    }
  }
  const MeasuredResponse response(greens,
                                  measuredSetup(mesh, measurements, places, std::move(loads)),
                                  settings.foundationLength > 0);
  const Eigen::MatrixXd rows = response.onFoundation(settings.foundationLength, nullptr);
  double largest = 0;
  for (std::size_t i = 0; i < places.markers.size(); ++i) {
    MeasuredDisplacement& measured = measurements.displacements[i];
    measured.displacement = rows.middleRows<3>(3 * i) * measurements.probes[measured.probe].force;
    largest = std::max(largest, measured.displacement.cwiseAbs().maxCoeff());
  }
  if (!(largest > 0)) refuse("no marker moves under a force: more markers would see some");
  const double force =
      settings.force > 0 ? settings.force : kUsualDisplacement * mesh.diagonal() / largest;
  for (Probe& probe : measurements.probes) probe.force *= force;
  for (MeasuredDisplacement& measured : measurements.displacements) measured.displacement *= force;
  blur(measurements, settings);
  spoil(measurements, settings, force * largest, chance);
  if (measurements.displacements.empty()) refuse("of so few displacements all are missing");
  return measurements;
}

}  // namespace palpate
