// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/point_coupling.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Cholesky>

namespace palpate {
namespace {

/// Whether a vertex has a mask, and all columns of its nodes.
bool isServed(const SurfaceStiffness& stiffness, int vertex) {
  return !stiffness.greens().isFixed(vertex) && stiffness.elastic(vertex).allFinite();
}

/// Mean displacement under the mask of one vertex by a unit force under that of another, m/N.
Eigen::Matrix3d betweenMasks(const SurfaceStiffness& stiffness, int to, int from) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  if (!isServed(stiffness, to) || !isServed(stiffness, from)) return sum;
  const GreensFunctions& greens = stiffness.greens();
  const VertexMask &moved = stiffness.mask(to), &pressed = stiffness.mask(from);
  const int count = static_cast<int>(moved.nodes.size());
  constexpr int kRows = 32;  // at a time, on the stack
  Eigen::Matrix<double, 3 * kRows, 3> blocks;
  for (std::size_t n = 0; n < pressed.nodes.size(); ++n)
    for (int first = 0; first < count; first += kRows) {
      const int rows = std::min(kRows, count - first);
      greens.gather(Eigen::Map<const Eigen::VectorXi>(moved.nodes.data() + first, rows),
                    Eigen::Map<const Eigen::VectorXi>(&pressed.nodes[n], 1), blocks.data());
      const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3>> gathered(blocks.data(),
                                                                                3 * rows, 3);
      for (int m = 0; m < rows; ++m) {
        const double share = greens.vertexArea(moved.nodes[first + m]) * moved.density[first + m];
        sum += share * pressed.density[n] * gathered.middleRows<3>(3 * m);
      }
    }
  return sum;
}

/// The integral of the product of two vertices' masks, 1/m^2.
double overlapOf(const SurfaceStiffness& stiffness, int to, int from) {
  if (!isServed(stiffness, to) || !isServed(stiffness, from)) return 0;
  const VertexMask &one = stiffness.mask(to), &other = stiffness.mask(from);
  double sum = 0;
  for (std::size_t m = 0; m < one.nodes.size(); ++m)
    for (std::size_t n = 0; n < other.nodes.size(); ++n)
      if (one.nodes[m] == other.nodes[n])
        sum += stiffness.mesh().vertexAreas()[one.nodes[m]] * one.density[m] * other.density[n];
  return sum;
}

/// The square root of a symmetric matrix, of its part that is positive semidefinite.
Eigen::Matrix3d rootOf(const Eigen::Matrix3d& matrix) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect((matrix + matrix.transpose()) / 2);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() *
         eigen.eigenvectors().transpose();
}

/// L_i^T C L_j, what is felt of a force at the other point; zero without a stiffness.
Eigen::Matrix3d scaledBy(const Eigen::Matrix3d& block, const Eigen::Matrix3d& first,
                         const Eigen::Matrix3d& second) {
  const Eigen::LLT<Eigen::Matrix3d> left(first), right(second);
  if (left.info() != Eigen::Success || right.info() != Eigen::Success)
    return Eigen::Matrix3d::Zero();
  return left.matrixU() * (block * right.matrixL().toDenseMatrix());
}

}  // namespace

PointCoupling::PointCoupling(const SurfaceStiffness& stiffness, int pointCount)
    : stiffness_{&stiffness, &stiffness},
      points_(pointCount),
      pairs_(std::size_t(pointCount) * std::max(0, pointCount - 1) / 2),
      scaled_(3 * pointCount, 3 * pointCount),
      eigen_(3 * pointCount) {}

void PointCoupling::setStiffness(const SurfaceStiffness& stiffness) noexcept {
  stiffness_[1] = stiffness_[0];
  stiffness_[0] = &stiffness;
  for (Pair& pair : pairs_) {
    pair.corners[1] = pair.corners[0];
    pair.corners[0].first = pair.corners[0].second = -1;
  }
  share_ = 0;
  for (Point& point : points_) {
    point.own[1] = point.own[0];
    point.own[0].first = point.own[0].second = -1;
    point.isChanged = true;
    point.hasExcess = false;
  }
}

void PointCoupling::setShare(double share) noexcept {
  if (share == share_) return;
  share_ = share;
  for (Point& point : points_) {
    point.isChanged = true;
    point.hasExcess = false;
  }
}

void PointCoupling::place(int point, const SurfacePoint& place,
                          const Eigen::Matrix3d& served) noexcept {
  Point& changed = points_[point];
  if (changed.isPlaced && changed.place.triangle == place.triangle &&
      changed.place.barycentric == place.barycentric && changed.served == served)
    return;
  changed.isPlaced = changed.isChanged = true;
  changed.place = place;
  changed.served = served;
  changed.hasExcess = false;
}

/// The blocks of one stiffness between the corners of two triangles. Corners that the triangles
/// before had as well keep theirs.
void PointCoupling::lookUp(int version, Corners& corners, const Point& i, const Point& j) noexcept {
  if (corners.first == i.place.triangle && corners.second == j.place.triangle) return;
  const SurfaceStiffness& stiffness = *stiffness_[version];
  const auto& triangles = stiffness.mesh().triangles();
  const Corners before = corners;
  const auto find = [&](int triangle, int vertex) {
    for (int k = 0; triangle >= 0 && k < 3; ++k)
      if (triangles(k, triangle) == vertex) return k;
    return -1;
  };
  for (int l = 0; l < 3; ++l)
    for (int k = 0; k < 3; ++k) {
      const int here = 3 * l + k;
      if (&i == &j && k < l) {  // symmetric
        corners.blocks[here] = corners.blocks[3 * k + l].transpose();
        corners.overlaps[here] = corners.overlaps[3 * k + l];
        continue;
      }
      const int to = triangles(k, i.place.triangle), from = triangles(l, j.place.triangle);
      const int row = find(before.first, to), column = find(before.second, from);
      const bool isKnown = row >= 0 && column >= 0;
      corners.blocks[here] =
          isKnown ? before.blocks[3 * column + row] : betweenMasks(stiffness, to, from);
      corners.overlaps[here] =
          isKnown ? before.overlaps[3 * column + row] : overlapOf(stiffness, to, from);
    }
  corners.first = i.place.triangle;
  corners.second = j.place.triangle;
}

/// Calls act with the weights of the corners, of both stiffnesses while one goes over to another.
template <class Act>
void PointCoupling::forCorners(const Point& i, const Point& j, const Act& act) const noexcept {
  for (int version = 0; version < (share_ < 1 ? 2 : 1); ++version)
    for (int l = 0; l < 3; ++l)
      for (int k = 0; k < 3; ++k)
        act(version, 3 * l + k,
            (version == 0 ? share_ : 1 - share_) * i.place.barycentric[k] * j.place.barycentric[l]);
}

/// The mean displacement under the mask of one place by a unit force under that of another.
Eigen::Matrix3d PointCoupling::mean(std::array<Corners, 2>& corners, const Point& i,
                                    const Point& j) noexcept {
  for (int version = 0; version < (share_ < 1 ? 2 : 1); ++version)
    lookUp(version, corners[version], i, j);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  forCorners(i, j, [&](int version, int corner, double weight) {
    sum += weight * corners[version].blocks[corner];
  });
  return sum;
}

/// The integral of the product of two masks, 1/m^2, whose corners were looked up.
double PointCoupling::overlap(const std::array<Corners, 2>& corners, const Point& i,
                              const Point& j) const noexcept {
  double sum = 0;
  forCorners(i, j, [&](int version, int corner, double weight) {
    sum += weight * corners[version].overlaps[corner];
  });
  return sum;
}

/// sqrt(D) of a point.
const Eigen::Matrix3d& PointCoupling::excessOf(Point& point) noexcept {
  if (!point.hasExcess) {
    const Eigen::Matrix3d own = mean(point.own, point, point);
    const Eigen::LLT<Eigen::Matrix3d> served(point.served);
    point.excess = served.info() == Eigen::Success
                       ? rootOf(served.solve(Eigen::Matrix3d::Identity()) - own)
                       : Eigen::Matrix3d::Zero();
    point.hasExcess = true;
  }
  return point.excess;
}

void PointCoupling::renew(Pair& pair, Point& i, Point& j) noexcept {
  pair.block = mean(pair.corners, i, j);
  if (const double between = overlap(pair.corners, i, j); between > 0) {
    const Eigen::Matrix3d &first = excessOf(i), &second = excessOf(j);
    pair.block +=
        between * between / (overlap(i.own, i, i) * overlap(j.own, j, j)) * first * second;
  }
  pair.scaled = scaledBy(pair.block, i.served, j.served);
}

/// Brings all blocks up to the present places.
void PointCoupling::update() noexcept {
  const auto isChanged = [](const Point& point) { return point.isPlaced && point.isChanged; };
  if (std::none_of(points_.begin(), points_.end(), isChanged)) return;
  const int count = static_cast<int>(points_.size());
  for (int j = 1; j < count; ++j)
    for (int i = 0; i < j; ++i) {
      Point &first = points_[i], &second = points_[j];
      if (first.isPlaced && second.isPlaced && (first.isChanged || second.isChanged))
        renew(pair(i, j), first, second);
    }
  for (Point& point : points_)
    if (point.isPlaced) point.isChanged = false;
}

void PointCoupling::limit() noexcept {
  update();
  const double least = leastEigenvalue();
  scale_ = least < -kLargestShare ? -kLargestShare / least : 1;
}

/// Of the scaled blocks of all points, or a bound that is large enough.
double PointCoupling::leastEigenvalue() noexcept {
  const int count = static_cast<int>(points_.size());
  scaled_.setZero();
  for (int j = 1; j < count; ++j)
    for (int i = 0; i < j; ++i)
      if (points_[i].isPlaced && points_[j].isPlaced) {
        scaled_.block<3, 3>(3 * i, 3 * j) = pair(i, j).scaled;
        scaled_.block<3, 3>(3 * j, 3 * i) = pair(i, j).scaled.transpose();
      }
  const double bound = scaled_.cwiseAbs().rowwise().sum().maxCoeff();
  if (bound <= kLargestShare) return -bound;
  return eigen_.compute(scaled_, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

Eigen::Matrix3d PointCoupling::block(int i, int j) noexcept {
  update();
  if (i < j) return scale_ * pair(i, j).block;
  return scale_ * pair(j, i).block.transpose();
}

Eigen::Vector3d PointCoupling::shift(int point, const Eigen::VectorXd& forces) noexcept {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int j = 0; j < static_cast<int>(points_.size()); ++j)
    if (j != point && points_[j].isPlaced && !forces.segment<3>(3 * j).isZero(0))
      sum += block(point, j) * forces.segment<3>(3 * j);
  return sum;
}

}  // namespace palpate
