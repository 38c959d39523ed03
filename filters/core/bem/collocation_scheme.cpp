// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <algorithm>
#include <Eigen/Geometry>

#include "bem/body_surface.h"
#include "bem/spatial_order.h"

namespace palpate::bem {
namespace {

/// Barycentric weight of the two far corners at a collocation point inside a triangle: near enough
/// to the vertex to serve it, far enough that the points of neighbouring vertices differ.
constexpr double kInteriorWeight = 0.2;

struct Corner {
  int triangle, corner;
};

std::vector<std::vector<Corner>> cornersOfVertices(const BodySurface& body) {
  std::vector<std::vector<Corner>> corners(body.vertexCount());
  for (int f = 0; f < body.triangleCount(); ++f)
    for (int k = 0; k < 3; ++k) corners[body.triangles(k, f)].push_back({f, k});
  return corners;
}

bool isWhollyFixed(const BodySurface& body, int f) {
  return body.fixed[body.triangles(0, f)] && body.fixed[body.triangles(1, f)] &&
         body.fixed[body.triangles(2, f)];
}

double cornerAngle(const BodySurface& body, const Corner& c) {
  const Eigen::Vector3d x = body.points.col(body.triangles(c.corner, c.triangle));
  const Eigen::Vector3d a = body.points.col(body.triangles((c.corner + 1) % 3, c.triangle)) - x;
  const Eigen::Vector3d b = body.points.col(body.triangles((c.corner + 2) % 3, c.triangle)) - x;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Eigen::Vector3d areaVector(const BodySurface& body, const std::vector<Corner>& corners,
                           const std::vector<int>& nodes) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Corner& c : corners)
    if (std::count(nodes.begin(), nodes.end(), body.nodes.ofCorner(c.corner, c.triangle)))
      sum += body.areas[c.triangle] / 3 * body.normals.col(c.triangle);
  return sum;
}

std::vector<int> allNodes(const BodySurface& body, int v) {
  std::vector<int> nodes;
  for (int node = body.nodes.first(v); node < body.nodes.end(v); ++node) nodes.push_back(node);
  return nodes;
}

CollocationPoint pointAtVertex(const BodySurface& body, int v, const std::vector<Corner>& corners) {
  CollocationPoint point{body.points.col(v), {}, v, areaVector(body, corners, allNodes(body, v))};
  for (const Corner& c : corners)
    point.own.push_back({c.triangle, Eigen::Vector3d::Unit(c.corner)});
  return point;
}

/// Inside the wholly fixed triangle of the patch that opens widest at the vertex.
CollocationPoint pointInPatch(const BodySurface& body, int v, const std::vector<Corner>& corners,
                              int node) {
  const Corner* best = nullptr;
  for (const Corner& c : corners)
    if (body.nodes.ofCorner(c.corner, c.triangle) == node && isWhollyFixed(body, c.triangle) &&
        (!best || cornerAngle(body, c) > cornerAngle(body, *best)))
      best = &c;
  Eigen::Vector3d barycentric = Eigen::Vector3d::Constant(kInteriorWeight);
  barycentric[best->corner] = 1 - 2 * kInteriorWeight;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k)
    position += barycentric[k] * body.points.col(body.triangles(k, best->triangle));
  return {position, {{best->triangle, barycentric}}, v, areaVector(body, corners, {node})};
}

}  // namespace

CollocationScheme::CollocationScheme(const BodySurface& body)
    : firstTraction(body.vertexCount(), -1) {
  const std::vector<std::vector<Corner>> corners = cornersOfVertices(body);
  std::vector<CollocationPoint> unordered;
  int extraColumns = 0;
  for (int v = 0; v < body.vertexCount(); ++v) {
    std::vector<int> unknownNodes;
    if (body.fixed[v])
      for (const Corner& c : corners[v])
        if (isWhollyFixed(body, c.triangle))
          unknownNodes.push_back(body.nodes.ofCorner(c.corner, c.triangle));
    std::sort(unknownNodes.begin(), unknownNodes.end());
    unknownNodes.erase(std::unique(unknownNodes.begin(), unknownNodes.end()), unknownNodes.end());

    if (body.fixed[v]) {
      firstTraction[v] = static_cast<int>(tractions.size());
      if (unknownNodes.empty()) tractions.push_back({v, allNodes(body, v), 0});
      for (int node : unknownNodes) tractions.push_back({v, {node}, 0});
      columnOfTraction.push_back(v);
      while (columnOfTraction.size() < tractions.size())
        columnOfTraction.push_back(body.vertexCount() + extraColumns++);
    }
    if (unknownNodes.size() < 2) {
      unordered.push_back(pointAtVertex(body, v, corners[v]));
    } else {
      Eigen::Vector3d rest = areaVector(body, corners[v], allNodes(body, v));
      const std::size_t firstPoint = unordered.size();
      for (int node : unknownNodes) {
        unordered.push_back(pointInPatch(body, v, corners[v], node));
        rest -= unordered.back().areaVector;
      }
      unordered[firstPoint].areaVector += rest;
    }
  }
  for (TractionUnknown& unknown : tractions)
    for (int node : unknown.nodes) unknown.area += body.nodes.area[node];

  Eigen::Matrix3Xd positions(3, unordered.size());
  for (std::size_t i = 0; i < unordered.size(); ++i) positions.col(i) = unordered[i].position;
  for (int i : spatialOrder(positions)) points.push_back(std::move(unordered[i]));
}

}  // namespace palpate::bem
