// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Dense>
#include <random>

#include "shell/membrane_triangle.h"
#include "shell/plate_triangle.h"
#include "shell/shell_element.h"
#include "support/thin_shells.h"

namespace palpate::test {
namespace {

using shell::Corners2d;
using shell::Matrix18d;
using shell::Matrix9d;
using Vector9d = Eigen::Matrix<double, 9, 1>;

constexpr double kRatios[] = {-0.9, -0.5, 0, 0.3, 0.5};
/// A sum of some hundred products.
constexpr double kRounding = 1e-12;

/// Any triangle, counter-clockwise, that is not flat.
Corners2d randomTriangle(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);
  Corners2d corners;
  corners << 0, 1, 0.2, 0, 0.1, 0.9;
  return corners + Corners2d::NullaryExpr([&] { return uniform(random); });
}

Eigen::Matrix3d randomTriangleInSpace(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);
  Eigen::Matrix3d corners;
  corners << 0, 1, 0.2, 0, 0.1, 0.9, 0.3, -0.2, 0.7;
  return corners + Eigen::Matrix3d::NullaryExpr([&] { return uniform(random); });
}

double areaOf(const Corners2d& c) {
  Eigen::Matrix2d sides;
  sides << c.col(1) - c.col(0), c.col(2) - c.col(0);
  return sides.determinant() / 2;
}

/// The corners' degrees of freedom in a plane under u = G x, with its own rotation.
Vector9d stretched(const Corners2d& corners, const Eigen::Matrix2d& g) {
  Vector9d d;
  for (int i = 0; i < 3; ++i) d.segment<3>(3 * i) << g * corners.col(i), (g(1, 0) - g(0, 1)) / 2;
  return d;
}

/// Those of a plate under w = x . H x / 2.
Vector9d bent(const Corners2d& corners, const Eigen::Matrix2d& h) {
  Vector9d d;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d x = corners.col(i), slope = h * x;
    d.segment<3>(3 * i) << x.dot(slope) / 2, slope.y(), -slope.x();
  }
  return d;
}

Eigen::Vector3d strainOf(const Eigen::Matrix2d& g) {
  return {g(0, 0), g(1, 1), g(0, 1) + g(1, 0)};
}

/// Displacements and rotations of points in space under a rigid motion, six a point; six columns.
Eigen::MatrixXd rigidMotions(const Eigen::Matrix3Xd& points) {
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(6 * points.cols(), 6);
  for (Eigen::Index v = 0; v < points.cols(); ++v)
    for (int k = 0; k < 3; ++k) {
      motions.block<3, 1>(6 * v, k) = Eigen::Vector3d::Unit(k);
      motions.block<3, 1>(6 * v, 3 + k) =
          Eigen::Vector3d::Unit(k).cross(Eigen::Vector3d(points.col(v)));
      motions.block<3, 1>(6 * v + 3, 3 + k) = Eigen::Vector3d::Unit(k);
    }
  return motions;
}

TEST(MembraneTriangle, StoresTheEnergyOfAUniformStrain) {
  Eigen::Matrix2d g;
  g << 0.3, -0.2, 0.5, 0.1;
  for (double nu : kRatios)
    for (unsigned seed = 0; seed < 10; ++seed) {
      const Corners2d corners = randomTriangle(seed);
      const Eigen::Matrix3d plane = 2 * shell::planeStress(nu);
      const Vector9d d = stretched(corners, g);
      const double exact = areaOf(corners) * strainOf(g).dot(plane * strainOf(g));
      EXPECT_NEAR(
          d.dot(shell::membraneStiffness(corners, plane, shell::optimalHigherOrder(nu)) * d) /
              exact,
          1, kRounding);
    }
}

TEST(MembraneTriangle, TwoOfThemBendInTheirPlaneLikeABeamAtAnyAspectRatio) {
  // u = -x y, v = x^2 / 2 with its rotation x: the strain is -y along x, and across nu y. Where
  // beta_0 is the formula's (|nu| < 0.49) the energy is that of a beam; the corners cannot follow
  // v's part -nu y^2 / 2, which is none of the beam's energy.
  for (double nu : {-0.3, 0., 0.3, 0.45})
    for (double length : {0.25, 1., 4., 16.}) {
      Corners2d first, second;
      first << 0, length, length, -0.5, -0.5, 0.5;
      second << 0, length, 0, -0.5, 0.5, 0.5;
      double energy = 0;
      for (const Corners2d& corners : {first, second}) {
        Vector9d d;
        for (int i = 0; i < 3; ++i) {
          const double x = corners(0, i) - length / 2, y = corners(1, i);
          d.segment<3>(3 * i) << -x * y, x * x / 2, x;
        }
        energy += d.dot(shell::membraneStiffness(corners, shell::planeStress(nu),
                                                 shell::optimalHigherOrder(nu)) *
                        d);
      }
      EXPECT_NEAR(energy / (length / 12), 1, 1e-11) << "nu " << nu << ", length " << length;
    }
}

TEST(PlateTriangle, StoresTheEnergyOfAUniformCurvature) {
  Eigen::Matrix2d h;
  h << 0.3, -0.2, -0.2, 0.7;
  for (double nu : kRatios)
    for (unsigned seed = 0; seed < 10; ++seed) {
      const Corners2d corners = randomTriangle(seed);
      const Eigen::Matrix3d bending = 3 * shell::planeStress(nu);
      const Vector9d d = bent(corners, h);
      const double exact = areaOf(corners) * strainOf(h).dot(bending * strainOf(h));
      EXPECT_NEAR(d.dot(shell::plateStiffness(corners, bending) * d) / exact, 1, kRounding);
    }
}

/// How far the middle vertices of an irregular patch are from where a field puts them whose values
/// all others are given.
double patchTestError(const std::function<Matrix9d(const Corners2d&)>& stiffness,
                      const std::function<Eigen::Vector3d(const Eigen::Vector2d&)>& field) {
  const Shape patch = jitteredPlate(1, 4, 0.3, 3);
  const auto count = patch.points.cols();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * count, 3 * count);
  for (const auto& triangle : patch.triangles.colwise()) {
    Corners2d corners;
    for (int i = 0; i < 3; ++i) corners.col(i) = patch.points.col(triangle[i]).head<2>();
    const Matrix9d own = stiffness(corners);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        all.block<3, 3>(3 * triangle[i], 3 * triangle[j]) += own.block<3, 3>(3 * i, 3 * j);
  }
  Eigen::VectorXd exact(3 * count), given = Eigen::VectorXd::Zero(3 * count);
  for (Eigen::Index v = 0; v < count; ++v) {
    const Eigen::Vector2d x = patch.points.col(v).head<2>();
    exact.segment<3>(3 * v) = field(x);
    if (x.cwiseAbs().maxCoeff() < 0.499) continue;
    given.segment<3>(3 * v) = field(x);
    all.middleRows<3>(3 * v).setZero();
    all.block<3, 3>(3 * v, 3 * v).setIdentity();
  }
  return (all.partialPivLu().solve(given) - exact).cwiseAbs().maxCoeff();
}

TEST(PatchTest, UniformStrainIsHeldExactlyByAnyMesh) {
  Eigen::Matrix2d g;
  g << 0.3, -0.2, 0.5, 0.1;
  for (double nu : kRatios) {
    const double error = patchTestError(
        [&](const Corners2d& c) {
          return shell::membraneStiffness(c, shell::planeStress(nu), shell::optimalHigherOrder(nu));
        },
        [&](const Eigen::Vector2d& x) {
          const Eigen::Vector2d u = g * x;
          return Eigen::Vector3d(u.x(), u.y(), (g(1, 0) - g(0, 1)) / 2);
        });
    EXPECT_LT(error, 10 * kRounding) << "nu " << nu;  // solved: a condition number of hundreds
  }
}

TEST(PatchTest, UniformCurvatureIsHeldExactlyByAnyMesh) {
  Eigen::Matrix2d h;
  h << 0.3, -0.2, -0.2, 0.7;
  for (double nu : kRatios) {
    const double error = patchTestError(
        [&](const Corners2d& c) { return shell::plateStiffness(c, shell::planeStress(nu)); },
        [&](const Eigen::Vector2d& x) {
          const Eigen::Vector2d slope = h * x;
          return Eigen::Vector3d(x.dot(slope) / 2, slope.y(), -slope.x());
        });
    EXPECT_LT(error, 10 * kRounding) << "nu " << nu;
  }
}

TEST(ShellElement, LeavesExactlySixMotionsWithoutEnergyTheRigidOnes) {
  for (double nu : kRatios)
    for (unsigned seed = 0; seed < 5; ++seed) {
      const Eigen::Matrix3d corners = randomTriangleInSpace(seed);
      const Matrix18d stiffness = shell::shellStiffness(corners, {1, 1.5, 1.2}, nu, 0);
      EXPECT_EQ(stiffness, stiffness.transpose());
      EXPECT_LT((stiffness * rigidMotions(corners)).norm(), 1e-14 * stiffness.norm());
      const Eigen::VectorXd values =
          Eigen::SelfAdjointEigenSolver<Matrix18d>(stiffness).eigenvalues();
      EXPECT_LT(values.head<6>().cwiseAbs().maxCoeff(), 1e-14 * values[17]);
      // A mechanism would be at rounding, 1e-16. Drilling rotations against each other are the
      // softest, where beta_0 is least.
      EXPECT_GT(values[6], 1e-7 * values[17]) << "nu " << nu;
    }
}

TEST(ShellElement, GivesWayToDrillingAloneBesideInclinedTriangles) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    Eigen::Matrix3d corners = Eigen::Matrix3d::Zero();
    corners.topRows<2>() = randomTriangle(seed);
    const Eigen::Vector3d thickness(0.01, 0.01, 0.01);
    // A stretch with its rotation; and one corner's drilling.
    Eigen::Matrix2d g;
    g << 0.3, -0.2, 0.5, 0.1;
    const Vector9d flat = stretched(corners.topRows<2>(), g);
    Eigen::Matrix<double, 18, 1> stretch = Eigen::Matrix<double, 18, 1>::Zero(), drill = stretch;
    for (int i = 0; i < 3; ++i) {
      stretch.segment<2>(6 * i) = flat.segment<2>(3 * i);
      stretch[6 * i + 5] = flat[3 * i + 2];
    }
    drill[5] = 1;
    const Matrix18d upright = shell::shellStiffness(corners, thickness, 0.3, 0);
    double last = drill.dot(upright * drill);
    EXPECT_EQ(upright, shell::shellStiffness(corners, thickness, 0.3, 1e-4));
    for (double inclination : {0.01, 0.03, 0.1}) {
      const Matrix18d inclined = shell::shellStiffness(corners, thickness, 0.3, inclination);
      EXPECT_NEAR(stretch.dot(inclined * stretch) / stretch.dot(upright * stretch), 1, kRounding);
      EXPECT_LT((inclined * rigidMotions(corners)).norm(), 1e-14 * inclined.norm());
      const double own = drill.dot(inclined * drill);
      EXPECT_LE(own, last);
      last = own;
    }
    EXPECT_LT(last, 0.95 * drill.dot(upright * drill));
    EXPECT_EQ(shell::shellStiffness(corners, thickness, 0.3, 0.3),
              shell::shellStiffness(corners, thickness, 0.3, 0.5));  // the least
  }
}

TEST(ShellElement, TurnsWithItsCorners) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Eigen::Matrix3d corners = randomTriangleInSpace(1);
  const Eigen::Vector3d thickness(0.1, 0.2, 0.15);
  const Matrix18d here = shell::shellStiffness(corners, thickness, 0.3, 0);
  const Matrix18d there = shell::shellStiffness(
      (turn * corners).colwise() + Eigen::Vector3d(3, -1, 2), thickness, 0.3, 0);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const Eigen::Matrix3d expected = turn * here.block<3, 3>(3 * i, 3 * j) * turn.transpose();
      EXPECT_LT((there.block<3, 3>(3 * i, 3 * j) - expected).norm(), kRounding * here.norm());
    }
}

TEST(ShellElement, DoesNotKnowWhichCornerComesFirstNorWhichSideIsUp) {
  const Eigen::Matrix3d corners = randomTriangleInSpace(2);
  const Eigen::Vector3d thickness(0.1, 0.2, 0.15);
  const Matrix18d original = shell::shellStiffness(corners, thickness, 0.3, 0);
  const int orders[][3] = {{1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (const auto& order : orders) {
    Eigen::Matrix3d moved;
    Eigen::Vector3d movedThickness;
    for (int k = 0; k < 3; ++k) {
      moved.col(k) = corners.col(order[k]);
      movedThickness[k] = thickness[order[k]];
    }
    const Matrix18d other = shell::shellStiffness(moved, movedThickness, 0.3, 0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        EXPECT_LT(
            (other.block<6, 6>(6 * i, 6 * j) - original.block<6, 6>(6 * order[i], 6 * order[j]))
                .norm(),
            kRounding * original.norm());
  }
}

TEST(ShellElement, StretchesByItsMeanThicknessAndBendsByItsMeanCube) {
  Eigen::Matrix3d corners = Eigen::Matrix3d::Zero();
  corners.topRows<2>() = randomTriangle(4);
  const Corners2d flat = corners.topRows<2>();
  const Eigen::Vector3d thickness(0.1, 0.3, 0.2);
  const Matrix18d stiffness = shell::shellStiffness(corners, thickness, 0.3, 0);
  Eigen::Matrix2d h;
  h << 0.3, -0.2, -0.2, 0.7;
  Eigen::Matrix<double, 18, 1> d = Eigen::Matrix<double, 18, 1>::Zero();
  const Vector9d plate = bent(flat, h), membrane = stretched(flat, h);
  for (int i = 0; i < 3; ++i) d.segment<3>(6 * i + 2) = plate.segment<3>(3 * i);
  // The mean of t^3 by 400^2 / 2 small triangles with t of their middles: an error of 1e-5.
  double cube = 0;
  const int n = 400;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n - i; ++j)
      for (int up = 0; up < (j < n - i - 1 ? 2 : 1); ++up) {
        const double a = (i + (up ? 2. : 1.) / 3) / n, b = (j + (up ? 2. : 1.) / 3) / n;
        cube += std::pow(thickness.dot(Eigen::Vector3d(1 - a - b, a, b)), 3) / (n * n);
      }
  const Eigen::Vector3d strain = strainOf(h);
  const double energy = areaOf(flat) * strain.dot(shell::planeStress(0.3) * strain);
  EXPECT_NEAR(d.dot(stiffness * d) / (energy * cube / 12), 1, 1e-5);
  d.setZero();
  for (int i = 0; i < 3; ++i) {
    d.segment<2>(6 * i) = membrane.segment<2>(3 * i);
    d[6 * i + 5] = membrane[3 * i + 2];
  }
  EXPECT_NEAR(d.dot(stiffness * d) / (energy * 0.2), 1, kRounding);
}

TEST(ShellElement, HasUnitsOfLengthAndItsCube) {
  const Eigen::Matrix3d corners = randomTriangleInSpace(3);
  const Eigen::Vector3d thickness(0.1, 0.2, 0.15);
  const Matrix18d unit = shell::shellStiffness(corners, thickness, 0.3, 0);
  for (double scale : {1e-6, 1e-3, 1e3, 1e6}) {
    Eigen::Matrix<double, 18, 1> back;  // forces over scale^2, torques over scale^3, alike
    for (int k = 0; k < 18; ++k) back[k] = std::pow(scale, k % 6 < 3 ? -0.5 : -1.5);
    const Matrix18d scaled = back.asDiagonal() *
                             shell::shellStiffness(scale * corners, scale * thickness, 0.3, 0) *
                             back.asDiagonal();
    EXPECT_LT((scaled - unit).norm(), kRounding * unit.norm());
  }
}

}  // namespace
}  // namespace palpate::test
