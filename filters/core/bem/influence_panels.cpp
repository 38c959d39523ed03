// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/influence_panels.h"

#include <cstring>
#include <Eigen/Geometry>

#include "bem/spatial_order.h"
#include "bem/triangle_quadrature.h"

namespace palpate::bem {
namespace {

PanelTriangle makePanelTriangle(const BodySurface& body, int f) {
  PanelTriangle out;
  Eigen::Matrix3d corner;
  for (int k = 0; k < 3; ++k) corner.col(k) = body.points.col(body.triangles(k, f));
  const Eigen::Vector3d normal = body.normals.col(f);
  const Eigen::Vector3d axis1 = (corner.col(1) - corner.col(0)).normalized();
  const Eigen::Vector3d axis2 = normal.cross(axis1);
  const Eigen::Vector3d centroid = corner.rowwise().mean();
  Eigen::Map<Eigen::Vector3d>(out.axis1) = axis1;
  Eigen::Map<Eigen::Vector3d>(out.axis2) = axis2;
  Eigen::Map<Eigen::Vector3d>(out.normal) = normal;
  Eigen::Map<Eigen::Vector3d>(out.centroid) = centroid;
  out.area = body.areas[f];
  out.radius = (corner.colwise() - centroid).colwise().norm().maxCoeff();
  for (int k = 0; k < 3; ++k) {
    Eigen::Map<Eigen::Vector3d>(out.vertex[k]) = corner.col(k);
    const Eigen::Vector3d offset = corner.col(k) - corner.col(0);
    out.planar[k][0] = k == 0 ? 0 : axis1.dot(offset);
    out.planar[k][1] = k == 2 ? axis2.dot(offset) : 0;
    out.vertexIndex[k] = body.triangles(k, f);
    out.tractionNode[k] = body.nodes.ofCorner(k, f);
  }
  for (int k = 0; k < 3; ++k) {
    const int to = (k + 1) % 3;
    const double dx = out.planar[to][0] - out.planar[k][0];
    const double dy = out.planar[to][1] - out.planar[k][1];
    out.length[k] = std::hypot(dx, dy);
    out.tangent[k][0] = dx / out.length[k];
    out.tangent[k][1] = dy / out.length[k];
    out.outward[k][0] = out.tangent[k][1];
    out.outward[k][1] = -out.tangent[k][0];
  }
  for (int k = 0; k < 3; ++k) {  // the hat falls from the vertex towards the opposite edge
    const int opposite = (k + 1) % 3;
    const double slope = out.length[opposite] / (2 * out.area);
    out.gradient[k][0] = -slope * out.outward[opposite][0];
    out.gradient[k][1] = -slope * out.outward[opposite][1];
  }
  return out;
}

}  // namespace

InfluencePanels::InfluencePanels(const BodySurface& body, const CollocationScheme& scheme,
                                 double tolerance)
    : body_(body), scheme_(scheme), positionOfTriangle_(body.triangleCount()) {
  choosePanelRules(tolerance, nearRule_, farRule_);
  Eigen::Matrix3Xd centroids(3, body.triangleCount());
  for (int f = 0; f < body.triangleCount(); ++f) centroids.col(f) = body.centroid(f);
  for (int f : spatialOrder(centroids)) {
    positionOfTriangle_[f] = static_cast<int>(triangles_.size());
    triangles_.push_back(makePanelTriangle(body, f));
  }
  placeOfVertex_.assign(body.vertexCount(), -1);
  placeOfNode_.assign(body.nodes.count(), -1);
  int vertices = 0, nodes = 0;
  for (PanelTriangle& t : triangles_)
    for (int k = 0; k < 3; ++k) {
      int& vertexPlace = placeOfVertex_[t.vertexIndex[k]];
      if (vertexPlace < 0) vertexPlace = vertices++;
      t.vertexIndex[k] = vertexPlace;
      int& nodePlace = placeOfNode_[t.tractionNode[k]];
      if (nodePlace < 0) nodePlace = nodes++;
      t.tractionNode[k] = nodePlace;
    }
}

InfluencePanels::Workspace::Workspace(const InfluencePanels& panels)
    : panels_(panels),
      h_(std::size_t(9 * kLanes) * panels.body_.vertexCount()),
      g_(std::size_t(6 * kLanes) * panels.body_.nodes.count()),
      pointH_(h_.size()),
      pointG_(g_.size()),
      ownIndex_(panels.triangles_.size(), -1) {
  std::memset(pointH_.data(), 0, pointH_.bytes());
  std::memset(pointG_.data(), 0, pointG_.bytes());
}

/// The rows of a panel whose equations are each taken at one point: nothing to average.
/// @return false if they are not.
bool InfluencePanels::computeAtPoints(int panel, Workspace& work) const {
  std::vector<int> points;
  for (int lane = 0; lane < laneCount(panel); ++lane) {
    const auto& terms = scheme_.equations[panel * kLanes + lane].terms;
    if (terms.size() != 1) return false;
    points.push_back(terms[0].point);
  }
  std::memset(work.h_.data(), 0, work.h_.bytes());
  std::memset(work.g_.data(), 0, work.g_.bytes());
  integratePoints(points, work, work.h_.data(), work.g_.data());
  return true;
}

void InfluencePanels::compute(int panel, Workspace& work) const {
  if (computeAtPoints(panel, work)) return;
  // The points of the panel's equations, once each, neighbours together.
  std::vector<int> points;
  for (int lane = 0; lane < laneCount(panel); ++lane)
    for (const auto& term : scheme_.equations[panel * kLanes + lane].terms)
      points.push_back(term.point);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  Eigen::Matrix3Xd positions(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    positions.col(i) = scheme_.points[points[i]].position;
  const std::vector<int> order = spatialOrder(positions);

  for (std::size_t first = 0; first < order.size(); first += kLanes) {
    std::vector<int> group;
    for (std::size_t i = first; i < std::min(first + kLanes, order.size()); ++i)
      group.push_back(points[order[i]]);
    integratePoints(group, work, work.pointH_.data(), work.pointG_.data());
    double weights[kLanes * kLanes] = {};  // [point][equation]
    for (int lane = 0; lane < laneCount(panel); ++lane)
      for (const auto& term : scheme_.equations[panel * kLanes + lane].terms)
        for (std::size_t p = 0; p < group.size(); ++p)
          if (group[p] == term.point) weights[p * kLanes + lane] += term.weight;
    averagePoints(weights, 9L * body_.vertexCount(), first == 0, work.pointH_.data(),
                  work.h_.data());
    averagePoints(weights, 6L * body_.nodes.count(), first == 0, work.pointG_.data(),
                  work.g_.data());
  }
}

void InfluencePanels::markOwnTriangles(const std::vector<int>& points, Workspace& work) const {
  work.own_.clear();
  for (int lane = 0; lane < kLanes; ++lane) {
    const int point = points[std::min<std::size_t>(lane, points.size() - 1)];
    for (const CollocationPoint::Own& own : scheme_.points[point].own) {
      int& index = work.ownIndex_[positionOfTriangle_[own.triangle]];
      if (index < 0) {
        index = static_cast<int>(work.own_.size());
        work.own_.push_back({});
      }
      OwnTriangle& mark = work.own_[index];
      mark.mask[lane] = 1;
      for (int k = 0; k < 3; ++k) mark.barycentric[k][lane] = own.barycentric[k];
    }
  }
}

/// Rows of H and G at up to kLanes points, added to zeros; lanes without a point repeat the last
/// one.
void InfluencePanels::integratePoints(const std::vector<int>& points, Workspace& work, double* h,
                                      double* g) const {
  markOwnTriangles(points, work);
  PanelTask task;
  for (int lane = 0; lane < kLanes; ++lane) {
    const int point = points[std::min<std::size_t>(lane, points.size() - 1)];
    for (int c = 0; c < 3; ++c) task.x[c][lane] = scheme_.points[point].position[c];
  }
  task.triangles = triangles_.data();
  task.triangleCount = static_cast<int>(triangles_.size());
  task.ownIndex = work.ownIndex_.data();
  task.own = work.own_.data();
  task.nearRule = nearRule_;
  task.farRule = farRule_;
  task.poissonRatio = body_.poissonRatio;
  task.h = h;
  task.g = g;
  integratePanel(task);
  for (int point : points)
    for (const CollocationPoint::Own& own : scheme_.points[point].own)
      work.ownIndex_[positionOfTriangle_[own.triangle]] = -1;
  closeByTranslation(points, h);
}

/// Adds to the blocks of the points' own vertices what rigid translation asks for.
void InfluencePanels::closeByTranslation(const std::vector<int>& points, double* h) const {
  const std::size_t size = std::size_t(9 * kLanes) * body_.vertexCount();
  double sum[9 * kLanes] = {};
  for (std::size_t i = 0; i < size; i += 9 * kLanes)
    for (int e = 0; e < 9 * kLanes; ++e) sum[e] += h[i + e];
  if (body_.exterior) {  // the normal points the other way: H_exterior = 1 - H_interior
    for (std::size_t i = 0; i < size; ++i) h[i] = -h[i];
    for (int c = 0; c < 9; ++c)
      for (int lane = 0; lane < kLanes; ++lane)
        sum[c * kLanes + lane] = -sum[c * kLanes + lane] - (c % 4 == 0);
  }
  for (std::size_t lane = 0; lane < points.size(); ++lane) {
    const CollocationPoint::Own& own = scheme_.points[points[lane]].own.front();
    for (int k = 0; k < 3; ++k) {
      const std::size_t v = placeOfVertex_[body_.triangles(k, own.triangle)];
      for (int c = 0; c < 9; ++c)
        h[(9 * v + c) * kLanes + lane] -= own.barycentric[k] * sum[c * kLanes + lane];
    }
  }
}

}  // namespace palpate::bem
