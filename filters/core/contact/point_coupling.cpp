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
  for (Point& point : points_) point.isChanged = true;
}

void PointCoupling::setShare(double share) noexcept {
  if (share == share_) return;
  share_ = share;
  for (Point& point : points_) point.isChanged = true;
}

void PointCoupling::place(int point, const SurfacePoint& place,
                          const Eigen::Matrix3d& served) noexcept {
  Point& changed = points_[point];
  if (changed.isPlaced && changed.place.triangle == place.triangle &&
      changed.place.barycentric == place.barycentric && changed.served == served)
    return;
  changed = {true, true, place, served};
}

/// C_ij of one stiffness. Corners that the triangles before had as well keep their blocks.
Eigen::Matrix3d PointCoupling::weighted(int version, Corners& corners, const Point& i,
                                        const Point& j) noexcept {
  const SurfaceStiffness& stiffness = *stiffness_[version];
  const auto& triangles = stiffness.mesh().triangles();
  if (corners.first != i.place.triangle || corners.second != j.place.triangle) {
    const Corners before = corners;
    const auto find = [&](int triangle, int vertex) {
      for (int k = 0; triangle >= 0 && k < 3; ++k)
        if (triangles(k, triangle) == vertex) return k;
      return -1;
    };
    for (int l = 0; l < 3; ++l)
      for (int k = 0; k < 3; ++k) {
        const int to = triangles(k, i.place.triangle), from = triangles(l, j.place.triangle);
        const int row = find(before.first, to), column = find(before.second, from);
        corners.blocks[3 * l + k] = row >= 0 && column >= 0 ? before.blocks[3 * column + row]
                                                            : betweenMasks(stiffness, to, from);
      }
    corners.first = i.place.triangle;
    corners.second = j.place.triangle;
  }
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int l = 0; l < 3; ++l)
    for (int k = 0; k < 3; ++k)
      sum += i.place.barycentric[k] * j.place.barycentric[l] * corners.blocks[3 * l + k];
  return sum;
}

void PointCoupling::renew(Pair& pair, const Point& i, const Point& j) noexcept {
  pair.block = weighted(0, pair.corners[0], i, j);
  if (share_ < 1)
    pair.block = share_ * pair.block + (1 - share_) * weighted(1, pair.corners[1], i, j);
  pair.scaled = scaledBy(pair.block, i.served, j.served);
}

/// Brings all blocks up to the present places.
void PointCoupling::update() noexcept {
  const auto isChanged = [](const Point& point) { return point.isPlaced && point.isChanged; };
  if (std::none_of(points_.begin(), points_.end(), isChanged)) return;
  const int count = static_cast<int>(points_.size());
  for (int j = 1; j < count; ++j)
    for (int i = 0; i < j; ++i) {
      const Point &first = points_[i], &second = points_[j];
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
