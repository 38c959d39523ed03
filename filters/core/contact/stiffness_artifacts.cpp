// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/stiffness_artifacts.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "contact/variational_mask.h"

namespace palpate {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeastCommon = 0.5;  ///< of the area of surfaces that are compared
constexpr double kSameSide = 0.5;     ///< cosine of the largest angle between normals of one point

std::vector<int> ascending(const Eigen::VectorXd& values) {
  std::vector<int> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return values[a] < values[b]; });
  return order;
}

/// Ranks from 0, equal values at the mean of theirs.
Eigen::VectorXd ranks(const Eigen::VectorXd& values) {
  const std::vector<int> order = ascending(values);
  Eigen::VectorXd result(values.size());
  for (std::size_t first = 0, last; first < order.size(); first = last) {
    for (last = first + 1; last < order.size() && values[order[last]] == values[order[first]];)
      ++last;
    for (std::size_t i = first; i < last; ++i) result[order[i]] = (first + last - 1) / 2.;
  }
  return result;
}

/// Standard deviation over mean, of weighted values.
double variationOf(const Eigen::VectorXd& values, const Eigen::VectorXd& weights) {
  const double mean = weights.dot(values) / weights.sum();
  return std::sqrt(weights.dot((values.array() - mean).square().matrix()) / weights.sum()) / mean;
}

/// The least value that at least this share of the weight does not exceed.
double quantileOf(const Eigen::VectorXd& values, const Eigen::VectorXd& weights, double share) {
  double reached = 0;
  for (int i : ascending(values))
    if ((reached += weights[i]) >= share * weights.sum()) return values[i];
  return values.maxCoeff();
}

void requireSize(const char* what, Eigen::Index size, const SurfaceMesh& mesh) {
  if (size != mesh.vertexCount())
    throw std::invalid_argument("there are " + std::to_string(size) + " " + what + " for " +
                                std::to_string(mesh.vertexCount()) + " vertices");
}

/// Types in which whatever has no stiffness is fixed.
BoundaryConditions whereThereIsStiffness(const BoundaryConditions& conditions,
                                         const Eigen::VectorXd& norms) {
  std::vector<unsigned char> types = conditions.types();
  for (std::size_t v = 0; v < types.size(); ++v)
    if (std::isnan(norms[v])) types[v] = static_cast<unsigned char>(BoundaryType::Fixed);
  return BoundaryConditions(types);
}

void findJumps(const SurfaceMesh& mesh, const BoundaryConditions& served,
               const Eigen::VectorXd& norms, StiffnessArtifacts& result) {
  for (int v : served.freeNodes()) result.jump[v] = 0;
  for (int f = 0; f < mesh.triangleCount(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int i = mesh.triangles()(k, f), j = mesh.triangles()((k + 1) % 3, f);
      if (i > j || served.isFixed(i) || served.isFixed(j)) continue;
      const double jump = 2 * std::abs(norms[i] - norms[j]) / (norms[i] + norms[j]);
      for (int v : {i, j}) result.jump[v] = std::max(result.jump[v], jump);
      if (result.jumpFrom >= 0 && jump <= result.largestJump) continue;
      result.largestJump = jump;
      result.jumpFrom = i;
      result.jumpTo = j;
    }
}

/// A line y = intercept + slope x by least squares.
struct Line {
  double intercept, slope, determination;
};
Line lineThrough(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  const Eigen::VectorXd dx = x.array() - x.mean(), dy = y.array() - y.mean();
  const double slope = dx.dot(dy) / dx.squaredNorm();
  const double whole = dy.squaredNorm(), left = (dy - slope * dx).squaredNorm();
  return {y.mean() - slope * x.mean(), slope, whole > 0 ? 1 - left / whole : 1};
}

}  // namespace

PrincipalStiffness principalStiffness(const Eigen::Matrix3d& stiffness,
                                      const Eigen::Vector3d& outward) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(stiffness);
  PrincipalStiffness result{eigen.eigenvalues().reverse(), eigen.eigenvectors().rowwise().reverse(),
                            eigen.eigenvalues()[2] / eigen.eigenvalues()[0]};
  for (int k = 0; k < 3; ++k)
    if (result.directions.col(k).dot(outward) < 0) result.directions.col(k) *= -1;
  return result;
}

StiffnessArtifacts findStiffnessArtifacts(const SurfaceMesh& mesh,
                                          const BoundaryConditions& conditions,
                                          const Eigen::VectorXd& norms, double length) {
  requireSize("stiffnesses", norms.size(), mesh);
  requireSize("boundary types", conditions.nodeCount(), mesh);
  const BoundaryConditions served = whereThereIsStiffness(conditions, norms);
  const std::vector<int> nodes = served.freeNodes();
  if (nodes.size() < 3)
    throw std::invalid_argument(
        "artefacts show in the stiffness of at least three free vertices, "
        "and there are " +
        std::to_string(nodes.size()));
  for (int v : nodes)
    if (!(norms[v] > 0) || !std::isfinite(norms[v]))
      throw std::invalid_argument("the norm of the stiffness of vertex " + std::to_string(v) +
                                  " must be above 0, not " + std::to_string(norms[v]));
  if (!(length > 0) || !(length <= mesh.diagonal()))
    throw std::invalid_argument(
        "the smoothing length must be above 0 and at most the surface's diagonal, " +
        std::to_string(mesh.diagonal()) + ", not " + std::to_string(length));

  StiffnessArtifacts result;
  result.smooth = result.artifact = result.jump =
      Eigen::VectorXd::Constant(mesh.vertexCount(), kNothing);
  result.vertices = static_cast<int>(nodes.size());
  const VariationalMasks operation(mesh, served, MaskPenalty::Biharmonic, length);
  const Eigen::VectorXd smooth =
      operation.smoothed(norms.array().log().matrix())(nodes).array().exp();
  const Eigen::VectorXd values = norms(nodes), areas = mesh.vertexAreas()(nodes);
  const Eigen::VectorXd ratio = values.cwiseQuotient(smooth);
  result.smooth(nodes) = smooth;
  result.artifact(nodes) = ratio.array() - 1;
  result.variation = variationOf(ratio, areas);
  result.areaCorrelation = rankCorrelation(values, areas);
  findJumps(mesh, served, norms, result);
  return result;
}

double rankCorrelation(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  const Eigen::VectorXd a = ranks(x), b = ranks(y);
  const Eigen::VectorXd da = a.array() - a.mean(), db = b.array() - b.mean();
  const double norms = da.norm() * db.norm();
  return norms > 0 ? da.dot(db) / norms : 0;
}

StiffnessChange compareStiffness(const SurfaceMesh& mesh, const Eigen::VectorXd& norms,
                                 const SurfaceLocator& other,
                                 const std::vector<Eigen::Matrix3d>& stiffness) {
  requireSize("stiffnesses", norms.size(), mesh);
  requireSize("stiffnesses", static_cast<Eigen::Index>(stiffness.size()), other.mesh());
  const double furthest = std::max(mesh.meanEdgeLength(), other.mesh().meanEdgeLength());
  StiffnessChange result;
  result.change = Eigen::VectorXd::Constant(mesh.vertexCount(), kNothing);
  std::vector<int> nodes;
  double whole = 0, common = 0;
  for (int v = 0; v < mesh.vertexCount(); ++v) {
    if (std::isnan(norms[v])) continue;
    whole += mesh.vertexAreas()[v];
    const SurfacePoint at = other.nearest(mesh.points().col(v));
    const double apart = (placeOf(other.mesh(), at) - mesh.points().col(v)).norm();
    const Eigen::Vector3d normal = other.mesh().triangleNormals().col(at.triangle);
    if (apart > furthest || normal.dot(mesh.vertexNormals().col(v)) < kSameSide) continue;
    Eigen::Matrix3d there = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 3; ++k)
      if (at.barycentric[k] > 0)
        there += at.barycentric[k] * stiffness[other.mesh().triangles()(k, at.triangle)];
    if (there.hasNaN()) continue;
    result.change[v] = norms[v] / there.norm() - 1;
    common += mesh.vertexAreas()[v];
    nodes.push_back(v);
  }
  if (nodes.empty() || common < kLeastCommon * whole)
    throw std::invalid_argument(
        "only " + std::to_string(whole > 0 ? std::lround(100 * common / whole) : 0) +
        " % of one surface's free part lies on that of the other: are they the same body, in one "
        "frame and unit?");
  const Eigen::VectorXd change = result.change(nodes), areas = mesh.vertexAreas()(nodes);
  result.matched = static_cast<int>(nodes.size());
  result.median = quantileOf(change, areas, 0.5);
  result.variation = variationOf((change.array() + 1).matrix(), areas);
  result.ninetyFifth = quantileOf(change.cwiseAbs(), areas, 0.95);
  return result;
}

PointSingularity fitPointSingularity(const Eigen::VectorXd& sizes,
                                     const Eigen::VectorXd& compliances) {
  if (sizes.size() < 2 || sizes.size() != compliances.size() ||
      sizes.minCoeff() == sizes.maxCoeff())
    throw std::invalid_argument("a law of size needs the compliances of two sizes or more");
  if (!(sizes.minCoeff() > 0) || !(compliances.minCoeff() > 0) || !sizes.allFinite() ||
      !compliances.allFinite())
    throw std::invalid_argument("sizes and compliances must be above 0 and finite");
  const Line power = lineThrough(sizes.array().log(), compliances.array().log());
  const Line inverse = lineThrough(sizes.cwiseInverse(), compliances);
  return {-power.slope, power.determination, inverse.intercept, inverse.slope,
          inverse.determination};
}

}  // namespace palpate
