// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/points.h"

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "sentence.h"
#include "terminal.h"

namespace palpate::app {
namespace {

constexpr int kSpreadPoints = 4;
constexpr double kSupportWeight = 0.5;  ///< points keep twice as clear of it as of each other
constexpr double kRounding = 1 + 1e-9;  ///< a mask as wide as a distance fits

/// The ends of the edges that a sheet ends at.
std::vector<std::pair<int, int>> rimEdges(const SurfaceMesh& sheet) {
  std::map<std::pair<int, int>, int> triangles;  // of each edge
  for (const auto& corners : sheet.triangles().colwise())
    for (int k = 0; k < 3; ++k) ++triangles[std::minmax({corners[k], corners[(k + 1) % 3]})];
  std::vector<std::pair<int, int>> rims;
  for (const auto& [edge, count] : triangles)
    if (count == 1) rims.push_back(edge);
  return rims;
}

/// From the nearest rim, m.
double distanceFromRims(const SurfaceMesh& sheet, const std::vector<std::pair<int, int>>& rims,
                        const Eigen::Vector3d& place) {
  double distance = std::numeric_limits<double>::infinity();
  for (const auto& [first, second] : rims) {
    const Eigen::Vector3d from = sheet.points().col(first),
                          along = sheet.points().col(second) - from;
    const double at = std::clamp((place - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    distance = std::min(distance, (place - from - at * along).norm());
  }
  return distance;
}

/// Vertices that spread points are chosen from: free ones whose masks no rim cuts off.
std::vector<int> candidates(const BodyLevels& body, double radius) {
  const SurfaceMesh& mesh = body.mesh(1);
  const auto rims = rimEdges(mesh);
  std::vector<int> found;
  for (int v : body.conditions(1).freeNodes())
    if (radius <= kRounding * distanceFromRims(mesh, rims, mesh.points().col(v)))
      found.push_back(v);
  if (found.empty())
    refuse("no vertex of the first level is as far from the rims as masks of ", radius,
           " reach: give a smaller --radius, or points by --at");
  return found;
}

}  // namespace

std::vector<SurfacePoint> spreadPoints(const BodyLevels& body, double radius) {
  const Eigen::Matrix3Xd& places = body.mesh(1).points();
  std::vector<int> taken = body.conditions(1).fixedNodes();
  const std::vector<int> free = candidates(body, radius);
  const SurfaceMesh& finest = body.mesh(body.count());
  std::vector<SurfacePoint> points;
  while (points.size() < kSpreadPoints && points.size() < free.size()) {
    int farthest = free.front();
    double most = -1;
    for (int v : free) {
      double away = std::numeric_limits<double>::infinity();
      for (int w : taken)
        away = std::min(away, (body.conditions(1).isFixed(w) ? kSupportWeight : 1) *
                                  (places.col(v) - places.col(w)).norm());
      if (away > most) {
        most = away;
        farthest = v;
      }
    }
    taken.push_back(farthest);
    const int triangle = *finest.trianglesOfVertex(farthest).begin();
    SurfacePoint point{triangle, Eigen::Vector3d::Zero()};
    for (int k = 0; k < 3; ++k) point.barycentric[k] = finest.triangles()(k, triangle) == farthest;
    points.push_back(point);
  }
  return points;
}

std::vector<SurfacePoint> pointsAt(const BodyLevels& body, const std::vector<double>& places) {
  const SurfaceMesh &first = body.mesh(1), &finest = body.mesh(body.count());
  const double most = 0.25 * first.meanEdgeLength();
  std::vector<SurfacePoint> points;
  for (std::size_t i = 0; i + 2 < places.size(); i += 3) {
    const Eigen::Vector3d place(places[i], places[i + 1], places[i + 2]);
    if (!place.allFinite()) throw std::invalid_argument("a point must be three finite numbers");
    points.push_back(nearestSurfacePoint(finest, place));
    const double away =
        std::min((placeOf(finest, points.back()) - place).norm(),
                 (placeOf(first, nearestSurfacePoint(first, place)) - place).norm());
    if (away > most)
      throw std::invalid_argument("the point " + vectorText(place.data()) + " is " + number(away) +
                                  " off the surface, more than a quarter of its mean edge, " +
                                  number(most) + ": are both in the same unit?");
  }
  return points;
}

double widestWholeMask(const BodyLevels& body, const std::vector<LevelledPoint>& points) {
  const SurfaceMesh& mesh = body.mesh(1);
  const auto rims = rimEdges(mesh);
  double reach = std::numeric_limits<double>::infinity();
  for (const LevelledPoint& point : points)
    reach = std::min(reach, distanceFromRims(mesh, rims, placeOf(mesh, point.front())));
  return kRounding * reach;
}

}  // namespace palpate::app
