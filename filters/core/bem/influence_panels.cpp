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

InfluencePanels::InfluencePanels(const BodySurface& body,
                                 const std::vector<CollocationPoint>& points, double tolerance)
    : body_(body), points_(points), positionOfTriangle_(body.triangleCount()) {
  choosePanelRules(tolerance, rules_);
  Eigen::Matrix3Xd centroids(3, body.triangleCount());
  for (int f = 0; f < body.triangleCount(); ++f)
    centroids.col(f) =
        (body.points.col(body.triangles(0, f)) + body.points.col(body.triangles(1, f)) +
         body.points.col(body.triangles(2, f))) /
        3;
  for (int f : spatialOrder(centroids)) {
    positionOfTriangle_[f] = static_cast<int>(triangles_.size());
    triangles_.push_back(makePanelTriangle(body, f));
  }
}

InfluencePanels::Workspace::Workspace(const InfluencePanels& panels)
    : h_(std::size_t(9 * kLanes) * panels.body_.vertexCount()),
      g_(std::size_t(6 * kLanes) * panels.body_.nodes.count()),
      ownIndex_(panels.triangles_.size(), -1) {}

void InfluencePanels::markOwnTriangles(int panel, Workspace& work) const {
  work.own_.clear();
  for (int lane = 0; lane < kLanes; ++lane) {
    const int p = panel * kLanes + std::min(lane, laneCount(panel) - 1);
    for (const CollocationPoint::Own& own : points_[p].own) {
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

void InfluencePanels::compute(int panel, Workspace& work) const {
  std::memset(work.h_.data(), 0, work.h_.bytes());
  std::memset(work.g_.data(), 0, work.g_.bytes());
  markOwnTriangles(panel, work);

  PanelTask task;
  for (int lane = 0; lane < kLanes; ++lane) {
    const CollocationPoint& point = points_[panel * kLanes + std::min(lane, laneCount(panel) - 1)];
    for (int c = 0; c < 3; ++c) task.x[c][lane] = point.position[c];
  }
  work.closedFormCount_ = 0;
  task.triangles = triangles_.data();
  task.triangleCount = static_cast<int>(triangles_.size());
  task.ownIndex = work.ownIndex_.data();
  task.own = work.own_.data();
  task.rules = rules_;
  task.poissonRatio = body_.poissonRatio;
  task.h = work.h_.data();
  task.g = work.g_.data();
  task.closedFormCount = &work.closedFormCount_;
  integratePanel(task);
  closedFormPairs_ += work.closedFormCount_;
  allPairs_ += task.triangleCount;

  for (int lane = 0; lane < laneCount(panel); ++lane)
    for (const CollocationPoint::Own& own : points_[panel * kLanes + lane].own)
      work.ownIndex_[positionOfTriangle_[own.triangle]] = -1;
  closeByTranslation(panel, work);
}

void InfluencePanels::closeByTranslation(int panel, Workspace& work) const {
  double sum[9][kLanes] = {};
  for (int v = 0; v < body_.vertexCount(); ++v)
    for (int c = 0; c < 9; ++c)
      for (int lane = 0; lane < kLanes; ++lane)
        sum[c][lane] += work.h_.data()[(9 * std::size_t(v) + c) * kLanes + lane];
  if (body_.exterior) {  // the normal points the other way: H_exterior = 1 - H_interior
    for (std::size_t i = 0; i < work.h_.size(); ++i) work.h_.data()[i] *= -1;
    for (int c = 0; c < 9; ++c)
      for (int lane = 0; lane < kLanes; ++lane) sum[c][lane] = -sum[c][lane] - (c % 4 == 0);
  }
  for (int lane = 0; lane < laneCount(panel); ++lane) {
    const CollocationPoint& point = points_[panel * kLanes + lane];
    const CollocationPoint::Own& own = point.own.front();
    for (int k = 0; k < 3; ++k) {
      const int v = body_.triangles(k, own.triangle);
      for (int c = 0; c < 9; ++c)
        work.h_.data()[(9 * std::size_t(v) + c) * kLanes + lane] -=
            own.barycentric[k] * sum[c][lane];
    }
  }
}

}  // namespace palpate::bem
