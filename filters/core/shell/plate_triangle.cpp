// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shell/plate_triangle.h"

#include <Eigen/LU>

namespace palpate::shell {
namespace {

/// Slopes (w_x, w_y) at six nodes, the corners and the middles of sides 01, 12, 20, in rows of two,
/// from (w, theta_x, theta_y) of the corners.
using Slopes = Eigen::Matrix<double, 12, 9>;

Slopes slopesOf(const Corners2d& corners) {
  Slopes slopes = Slopes::Zero();
  for (int i = 0; i < 3; ++i) {
    slopes(2 * i, 3 * i + 2) = -1;
    slopes(2 * i + 1, 3 * i + 1) = 1;
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Eigen::Vector2d side = corners.col(j) - corners.col(i);
    const double length = side.norm();
    const Eigen::Vector2d along = side / length;
    // Across the side as the mean of its ends; along it as the slope of the cubic,
    // 3 (w_j - w_i) / (2 l) - (w_i,s + w_j,s) / 4.
    const Eigen::Matrix2d ofEnd =
        Eigen::Matrix2d::Identity() / 2 - 0.75 * along * along.transpose();
    auto middle = slopes.middleRows<2>(6 + 2 * i);
    middle = ofEnd * (slopes.middleRows<2>(2 * i) + slopes.middleRows<2>(2 * j));
    middle.col(3 * i) -= 1.5 / length * along;
    middle.col(3 * j) += 1.5 / length * along;
  }
  return slopes;
}

/// Gradients of the quadratic shape functions of the six nodes at a place.
/// @param barycentric  of the place.
/// @param gradients    of the barycentric coordinates.
Eigen::Matrix<double, 2, 6> shapeGradients(const Eigen::Vector3d& barycentric,
                                           const Corners2d& gradients) {
  Eigen::Matrix<double, 2, 6> slopes;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    slopes.col(i) = (4 * barycentric[i] - 1) * gradients.col(i);
    slopes.col(3 + i) = 4 * (barycentric[i] * gradients.col(j) + barycentric[j] * gradients.col(i));
  }
  return slopes;
}

}  // namespace

Matrix9d plateStiffness(const Corners2d& corners, const Eigen::Matrix3d& bending) {
  Eigen::Matrix2d sides;
  sides << corners.col(1) - corners.col(0), corners.col(2) - corners.col(0);
  const double area = sides.determinant() / 2;
  Corners2d gradients;
  gradients.rightCols<2>() = sides.inverse().transpose();
  gradients.col(0) = -gradients.rightCols<2>().rowwise().sum();

  const Slopes slopes = slopesOf(corners);
  Matrix9d stiffness = Matrix9d::Zero();
  for (int i = 0; i < 3; ++i) {
    // Curvatures are linear, so the middles of the sides integrate their squares exactly.
    Eigen::Vector3d place = Eigen::Vector3d::Constant(0.5);
    place[i] = 0;
    const Eigen::Matrix<double, 2, 6> shapes = shapeGradients(place, gradients);
    Eigen::Matrix<double, 3, 9> curvatures = Eigen::Matrix<double, 3, 9>::Zero();
    for (int node = 0; node < 6; ++node) {
      const auto slope = slopes.middleRows<2>(2 * node);
      curvatures.row(0) += shapes(0, node) * slope.row(0);
      curvatures.row(1) += shapes(1, node) * slope.row(1);
      curvatures.row(2) += shapes(1, node) * slope.row(0) + shapes(0, node) * slope.row(1);
    }
    stiffness += area / 3 * curvatures.transpose() * bending * curvatures;
  }
  return (stiffness + stiffness.transpose()) / 2;
}

}  // namespace palpate::shell
