// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fem/solid_elements.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <random>

#include "support/solids.h"

namespace palpate::test {
namespace {

using Corners = Eigen::Matrix<double, 3, 4>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// A sum of a few hundred products.
constexpr double kRounding = 1e-12;

/// Any tetrahedron that is neither flat nor inside out.
Corners randomCorners(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  Corners corners;
  corners << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  return corners + Corners::NullaryExpr([&] { return uniform(random); });
}

double volumeOf(const Corners& corners) {
  return (corners.col(1) - corners.col(0))
             .cross(corners.col(2) - corners.col(0))
             .dot(corners.col(3) - corners.col(0)) /
         6;
}

Eigen::Vector4d randomPlace(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.1, 1);
  const Eigen::Vector4d any = Eigen::Vector4d::NullaryExpr([&] { return uniform(random); });
  return any / any.sum();
}

/// Where the nodes of an element are: corners, then middles of edges 01 02 03 12 13 23.
Eigen::Matrix3Xd nodesOf(const Corners& corners, SolidElement element) {
  if (element == SolidElement::Linear) return corners;
  Eigen::Matrix3Xd nodes(3, 10);
  nodes.leftCols<4>() = corners;
  int next = 4;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) nodes.col(next++) = (corners.col(i) + corners.col(j)) / 2;
  return nodes;
}

/// Not isotropic, so that no shear is mistaken for another.
Matrix6d anyStiffness() {
  Eigen::Matrix3d axes = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  return Elasticity::orthotropic({{3, 2, 1}, {0.3, 0.2, 0.25}, {0.9, 0.7, 0.5}}, axes).stiffness();
}

Vector6d strainVector(const Eigen::Matrix3d& gradient) {
  const Eigen::Matrix3d& g = gradient;
  Vector6d v;
  v << g(0, 0), g(1, 1), g(2, 2), g(1, 2) + g(2, 1), g(0, 2) + g(2, 0), g(0, 1) + g(1, 0);
  return v;
}

/// A vector field with quadratic components, u_k = c_k + g_k . x + x . Q_k x / 2.
struct QuadraticField {
  Eigen::Vector3d constant;
  Eigen::Matrix3d linear, quadratic[3];

  explicit QuadraticField(unsigned seed, bool hasCurvature) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto entry = [&] { return uniform(random); };
    constant = Eigen::Vector3d::NullaryExpr(entry);
    linear = Eigen::Matrix3d::NullaryExpr(entry);
    for (Eigen::Matrix3d& q : quadratic) {
      const Eigen::Matrix3d any = Eigen::Matrix3d::NullaryExpr(entry);
      q = hasCurvature * (any + any.transpose());
    }
  }
  Eigen::Vector3d at(const Eigen::Vector3d& x) const {
    Eigen::Vector3d u = constant + linear * x;
    for (int k = 0; k < 3; ++k) u[k] += x.dot(quadratic[k] * x) / 2;
    return u;
  }
  /// Rows are gradients of components.
  Eigen::Matrix3d gradient(const Eigen::Vector3d& x) const {
    Eigen::Matrix3d g = linear;
    for (int k = 0; k < 3; ++k) g.row(k) += (quadratic[k] * x).transpose();
    return g;
  }
  Eigen::VectorXd atNodes(const Eigen::Matrix3Xd& nodes) const {
    Eigen::Matrix3Xd values(3, nodes.cols());
    for (int i = 0; i < nodes.cols(); ++i) values.col(i) = at(nodes.col(i));
    return values.reshaped();
  }
};

class SolidElementOf : public testing::TestWithParam<SolidElement> {
 protected:
  const SolidElement element = GetParam();
  const bool isQuadratic = element == SolidElement::Quadratic;
  const int nodes = isQuadratic ? 10 : 4;
  Eigen::VectorXd values;
  Eigen::Matrix3Xd slopes;
  fem::ElementMatrices matrices;
};

TEST_P(SolidElementOf, EachOrderHasShapeFunctionsThatAddUpToOne) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Corners corners = randomCorners(seed);
    fem::shapeFunctions(element, randomPlace(seed), fem::barycentricGradients(corners), values,
                        slopes);
    ASSERT_EQ(values.size(), nodes);
    EXPECT_NEAR(values.sum(), 1, kRounding);
    EXPECT_LT(slopes.rowwise().sum().norm(), kRounding);
  }
}

TEST_P(SolidElementOf, EachOrderHasShapeFunctionsOfOneNodeEach) {
  const Corners corners = randomCorners(1);
  const Eigen::Matrix3Xd at = nodesOf(corners, element);
  const Corners gradients = fem::barycentricGradients(corners);
  for (int i = 0; i < nodes; ++i) {
    Eigen::Vector4d place;
    for (int k = 0; k < 4; ++k)
      place[k] = (k == 0) + gradients.col(k).dot(at.col(i) - corners.col(0));
    fem::shapeFunctions(element, place, gradients, values, slopes);
    EXPECT_LT((values - Eigen::VectorXd::Unit(nodes, i)).norm(), kRounding);
  }
}

TEST_P(SolidElementOf, EachOrderHasTheGradientsOfItsShapeFunctions) {
  const Corners corners = randomCorners(2);
  const Corners gradients = fem::barycentricGradients(corners);
  const Eigen::Vector4d place = randomPlace(3);
  fem::shapeFunctions(element, place, gradients, values, slopes);
  const Eigen::Matrix3Xd exact = slopes;
  for (double step : {1e-1, 1e-2, 1e-3, 1e-4})
    for (int k = 0; k < 3; ++k) {
      Eigen::VectorXd ahead, behind;
      const Eigen::Vector4d shift = step * gradients.row(k).transpose();
      fem::shapeFunctions(element, place + shift, gradients, ahead, slopes);
      fem::shapeFunctions(element, place - shift, gradients, behind, slopes);
      // Central differences are exact for quadratic functions: only rounding over the step is left.
      EXPECT_LT(((ahead - behind) / (2 * step) - exact.row(k).transpose()).norm(),
                1e-14 / step + kRounding);
    }
}

TEST_P(SolidElementOf, EachOrderInterpolatesFieldsOfItsOrderExactly) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Corners corners = randomCorners(seed);
    const Eigen::Vector4d place = randomPlace(seed);
    const QuadraticField field(seed, isQuadratic);
    fem::shapeFunctions(element, place, fem::barycentricGradients(corners), values, slopes);
    const Eigen::VectorXd given = field.atNodes(nodesOf(corners, element));
    const Eigen::Map<const Eigen::Matrix3Xd> atNodes(given.data(), 3, nodes);
    const Eigen::Vector3d x = corners * place;
    EXPECT_LT((atNodes * values - field.at(x)).norm(), kRounding);
    EXPECT_LT((atNodes * slopes.transpose() - field.gradient(x)).norm(), kRounding * 10);
  }
}

TEST_P(SolidElementOf, EachOrderLeavesExactlySixMotionsWithoutEnergy) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    fem::integrateElement(randomCorners(seed), element, anyStiffness(), false, matrices);
    EXPECT_EQ(matrices.stiffness, matrices.stiffness.transpose());
    const Eigen::VectorXd eigenvalues =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrices.stiffness).eigenvalues();
    const double largest = eigenvalues[3 * nodes - 1];
    EXPECT_LT(eigenvalues.head<6>().cwiseAbs().maxCoeff(), 1e-14 * largest);
    EXPECT_GT(eigenvalues[6], 1e-4 * largest);  // a mechanism would be at rounding
  }
}

TEST_P(SolidElementOf, EachOrderStoresTheEnergyOfAUniformStrain) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Corners corners = randomCorners(seed);
    fem::integrateElement(corners, element, anyStiffness(), false, matrices);
    const QuadraticField field(seed, false);
    const Eigen::VectorXd u = field.atNodes(nodesOf(corners, element));
    const Vector6d strain = strainVector(field.linear);
    const double expected = volumeOf(corners) / 2 * strain.dot(anyStiffness() * strain);
    EXPECT_NEAR(u.dot(matrices.stiffness * u) / 2 / expected, 1, kRounding);
  }
}

TEST_P(SolidElementOf, EachOrderHasMassAndDivergenceInClosedForm) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Corners corners = randomCorners(seed);
    const double volume = volumeOf(corners);
    fem::integrateElement(corners, element, anyStiffness(), true, matrices);
    // The integral of the product of two hats is V / 20, of a hat's square V / 10.
    const Eigen::Matrix4d mass =
        volume / 20 * (Eigen::Matrix4d::Ones() + Eigen::Matrix4d::Identity());
    EXPECT_LT((matrices.mass - mass).norm(), kRounding * volume);
    // The divergence of a quadratic field is linear: its integral with hats is that mass times its
    // corner values.
    const QuadraticField field(seed, isQuadratic);
    Eigen::Vector4d divergence;
    for (int k = 0; k < 4; ++k) divergence[k] = field.gradient(corners.col(k)).trace();
    EXPECT_LT(
        (matrices.divergence * field.atNodes(nodesOf(corners, element)) - mass * divergence).norm(),
        kRounding);
    fem::integrateElement(corners, element, anyStiffness(), false, matrices);
    EXPECT_EQ(matrices.divergence.rows(), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, SolidElementOf,
                         testing::Values(SolidElement::Linear, SolidElement::Quadratic));

/// Strains that vary linearly store half the sum over corners of e_i . C e_j times the hats' mass.
TEST(QuadraticSolidElement, StoresTheEnergyOfALinearStrain) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Corners corners = randomCorners(seed);
    fem::ElementMatrices matrices;
    fem::integrateElement(corners, SolidElement::Quadratic, anyStiffness(), true, matrices);
    const QuadraticField field(seed, true);
    const Eigen::VectorXd u = field.atNodes(nodesOf(corners, SolidElement::Quadratic));
    Eigen::Matrix<double, 6, 4> strain;
    for (int k = 0; k < 4; ++k) strain.col(k) = strainVector(field.gradient(corners.col(k)));
    const double expected =
        (strain.transpose() * anyStiffness() * strain).cwiseProduct(matrices.mass).sum() / 2;
    EXPECT_NEAR(u.dot(matrices.stiffness * u) / 2 / expected, 1, kRounding);
  }
}

TEST(SolidNodes, AreThePointsOfTheMeshAndTheMiddlesOfItsEdgesOnce) {
  const TetrahedralMesh mesh = kuhnBox({1, 1, 1}, {1, 1, 1}).mesh();
  const fem::SolidNodes linear(mesh, SolidElement::Linear);
  EXPECT_EQ(linear.count, 8);
  EXPECT_EQ(linear.cells, mesh.tetrahedra());
  EXPECT_EQ(linear.middle(0, 1), -1);
  const fem::SolidNodes quadratic(mesh, SolidElement::Quadratic);
  EXPECT_EQ(quadratic.count, 8 + 12 + 6 + 1);  // edges, diagonals of sides, the diagonal
  EXPECT_EQ(quadratic.middle(1, 6), -1);       // no edge of any tetrahedron
  std::vector<bool> isMet(quadratic.count, false);
  for (int cell = 0; cell < mesh.cellCount(); ++cell) {
    int next = 4;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) {
        const int a = mesh.tetrahedra()(i, cell), b = mesh.tetrahedra()(j, cell);
        const int middle = quadratic.cells(next++, cell);
        EXPECT_EQ(quadratic.middle(a, b), middle);
        EXPECT_EQ(quadratic.middle(b, a), middle);
        isMet[middle] = true;
      }
  }
  for (int node = 8; node < quadratic.count; ++node) EXPECT_TRUE(isMet[node]) << node;
}

}  // namespace
}  // namespace palpate::test
