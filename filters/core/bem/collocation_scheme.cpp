// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/collocation_scheme.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>

#include "bem/spatial_order.h"

namespace palpate::bem {
namespace {

struct Corner {
  int triangle, corner;
  double share = 1;  ///< of the triangle that an equation stands for
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

/// The traction nodes of a fixed vertex that lie on wholly fixed triangles.
std::vector<int> nodesOfFixedTriangles(const BodySurface& body,
                                       const std::vector<Corner>& corners) {
  std::vector<int> nodes;
  for (const Corner& c : corners)
    if (isWhollyFixed(body, c.triangle)) nodes.push_back(body.nodes.ofCorner(c.corner, c.triangle));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// Makes collocation points once each and equations from them.
class EquationBuilder {
 public:
  EquationBuilder(const BodySurface& body, const std::vector<std::vector<Corner>>& corners,
                  CollocationScheme& scheme)
      : body_(body), corners_(corners), scheme_(scheme), centroidPoint_(body.triangleCount(), -1) {}

  /// The equation at the vertex itself.
  void addAtVertex(int v) {
    CollocationEquation equation = standingFor(v, corners_[v]);
    equation.terms = {{addPointAtVertex(v), 1}};
    scheme_.equations.push_back(std::move(equation));
  }

  /// Its mean under the vertex's hat.
  void addAverage(int v) {
    CollocationEquation equation = standingFor(v, corners_[v]);
    equation.terms = {{addPointAtVertex(v), 0.25}};
    for (const Corner& c : corners_[v])
      equation.terms.push_back(
          {pointAtCentroid(c.triangle), 0.75 * body_.areas[c.triangle] / (3 * equation.area)});
    scheme_.equations.push_back(std::move(equation));
  }

  /// Its mean over points inside some of the triangles around the vertex, the centres of mass of
  /// its hat there: each belongs to one vertex and one triangle alone, so that no two such
  /// equations are alike, however many patches meet.
  void addWithin(int v, const std::vector<Corner>& over) {
    CollocationEquation equation = standingFor(v, over);
    for (const Corner& c : over) {
      Eigen::Vector3d barycentric = Eigen::Vector3d::Constant(0.25);
      barycentric[c.corner] = 0.5;
      Eigen::Vector3d place = Eigen::Vector3d::Zero();
      for (int k = 0; k < 3; ++k)
        place += barycentric[k] * body_.points.col(body_.triangles(k, c.triangle));
      equation.terms.push_back({static_cast<int>(scheme_.points.size()),
                                c.share * body_.areas[c.triangle] / (3 * equation.area)});
      scheme_.points.push_back({place, {{c.triangle, barycentric}}});
    }
    scheme_.equations.push_back(std::move(equation));
  }

 private:
  CollocationEquation standingFor(int v, const std::vector<Corner>& corners) const {
    CollocationEquation equation{{}, v, 0, Eigen::Vector3d::Zero()};
    for (const Corner& c : corners) {
      const double area = c.share * body_.areas[c.triangle] / 3;
      equation.area += area;
      equation.areaVector += area * body_.normals.col(c.triangle);
    }
    return equation;
  }

  int addPointAtVertex(int v) {
    CollocationPoint point{body_.points.col(v), {}};
    for (const Corner& c : corners_[v])
      point.own.push_back({c.triangle, Eigen::Vector3d::Unit(c.corner)});
    scheme_.points.push_back(std::move(point));
    return static_cast<int>(scheme_.points.size()) - 1;
  }

  int pointAtCentroid(int f) {
    if (centroidPoint_[f] < 0) {
      centroidPoint_[f] = static_cast<int>(scheme_.points.size());
      scheme_.points.push_back({body_.centroid(f), {{f, Eigen::Vector3d::Constant(1.0 / 3)}}});
    }
    return centroidPoint_[f];
  }

  const BodySurface& body_;
  const std::vector<std::vector<Corner>>& corners_;
  CollocationScheme& scheme_;
  std::vector<int> centroidPoint_;  // of each triangle; three equations share it
};

}  // namespace

CollocationScheme::CollocationScheme(const BodySurface& body, Collocation kindOfCollocation)
    : kind(kindOfCollocation) {
  const std::vector<std::vector<Corner>> corners = cornersOfVertices(body);
  EquationBuilder builder(body, corners, *this);
  int nextColumn = body.vertexCount();
  for (int v = 0; v < body.vertexCount(); ++v) {
    std::vector<int> unknown;
    if (body.fixed[v]) {
      unknown = nodesOfFixedTriangles(body, corners[v]);
      if (unknown.empty()) tractions.push_back({v, body.nodes.ofVertex(v), 0, v, 1});
      for (std::size_t i = 0; i < unknown.size(); ++i)
        tractions.push_back({v, {unknown[i]}, 0, i == 0 ? v : nextColumn++, 1});
    }
    if (unknown.size() < 2) {
      if (kind == Collocation::Vertex)
        builder.addAtVertex(v);
      else
        builder.addAverage(v);
      continue;
    }
    for (int node : unknown) {
      std::vector<Corner> over;
      for (const Corner& c : corners[v]) {
        const int other = body.nodes.ofCorner(c.corner, c.triangle);
        if (other == node) over.push_back(c);
        if (std::count(unknown.begin(), unknown.end(), other) == 0)
          over.push_back({c.triangle, c.corner, 1.0 / double(unknown.size())});
      }
      builder.addWithin(v, over);
    }
  }
  for (TractionUnknown& traction : tractions) {
    for (int node : traction.nodes) traction.area += body.nodes.area[node];
    traction.scale = 1 / std::sqrt(traction.area);
  }

  Eigen::Matrix3Xd positions(3, equations.size());
  for (std::size_t i = 0; i < equations.size(); ++i)
    positions.col(i) = body.points.col(equations[i].vertex);
  std::vector<CollocationEquation> ordered;
  for (int i : spatialOrder(positions)) ordered.push_back(std::move(equations[i]));
  equations = std::move(ordered);
}

}  // namespace palpate::bem
