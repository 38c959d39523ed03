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
  const Eigen::Vector3d centroid = body.centroid(f);
  Eigen::Map<Eigen::Vector3d>(out.normal) = body.normals.col(f);
  Eigen::Map<Eigen::Vector3d>(out.centroid) = centroid;
  out.area = body.areas[f];
  out.radius = 0;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d corner = body.points.col(body.triangles(k, f));
    Eigen::Map<Eigen::Vector3d>(out.vertex[k]) = corner;
    out.radius = std::max(out.radius, (corner - centroid).norm());
    out.vertexIndex[k] = body.triangles(k, f);
    out.tractionNode[k] = body.nodes.ofCorner(k, f);
  }
  return out;
}

TriangleFrame makeTriangleFrame(const BodySurface& body, int f) {
  TriangleFrame out;
  Eigen::Matrix3d corner;
  for (int k = 0; k < 3; ++k) corner.col(k) = body.points.col(body.triangles(k, f));
  const Eigen::Vector3d axis1 = (corner.col(1) - corner.col(0)).normalized();
  const Eigen::Vector3d axis2 = body.normals.col(f).cross(axis1);
  Eigen::Map<Eigen::Vector3d>(out.axis1) = axis1;
  Eigen::Map<Eigen::Vector3d>(out.axis2) = axis2;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d offset = corner.col(k) - corner.col(0);
    out.planar[k][0] = k == 0 ? 0 : axis1.dot(offset);
    out.planar[k][1] = k == 2 ? axis2.dot(offset) : 0;
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
    const double slope = out.length[opposite] / (2 * body.areas[f]);
    out.gradient[k][0] = -slope * out.outward[opposite][0];
    out.gradient[k][1] = -slope * out.outward[opposite][1];
  }
  return out;
}

}  // namespace

/// Up to kLanes points and what the equations of a panel make of them.
struct InfluencePanels::PointGroup {
  std::vector<int> points;
  double weights[kLanes * kLanes] = {};  // [point][equation]
  double sums[9 * kLanes] = {};          // of the points' rows of H
  std::vector<OwnTriangle> own;          // the points' own triangles, at
  std::vector<int> ownPositions;         // these positions
};

InfluencePanels::InfluencePanels(const BodySurface& body, const CollocationScheme& scheme,
                                 double tolerance)
    : body_(body), scheme_(scheme), positionOfTriangle_(body.triangleCount()) {
  choosePanelRules(tolerance, nearRule_, farRule_);
  Eigen::Matrix3Xd centroids(3, body.triangleCount());
  for (int f = 0; f < body.triangleCount(); ++f) centroids.col(f) = body.centroid(f);
  frames_.reserve(body.triangleCount());
  for (int f : spatialOrder(centroids)) {
    positionOfTriangle_[f] = static_cast<int>(triangles_.size());
    frames_.push_back(makeTriangleFrame(body, f));
    triangles_.push_back(makePanelTriangle(body, f));
    triangles_.back().frame = &frames_.back();
  }
  placeOfVertex_.assign(body.vertexCount(), -1);
  placeOfNode_.assign(body.nodes.count(), -1);
  int vertices = 0, nodes = 0;
  for (const PanelTriangle& t : triangles_)
    for (int k = 0; k < 3; ++k) {
      int& vertexPlace = placeOfVertex_[t.vertexIndex[k]];
      if (vertexPlace < 0) vertexPlace = vertices++;
      int& nodePlace = placeOfNode_[t.tractionNode[k]];
      if (nodePlace < 0) nodePlace = nodes++;
    }
  positions_.resize(3, body.vertexCount());
  for (int v = 0; v < body.vertexCount(); ++v)
    positions_.col(placeOfVertex_[v]) = body.points.col(v);
  cutIntoChunks();
}

/// Numbers the triangles' blocks anew within each chunk.
void InfluencePanels::cutIntoChunks() {
  const int total = static_cast<int>(triangles_.size());
  const int size = scheme_.kind == Collocation::Vertex ? total : kChunkTriangles;
  std::vector<int> vertexInChunk(body_.vertexCount(), -1), nodeInChunk(body_.nodes.count(), -1);
  const auto number = [](int place, std::vector<int>& numbers, std::vector<int>& places) {
    if (numbers[place] < 0) {
      numbers[place] = static_cast<int>(places.size());
      places.push_back(place);
    }
    return numbers[place];
  };
  for (int first = 0; first < total; first += size) {
    Chunk chunk{first, std::min(size, total - first), {}, {}};
    for (int f = first; f < first + chunk.triangleCount; ++f)
      for (int k = 0; k < 3; ++k) {
        int& vertex = triangles_[f].vertexIndex[k];
        vertex = number(placeOfVertex_[vertex], vertexInChunk, chunk.vertices);
        int& node = triangles_[f].tractionNode[k];
        node = number(placeOfNode_[node], nodeInChunk, chunk.nodes);
      }
    for (int place : chunk.vertices) vertexInChunk[place] = -1;
    for (int place : chunk.nodes) nodeInChunk[place] = -1;
    chunks_.push_back(std::move(chunk));
  }
}

InfluencePanels::Workspace::Workspace(const InfluencePanels& panels)
    : panels_(panels),
      h_(std::size_t(9 * kLanes) * panels.body_.vertexCount()),
      g_(std::size_t(6 * kLanes) * panels.body_.nodes.count()),
      ownIndex_(panels.triangles_.size(), -1) {
  std::size_t vertices = 0, nodes = 0;
  for (const Chunk& chunk : panels.chunks_) {
    vertices = std::max(vertices, chunk.vertices.size());
    nodes = std::max(nodes, chunk.nodes.size());
  }
  pointH_ = AlignedBuffer<double>(9 * kLanes * vertices);
  pointG_ = AlignedBuffer<double>(6 * kLanes * nodes);
  std::memset(pointH_.data(), 0, pointH_.bytes());
  std::memset(pointG_.data(), 0, pointG_.bytes());
}

void InfluencePanels::compute(int panel, Workspace& work) const {
  std::memset(work.h_.data(), 0, work.h_.bytes());
  std::memset(work.g_.data(), 0, work.g_.bytes());
  std::vector<PointGroup> groups = groupPoints(panel);
  if (chunks_.size() == 1 && isTakenAtPoints(panel)) {  // nothing to average
    integrate(chunks_[0], groups[0], work, work.h_.data(), work.g_.data());
    double sums[4 * 9 * kLanes];
    sumBlocks(work.h_.data(), body_.vertexCount(), positions_.data(), sums);
    std::copy_n(sums, 9 * kLanes, groups[0].sums);
  } else {
    double ignored[6 * kLanes] = {};
    for (const Chunk& chunk : chunks_)
      for (PointGroup& group : groups) {
        integrate(chunk, group, work, work.pointH_.data(), work.pointG_.data());
        averageBlocks(group.weights, chunk.vertices.data(), chunk.vertices.size(), 9,
                      work.pointH_.data(), work.h_.data(), group.sums);
        averageBlocks(group.weights, chunk.nodes.data(), chunk.nodes.size(), 6, work.pointG_.data(),
                      work.g_.data(), ignored);
      }
  }
  closeByTranslation(groups, work.h_.data());
}

bool InfluencePanels::isTakenAtPoints(int panel) const {
  for (int lane = 0; lane < laneCount(panel); ++lane)
    if (scheme_.equations[panel * kLanes + lane].terms.size() != 1) return false;
  return true;
}

/// The points of a panel's equations, once each, neighbours together; equations that are taken at
/// one point each have theirs in their own lane.
std::vector<InfluencePanels::PointGroup> InfluencePanels::groupPoints(int panel) const {
  std::vector<int> points;
  for (int lane = 0; lane < laneCount(panel); ++lane)
    for (const auto& term : scheme_.equations[panel * kLanes + lane].terms)
      points.push_back(term.point);
  if (!isTakenAtPoints(panel)) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    Eigen::Matrix3Xd positions(3, points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      positions.col(i) = scheme_.points[points[i]].position;
    std::vector<int> ordered;
    for (int i : spatialOrder(positions)) ordered.push_back(points[i]);
    points = std::move(ordered);
  }
  std::vector<PointGroup> groups((points.size() + kLanes - 1) / kLanes);
  for (std::size_t i = 0; i < points.size(); ++i) groups[i / kLanes].points.push_back(points[i]);
  for (PointGroup& group : groups) {
    for (int lane = 0; lane < laneCount(panel); ++lane)
      for (const auto& term : scheme_.equations[panel * kLanes + lane].terms)
        for (std::size_t p = 0; p < group.points.size(); ++p)
          if (group.points[p] == term.point) group.weights[p * kLanes + lane] += term.weight;
    findOwnTriangles(group);
  }
  return groups;
}

void InfluencePanels::findOwnTriangles(PointGroup& group) const {
  for (int lane = 0; lane < kLanes; ++lane)
    for (const CollocationPoint::Own& own : scheme_.points[pointOfLane(group, lane)].own) {
      const int position = positionOfTriangle_[own.triangle];
      const auto known = std::find(group.ownPositions.begin(), group.ownPositions.end(), position);
      const std::size_t index = known - group.ownPositions.begin();
      if (known == group.ownPositions.end()) {
        group.ownPositions.push_back(position);
        group.own.push_back({});
      }
      group.own[index].mask[lane] = 1;
      for (int k = 0; k < 3; ++k) group.own[index].barycentric[k][lane] = own.barycentric[k];
    }
}

/// Lanes without a point repeat the last one.
int InfluencePanels::pointOfLane(const PointGroup& group, int lane) {
  return group.points[std::min<std::size_t>(lane, group.points.size() - 1)];
}

/// Adds a chunk's part of the rows of H and G at a group's points to its blocks.
void InfluencePanels::integrate(const Chunk& chunk, const PointGroup& group, Workspace& work,
                                double* h, double* g) const {
  PanelTask task;
  for (int lane = 0; lane < kLanes; ++lane)
    for (int c = 0; c < 3; ++c)
      task.x[c][lane] = scheme_.points[pointOfLane(group, lane)].position[c];
  task.triangles = triangles_.data() + chunk.firstTriangle;
  task.triangleCount = chunk.triangleCount;
  task.ownIndex = work.ownIndex_.data() + chunk.firstTriangle;
  task.own = group.own.data();
  task.nearRule = nearRule_;
  task.farRule = farRule_;
  task.poissonRatio = body_.poissonRatio;
  task.h = h;
  task.g = g;
  for (std::size_t i = 0; i < group.own.size(); ++i)
    work.ownIndex_[group.ownPositions[i]] = static_cast<int>(i);
  integratePanel(task);
  for (int position : group.ownPositions) work.ownIndex_[position] = -1;
}

/// Adds to the blocks of the points' own vertices what rigid translation asks for.
void InfluencePanels::closeByTranslation(const std::vector<PointGroup>& groups, double* h) const {
  if (body_.exterior) {  // the normal points the other way: H_exterior = 1 - H_interior
    const std::size_t size = std::size_t(9 * kLanes) * body_.vertexCount();
    for (std::size_t i = 0; i < size; ++i) h[i] = -h[i];
  }
  for (const PointGroup& group : groups)
    for (std::size_t p = 0; p < group.points.size(); ++p) {
      const CollocationPoint::Own& own = scheme_.points[group.points[p]].own.front();
      for (int c = 0; c < 9; ++c) {
        const double sum = group.sums[c * kLanes + p];
        const double missing = body_.exterior ? sum + (c % 4 == 0) : -sum;
        for (int k = 0; k < 3; ++k) {
          const std::size_t v = placeOfVertex_[body_.triangles(k, own.triangle)];
          for (int lane = 0; lane < kLanes; ++lane)
            h[(9 * v + c) * kLanes + lane] +=
                group.weights[p * kLanes + lane] * own.barycentric[k] * missing;
        }
      }
    }
}

double InfluencePanels::rotationResidual(int panel, const Workspace& work) const {
  double sums[4][3][3][kLanes];
  sumBlocks(work.h_.data(), body_.vertexCount(), positions_.data(), sums[0][0][0]);
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int y = (axis + 1) % 3, z = (axis + 2) % 3;  // e_axis x r = r_y e_z - r_z e_y
    for (int lane = 0; lane < laneCount(panel); ++lane) {
      Eigen::Vector3d residual;
      for (int i = 0; i < 3; ++i) residual[i] = sums[1 + y][i][z][lane] - sums[1 + z][i][y][lane];
      if (body_.exterior)
        for (const auto& term : scheme_.equations[panel * kLanes + lane].terms)
          residual -=
              term.weight * Eigen::Vector3d::Unit(axis).cross(scheme_.points[term.point].position);
      largest = std::max(largest, residual.cwiseAbs().maxCoeff());
    }
  }
  return largest;
}

}  // namespace palpate::bem
