// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/elasticity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <limits>
#include <random>

#include "support/refusals.h"

namespace palpate::test {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
/// Sums of a few dozen products, some of them of an inverse: rounding.
constexpr double kRounding = 1e-13;

/// Voigt's order, with engineering shear strains.
Vector6d strainVector(const Eigen::Matrix3d& e) {
  Vector6d v;
  v << e(0, 0), e(1, 1), e(2, 2), 2 * e(1, 2), 2 * e(0, 2), 2 * e(0, 1);
  return v;
}

Eigen::Matrix3d stressTensor(const Vector6d& s) {
  Eigen::Matrix3d t;
  t << s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2];
  return t;
}

Eigen::Matrix3d randomSymmetric(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const Eigen::Matrix3d any = Eigen::Matrix3d::NullaryExpr([&] { return normal(random); });
  return any + any.transpose();
}

Eigen::Matrix3d randomAxes(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const Eigen::Vector4d q = Eigen::Vector4d::NullaryExpr([&] { return normal(random); });
  return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
}

/// All 21 constants different, positive definite.
Matrix6d anyStiffness(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Matrix6d any = Matrix6d::NullaryExpr([&] { return uniform(random); });
  return any * any.transpose() + Matrix6d::Identity();
}

double difference(const Matrix6d& a, const Matrix6d& b) {
  return (a - b).norm() / b.norm();
}

const OrthotropicModuli kWood = {{11e9, 0.9e9, 0.5e9}, {0.37, 0.42, 0.47}, {0.7e9, 0.6e9, 0.04e9}};

class IsotropicElasticity : public testing::TestWithParam<double> {};

TEST_P(IsotropicElasticity, IsHookesLawInClosedForm) {
  const double nu = GetParam(), young = 3e4, shear = young / (2 * (1 + nu));
  const double lambda = young * nu / ((1 + nu) * (1 - 2 * nu));
  const Matrix6d stiffness = Elasticity(Material(young, nu)).stiffness();
  const Eigen::Matrix3d strain = randomSymmetric(1);
  const Eigen::Matrix3d expected =
      2 * shear * strain + lambda * strain.trace() * Eigen::Matrix3d::Identity();
  EXPECT_LT((stressTensor(stiffness * strainVector(strain)) - expected).norm(),
            kRounding * expected.norm());
}

TEST_P(IsotropicElasticity, IsTheSameAlongAllAxes) {
  const Elasticity material(Material(3e4, GetParam()));
  EXPECT_LT(difference(material.turned(randomAxes(2)).stiffness(), material.stiffness()),
            kRounding);
}

TEST_P(IsotropicElasticity, IsOrthotropicWithEqualModuli) {
  const double nu = GetParam(), young = 3e4, shear = young / (2 * (1 + nu));
  const Elasticity orthotropic = Elasticity::orthotropic(
      {{young, young, young}, {nu, nu, nu}, {shear, shear, shear}}, randomAxes(3));
  EXPECT_LT(difference(orthotropic.stiffness(), Elasticity(Material(young, nu)).stiffness()),
            kRounding);
}

INSTANTIATE_TEST_SUITE_P(Materials, IsotropicElasticity, testing::Values(-0.5, 0.0, 0.3, 0.449));

TEST(NearlyIncompressibleElasticity, IsSplitIntoShearAndAPressureUpToOneHalf) {
  EXPECT_FALSE(Elasticity(Material(2, 0.449)).isSplit());
  for (double nu : {0.45, 0.499, 0.5}) {
    const Elasticity material(Material(2, nu));
    const double shear = 2 / (2 * (1 + nu));
    EXPECT_TRUE(material.isSplit()) << nu;
    Vector6d diagonal;
    diagonal << 2 * shear, 2 * shear, 2 * shear, shear, shear, shear;
    EXPECT_EQ(material.stiffness(), Matrix6d(diagonal.asDiagonal())) << nu;
    EXPECT_NEAR(material.compressibility(), (1 + nu) * (1 - 2 * nu) / (2 * nu), 1e-16) << nu;
    const Elasticity turned = material.turned(randomAxes(4));
    EXPECT_TRUE(turned.isSplit());
    EXPECT_EQ(turned.compressibility(), material.compressibility());
    EXPECT_LT(difference(turned.stiffness(), material.stiffness()), kRounding);
  }
  EXPECT_EQ(Elasticity(Material(2, 0.5)).compressibility(), 0);
}

TEST(AnisotropicElasticity, HasAnOrthotropicMaterialsModuliInItsInverse) {
  const Matrix6d compliance =
      Elasticity::orthotropic(kWood, Eigen::Matrix3d::Identity()).stiffness().inverse();
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(1 / compliance(i, i) / kWood.young[i], 1, 1e-12);
  EXPECT_NEAR(-compliance(0, 1) / compliance(0, 0), kWood.poisson[0], 1e-12);  // nu_12
  EXPECT_NEAR(-compliance(0, 2) / compliance(0, 0), kWood.poisson[1], 1e-12);  // nu_13
  EXPECT_NEAR(-compliance(1, 2) / compliance(1, 1), kWood.poisson[2], 1e-12);  // nu_23
  EXPECT_NEAR(1 / compliance(5, 5) / kWood.shear[0], 1, 1e-12);                // G_12 is xy
  EXPECT_NEAR(1 / compliance(4, 4) / kWood.shear[1], 1, 1e-12);
  EXPECT_NEAR(1 / compliance(3, 3) / kWood.shear[2], 1, 1e-12);
}

/// Stress along a direction per strain along it: a unit stress there does the work 1 / E.
double youngAlong(const Elasticity& material, const Eigen::Vector3d& d) {
  const Eigen::Matrix3d stress = d * d.transpose();
  Vector6d s;
  s << stress(0, 0), stress(1, 1), stress(2, 2), stress(1, 2), stress(0, 2), stress(0, 1);
  return 1 / s.dot(material.stiffness().inverse() * s);
}

TEST(TransverselyIsotropicElasticity, HasItsModuliAlongAndAcrossFibresOfAnyDirection) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Eigen::Matrix3d axes = randomAxes(seed);
    const Eigen::Vector3d fibre = axes.col(0);
    const Elasticity muscle =
        Elasticity::transverselyIsotropic(7 * fibre, 60e3, 0.3, 20e3, 0.45, 9e3);
    EXPECT_NEAR(youngAlong(muscle, fibre) / 60e3, 1, 1e-12);
    for (double angle : {0.0, 0.4, 1.3}) {
      const Eigen::Vector3d across = std::cos(angle) * axes.col(1) + std::sin(angle) * axes.col(2);
      EXPECT_NEAR(youngAlong(muscle, across) / 20e3, 1, 1e-12);
    }
    const Elasticity turned = muscle.turned(Eigen::AngleAxisd(0.7, fibre).toRotationMatrix());
    EXPECT_LT(difference(turned.stiffness(), muscle.stiffness()), kRounding);
  }
}

TEST(TurnedElasticity, IsTheSameAfterAFullTurn) {
  Elasticity material(anyStiffness(1));
  const Matrix6d before = material.stiffness();
  const Eigen::Vector3d axis = randomAxes(5).col(0);
  const double turn = 2 * std::acos(-1.0) / 6;
  for (int i = 0; i < 6; ++i)
    material = material.turned(Eigen::AngleAxisd(turn, axis).toRotationMatrix());
  EXPECT_LT(difference(material.stiffness(), before), kRounding);
}

TEST(TurnedElasticity, StoresTheEnergyOfTheStrainThatWasTurnedWithIt) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Elasticity material(anyStiffness(seed));
    const Eigen::Matrix3d axes = randomAxes(seed), strain = randomSymmetric(seed);
    const Vector6d before = strainVector(strain),
                   after = strainVector(axes * strain * axes.transpose());
    const double energy = before.dot(material.stiffness() * before);
    EXPECT_NEAR(after.dot(material.turned(axes).stiffness() * after) / energy, 1, kRounding * 10);
    // The stress turns along.
    const Eigen::Matrix3d stress = stressTensor(material.stiffness() * before);
    EXPECT_LT(
        (stressTensor(material.turned(axes).stiffness() * after) - axes * stress * axes.transpose())
            .norm(),
        kRounding * stress.norm() * 10);
  }
}

TEST(Elasticity, RefusesStiffnessesThatNoMaterialHas) {
  Matrix6d matrix = anyStiffness(1);
  matrix(0, 3) *= 1 + 1e-3;
  EXPECT_TRUE(isRefused([&] { Elasticity{matrix}; },
                        "the stiffness of a material must be symmetric; it differs from its "
                        "transpose by"));
  matrix = Matrix6d::Identity();
  matrix(2, 2) = -0.5;
  EXPECT_TRUE(isRefused([&] { Elasticity{matrix}; },
                        "must be positive definite: some strain would store no energy "
                        "(eigenvalues -0.5 to 1)"));
  matrix(2, 2) = 0;
  EXPECT_TRUE(isRefused([&] { Elasticity{matrix}; }, "(eigenvalues 0 to 1)"));
  for (double value : {kNan, std::numeric_limits<double>::infinity()}) {
    matrix(2, 2) = value;
    EXPECT_TRUE(isRefused([&] { Elasticity{matrix}; },
                          "the stiffness of a material holds a value that is not finite"));
  }
}

TEST(Elasticity, RefusesAxesThatAreNotARightHandedOrthonormalSet) {
  const char* const sentence =
      "the axes of a material must be a right-handed set of unit vectors at right angles";
  Eigen::Matrix3d skewed = Eigen::Matrix3d::Identity(), left = -skewed, unknown = skewed;
  skewed(0, 1) = 0.01;
  unknown(1, 1) = kNan;
  for (const Eigen::Matrix3d& axes : {skewed, left, unknown, Eigen::Matrix3d(2 * -left)}) {
    EXPECT_TRUE(isRefused([&] { Elasticity::orthotropic(kWood, axes); }, sentence));
    EXPECT_TRUE(isRefused([&] { Elasticity(Material(1, 0.3)).turned(axes); }, sentence));
  }
}

TEST(Elasticity, RefusesModuliThatLeaveAStrainWithoutResistance) {
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  OrthotropicModuli moduli = kWood;
  moduli.young[1] = 0;
  EXPECT_TRUE(isRefused([&] { Elasticity::orthotropic(moduli, axes); },
                        "the moduli of an orthotropic material must be above 0, not 0 and 6e+08"));
  moduli = kWood;
  moduli.shear[2] = kNan;
  EXPECT_TRUE(isRefused([&] { Elasticity::orthotropic(moduli, axes); }, "must be above 0"));
  moduli = kWood;
  moduli.poisson[0] = 4;  // above sqrt(E_1 / E_2)
  EXPECT_TRUE(isRefused([&] { Elasticity::orthotropic(moduli, axes); },
                        "the compliance of an orthotropic material must be positive definite"));
  moduli.poisson[0] = kNan;
  EXPECT_TRUE(isRefused([&] { Elasticity::orthotropic(moduli, axes); }, "not finite"));
}

TEST(Elasticity, RefusesFibresWithoutADirection) {
  for (const Eigen::Vector3d& fibre :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, kNan, 0),
        Eigen::Vector3d(std::numeric_limits<double>::infinity(), 0, 0)})
    EXPECT_TRUE(
        isRefused([&] { Elasticity::transverselyIsotropic(fibre, 60e3, 0.3, 20e3, 0.45, 9e3); },
                  "the direction of fibres must not be zero"));
}

}  // namespace
}  // namespace palpate::test
