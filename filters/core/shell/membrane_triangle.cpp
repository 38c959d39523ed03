// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shell/membrane_triangle.h"

#include <algorithm>

namespace palpate::shell {
namespace {

using Vector9d = Eigen::Matrix<double, 9, 1>;

/// Differences of the corners' coordinates as the paper writes them: x(i, j) = x_i - x_j.
struct Triangle {
  explicit Triangle(const Corners2d& corners)
      : corners(corners), area((x(1, 0) * y(2, 0) - x(2, 0) * y(1, 0)) / 2) {}

  double x(int i, int j) const { return corners(0, i) - corners(0, j); }
  double y(int i, int j) const { return corners(1, i) - corners(1, j); }
  /// Squared length of the side from corner k to the next.
  double squaredSide(int k) const {
    const int next = (k + 1) % 3;
    return x(next, k) * x(next, k) + y(next, k) * y(next, k);
  }

  const Corners2d& corners;
  double area;
};

/// L / (h / 2): the nodal forces of a constant stress, alpha_b = 3/2.
Eigen::Matrix<double, 9, 3> lumpedForces(const Triangle& t) {
  constexpr double share = 1.5 / 6;
  Eigen::Matrix<double, 9, 3> forces;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    forces.row(3 * i) << t.y(j, k), 0, t.x(k, j);
    forces.row(3 * i + 1) << 0, t.x(k, j), t.y(j, k);
    forces.row(3 * i + 2) << share * t.y(j, k) * (t.y(i, k) - t.y(j, i)),
        share * t.x(k, j) * (t.x(k, i) - t.x(i, j)),
        2 * share * (t.x(k, i) * t.y(i, k) - t.x(i, j) * t.y(j, i));
  }
  return forces;
}

/// T: the corners' rotations less that of the constant-strain triangle.
Eigen::Matrix<double, 3, 9> deviation(const Triangle& t) {
  Vector9d mean = Vector9d::Zero();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    mean[3 * i] = t.x(k, j) / (4 * t.area);
    mean[3 * i + 1] = t.y(k, j) / (4 * t.area);
  }
  Eigen::Matrix<double, 3, 9> rotations = mean.transpose().replicate<3, 1>();
  for (int i = 0; i < 3; ++i) rotations(i, 3 * i + 2) += 1;
  return rotations;
}

/// Strains of (xx, yy, 2 xy) from elongations along the sides 01, 12, 20.
Eigen::Matrix3d fromNatural(const Triangle& t) {
  Eigen::Matrix3d strains;
  for (int k = 0; k < 3; ++k) {
    // The two other sides run from the corner opposite to side k.
    const int first = k, second = (k + 1) % 3, opposite = (k + 2) % 3;
    const double ya = t.y(second, opposite), yb = t.y(first, opposite), xa = t.x(second, opposite),
                 xb = t.x(first, opposite);
    strains.col(k) << ya * yb, xa * xb, -(ya * xb + xa * yb);
    strains.col(k) *= t.squaredSide(k) / (4 * t.area * t.area);
  }
  return strains;
}

/// Q_1, Q_2, Q_3: elongations along the sides at each corner from the deviations, by the beta_1 ..
/// beta_9 of the optimal triangle.
Eigen::Matrix3d elongations(const Triangle& t, int corner) {
  constexpr double beta[3][3] = {{1, 2, 1}, {0, 1, -1}, {-1, -1, -2}};
  Eigen::Matrix3d q;
  for (int side = 0; side < 3; ++side)
    for (int j = 0; j < 3; ++j)
      q((side + corner) % 3, (j + corner) % 3) =
          2 * t.area / 3 * beta[side][j] / t.squaredSide((side + corner) % 3);
  return q;
}

}  // namespace

double optimalHigherOrder(double nu) {
  return std::max((1 - 4 * nu * nu) / 2, kLeastHigherOrder);
}

Matrix9d membraneStiffness(const Corners2d& corners, const Eigen::Matrix3d& plane,
                           double higherOrder) {
  const Triangle t(corners);
  const Eigen::Matrix<double, 9, 3> forces = lumpedForces(t) / 2;
  const Eigen::Matrix3d toStrains = fromNatural(t);
  const Eigen::Matrix3d natural = toStrains.transpose() * plane * toStrains;
  Eigen::Matrix3d ofRotations = Eigen::Matrix3d::Zero();
  for (int corner = 0; corner < 3; ++corner) {
    const Eigen::Matrix3d middle =
        (elongations(t, corner) + elongations(t, (corner + 1) % 3)) / 2;  // of a side
    ofRotations += t.area * middle.transpose() * natural * middle;
  }
  const Eigen::Matrix<double, 3, 9> rotations = deviation(t);
  const Matrix9d stiffness = forces * plane * forces.transpose() / t.area +
                             0.75 * higherOrder * rotations.transpose() * ofRotations * rotations;
  return (stiffness + stiffness.transpose()) / 2;
}

}  // namespace palpate::shell
