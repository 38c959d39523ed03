// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shell/shell_element.h"

#include <algorithm>
#include <Eigen/Geometry>

#include "shell/membrane_triangle.h"
#include "shell/plate_triangle.h"

namespace palpate::shell {
namespace {

/// Where the degrees of freedom of each part stand in a corner's six, along the triangle's axes.
constexpr int kMembrane[3] = {0, 1, 5}, kPlate[3] = {2, 3, 4};

void addPart(const Matrix9d& part, const int (&places)[3], Matrix18d& whole) {
  for (int row = 0; row < 9; ++row)
    for (int column = 0; column < 9; ++column)
      whole(6 * (row / 3) + places[row % 3], 6 * (column / 3) + places[column % 3]) +=
          part(row, column);
}

/// Rows are axes: along side 01, across it in the plane, along the normal.
Eigen::Matrix3d axesOf(const Eigen::Matrix3d& corners) {
  const Eigen::Vector3d first = (corners.col(1) - corners.col(0)).normalized();
  const Eigen::Vector3d normal = first.cross(corners.col(2) - corners.col(0)).normalized();
  Eigen::Matrix3d axes;
  axes << first.transpose(), normal.cross(first).transpose(), normal.transpose();
  return axes;
}

/// Means over a triangle of t and of t^3, which is a tenth of all products of three corners' t, as
/// monomials.
double mean(const Eigen::Vector3d& t) {
  return t.sum() / 3;
}
double meanCube(const Eigen::Vector3d& t) {
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      for (int k = j; k < 3; ++k) sum += t[i] * t[j] * t[k];
  return sum / 10;
}

/// beta_0, see shellStiffness.
double higherOrder(const Corners2d& flat, const Eigen::Vector3d& thickness, double nu,
                   double inclination) {
  const double optimal = optimalHigherOrder(nu);
  const double twiceArea = flat(0, 1) * flat(1, 2);  // corner 1 is on the first axis
  const double t = mean(thickness), rise = inclination * inclination * twiceArea;
  if (t * t >= 10 * optimal * rise) return optimal;
  return std::max(t * t / (10 * rise), kLeastHigherOrder);
}

}  // namespace

Eigen::Matrix3d planeStress(double nu) {
  Eigen::Matrix3d plane;
  plane << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
  return plane / (1 - nu * nu);
}

Matrix18d shellStiffness(const Eigen::Matrix3d& corners, const Eigen::Vector3d& thickness,
                         double nu, double inclination) {
  const Eigen::Matrix3d axes = axesOf(corners);
  const Corners2d flat = axes.topRows<2>() * (corners.colwise() - corners.col(0));
  const Eigen::Matrix3d plane = planeStress(nu);
  Matrix18d local = Matrix18d::Zero();
  addPart(membraneStiffness(flat, mean(thickness) * plane,
                            higherOrder(flat, thickness, nu, inclination)),
          kMembrane, local);
  addPart(plateStiffness(flat, meanCube(thickness) / 12 * plane), kPlate, local);

  Matrix18d turned;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column)
      turned.block<3, 3>(3 * row, 3 * column) =
          axes.transpose() * local.block<3, 3>(3 * row, 3 * column) * axes;
  return (turned + turned.transpose()) / 2;
}

}  // namespace palpate::shell
