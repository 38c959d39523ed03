// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imported/definiteness.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <random>

#include "support/given_bodies.h"

namespace palpate::test {
namespace {

/// A symmetric matrix of these eigenvalues, its eigenvectors at random.
Eigen::MatrixXd withEigenvalues(const Eigen::VectorXd& values) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd mixed(values.size(), values.size());
  for (double& entry : mixed.reshaped()) entry = normal(random);
  const Eigen::MatrixXd vectors = Eigen::HouseholderQR<Eigen::MatrixXd>(mixed).householderQ();
  return vectors * values.asDiagonal() * vectors.transpose();
}

TEST(Definiteness, NegativeEigenvaluesAreMeasured) {
  for (double least : {-1e-8, -3e-3, -0.5, -2.}) {
    Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(60, 0.01, 4);
    values[7] = 4 * least;
    const imported::Negativity found = imported::negativity(withEigenvalues(values), 1e-10);
    // The largest eigenvalue is known to a few percent, by power iteration.
    EXPECT_NEAR(found.share / std::min(-least, 1.), 1, 0.1) << least;
    EXPECT_NEAR(found.value / (4 * least), 1, 0.02) << least;
    EXPECT_GE(found.row, 0);
  }
}

TEST(Definiteness, WhatIsPositiveToRoundingIs) {
  Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(60, 0, 4);
  values[7] = -1e-13;
  EXPECT_EQ(imported::negativity(withEigenvalues(values), 1e-10).share, 0);
}

TEST(Definiteness, InversesAreSymmetricWhateverTheUnits) {
  Eigen::VectorXd scale = Eigen::VectorXd::Constant(60, 1e-6);
  scale.tail(30).setConstant(1e9);  // forces beside moments
  const Eigen::MatrixXd matrix = scale.asDiagonal() *
                                 withEigenvalues(Eigen::VectorXd::LinSpaced(60, 1, 50)) *
                                 scale.asDiagonal();
  Eigen::MatrixXd inverse = (matrix + matrix.transpose()) / 2;
  ASSERT_EQ(imported::invertDefinite(inverse), 0);
  EXPECT_EQ(inverse, Eigen::MatrixXd(inverse.transpose()));
  const Eigen::MatrixXd one =
      scale.asDiagonal() * inverse * matrix * Eigen::MatrixXd(scale.cwiseInverse().asDiagonal());
  EXPECT_LE((one - Eigen::MatrixXd::Identity(60, 60)).norm(), 1e-12);
}

TEST(Definiteness, ALooseBodyHasSixRigidMotions) {
  const Solid solid = kuhnBox({1, 2, 3}, {1, 2, 3});
  const Eigen::MatrixXd stiffness = trussStiffness(solid);
  const imported::RigidMotions loose = imported::rigidMotions(stiffness, solid.points);
  ASSERT_EQ(loose.shares.size(), 6);
  EXPECT_LE(loose.shares.cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_EQ(imported::rigidMotions(stiffness, solid.points, false).shares.size(), 3);

  // Points on a line cannot be seen to turn about it.
  const Eigen::Matrix3Xd line = Eigen::Vector3d(1, 1, 0) * Eigen::RowVectorXd::LinSpaced(4, 0, 3);
  EXPECT_EQ(imported::rigidMotions(Eigen::MatrixXd::Identity(12, 12), line).shares.size(), 5);
}

TEST(Definiteness, TheWeakestMotionIsNamed) {
  // Springs to the ground that leave but the turn about an axis along y.
  Solid solid = kuhnBox({1, 1, 1}, {2, 2, 2});
  Eigen::MatrixXd stiffness = trussStiffness(solid);
  for (int p = 0; p < solid.points.cols(); ++p)
    if (solid.points(0, p) == 0 && solid.points(2, p) == 0)
      stiffness.block<3, 3>(3 * p, 3 * p) += Eigen::Matrix3d::Identity();
  const RigidMotion weakest = imported::rigidMotions(stiffness, solid.points).weakest;
  EXPECT_LE(std::abs(weakest.resistance), 1e-14);
  EXPECT_TRUE(weakest.describe().find("rotation about the axis") != std::string::npos);
  EXPECT_NEAR(std::abs(weakest.rotation.normalized().y()), 1, 1e-6);
}

}  // namespace
}  // namespace palpate::test
