// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/variational_mask.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "contact/mask_settings.h"
#include "support/refusals.h"
#include "support/shapes.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr MaskPenalty kPenalties[] = {MaskPenalty::Gradient, MaskPenalty::Biharmonic};

struct Surface {
  Surface(const Shape& shape, const std::function<bool(const Eigen::Vector3d&)>& fixed)
      : mesh(shape.mesh()), conditions(fixedWhere(shape, fixed)) {}
  VariationalMasks masks(MaskPenalty penalty, double length, double tail = 0.01) const {
    return {*mesh, conditions, penalty, length, tail};
  }
  double force(const Eigen::VectorXd& density) const { return mesh->vertexAreas().dot(density); }
  std::shared_ptr<const SurfaceMesh> mesh;
  BoundaryConditions conditions;
};

Surface heldSphere() {
  return {jitteredSphere(2, 0.2), [](const auto& x) { return x.z() < -0.6; }};
}
Surface freeSphere(int level) {
  return {icosphere(level), [](const auto&) { return false; }};
}

TEST(VariationalMask, OfALoadBetweenVerticesIsTheBarycentricAverageOfTheirs) {
  // Eq. 38, at random points of all triangles, across the support's edge too.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  const Surface sphere = heldSphere();
  for (MaskPenalty penalty : kPenalties) {
    const VariationalMasks masks = sphere.masks(penalty, 0.3);
    for (int f = 0; f < sphere.mesh->triangleCount(); ++f) {
      Eigen::Vector3d at(uniform(random), uniform(random), uniform(random));
      at /= at.sum();
      Eigen::VectorXd average = Eigen::VectorXd::Zero(sphere.mesh->vertexCount());
      double carried = 0;
      for (int k = 0; k < 3; ++k) {
        const int v = sphere.mesh->triangles()(k, f);
        if (sphere.conditions.isFixed(v)) continue;
        average += at[k] * masks.column(v);
        carried += at[k];
      }
      const Eigen::VectorXd density = masks.densityAt({f, at});
      EXPECT_LE((density - average).norm(), 1e-12 * density.norm());
      EXPECT_NEAR(sphere.force(density), carried, 1e-12);
    }
  }
}

TEST(VariationalMask, TransmitsAUnitForceAsItIsAlsoAtTheSupport) {
  const Surface sphere = heldSphere();
  for (MaskPenalty penalty : kPenalties)
    for (double length : {1e-3, 0.1, 0.5, 2.0}) {
      const VariationalMasks masks = sphere.masks(penalty, length);
      for (int v : sphere.conditions.freeNodes()) {
        const Eigen::VectorXd column = masks.column(v);
        EXPECT_NEAR(sphere.force(column), 1, 1e-11);  // condition (length / edge)^4
        for (int u : sphere.conditions.fixedNodes()) EXPECT_EQ(column[u], 0);
        const VertexMask mask = masks.at(v);
        EXPECT_NEAR(sphere.mesh->vertexAreas()(mask.nodes).dot(mask.density), 1, 1e-14);
        EXPECT_NE(std::find(mask.nodes.begin(), mask.nodes.end(), v), mask.nodes.end());
      }
    }
}

TEST(VariationalMask, IsSymmetricBetweenItsCentreAndWhatItReaches) {
  const Surface sphere = heldSphere();
  for (MaskPenalty penalty : kPenalties) {
    const VariationalMasks masks = sphere.masks(penalty, 0.3);
    const std::vector<int> free = sphere.conditions.freeNodes();
    for (std::size_t i = 1; i < free.size(); ++i) {
      const double there = masks.column(free[i - 1])[free[i]];
      EXPECT_NEAR(there, masks.column(free[i])[free[i - 1]], 1e-12 * std::abs(there) + 1e-14);
    }
  }
}

/// Integral of e^(-x cosh s) over s: the Bessel function K0.
double besselK0(double x) {
  double sum = 0;
  for (double s = 0.0005; s < 10; s += 0.001) sum += 0.001 * std::exp(-x * std::cosh(s));
  return sum;
}

TEST(VariationalMask, OfTheGradientFallsLikeTheScreenedPotentialOfItsLength) {
  // In the plane p - alpha^2 div grad p = delta has the solution K0(r / alpha) / (2 pi alpha^2).
  const Surface sphere = freeSphere(4);
  const double alpha = 0.1;  // two edges; the sphere's curvature counts by (alpha / 1)^2
  const Eigen::VectorXd column = sphere.masks(MaskPenalty::Gradient, alpha).column(0);
  int compared = 0;
  for (int v = 0; v < sphere.mesh->vertexCount(); ++v) {
    const double r = std::acos(std::min(1., sphere.mesh->points().col(v).z()));
    if (r < alpha || r > 3 * alpha) continue;
    EXPECT_NEAR(column[v] * 2 * kPi * alpha * alpha / besselK0(r / alpha), 1, 0.1) << r;
    ++compared;
  }
  EXPECT_GT(compared, 30);
}

TEST(VariationalMask, OfTheGradientNowherePullsAndOfTheBiharmonicALittle) {
  const Surface sphere = freeSphere(3);
  const double length = 2 * sphere.mesh->meanEdgeLength();
  const Eigen::VectorXd gradient = sphere.masks(MaskPenalty::Gradient, length).column(0);
  EXPECT_GT(gradient.minCoeff(), 0);
  const Eigen::VectorXd biharmonic = sphere.masks(MaskPenalty::Biharmonic, length).column(0);
  EXPECT_LT(biharmonic.minCoeff(), 0);
  EXPECT_GT(biharmonic.minCoeff(), -0.03 * biharmonic.maxCoeff());  // -kei: -0.014 of its peak
}

TEST(VariationalMask, IsSetByAPhysicalLengthWhateverTheMesh) {
  for (MaskPenalty penalty : kPenalties) {
    double peak[2];
    for (int level : {3, 4}) {
      const Surface sphere = freeSphere(level);
      const Eigen::VectorXd column = sphere.masks(penalty, 0.4).column(0);
      // The mean within half the length; the gradient's peak itself grows like a logarithm.
      double mass = 0, area = 0;
      for (int v = 0; v < sphere.mesh->vertexCount(); ++v) {
        if (std::acos(std::min(1., sphere.mesh->points().col(v).z())) > 0.2) continue;
        mass += sphere.mesh->vertexAreas()[v] * column[v];
        area += sphere.mesh->vertexAreas()[v];
      }
      peak[level - 3] = mass / area;
    }
    EXPECT_NEAR(peak[1] / peak[0], 1, 0.1);
  }
  // In millimetres, too.
  const Shape shape = jitteredSphere(2, 0.2);
  const auto none = [](const auto&) { return false; };
  const Surface metres(shape, none), millimetres(shape.scaled(1e3), none);
  for (MaskPenalty penalty : kPenalties) {
    const Eigen::VectorXd one = metres.masks(penalty, 0.3).column(9);
    const Eigen::VectorXd other = millimetres.masks(penalty, 300).column(9);
    EXPECT_LE((one - 1e6 * other).norm(), 1e-12 * one.norm());
  }
}

TEST(VariationalMask, LeavesOutNoMoreThanItsTailAndNeverReachesAnotherComponent) {
  const Shape ball = icosphere(2);
  const Surface pair(ball.with(ball.moved({2.00001, 0, 0})), [](const auto&) { return false; });
  for (MaskPenalty penalty : kPenalties) {
    std::size_t before = 1000;
    for (double tail : {0.0, 0.01, 0.1}) {
      const VariationalMasks masks = pair.masks(penalty, 0.2, tail);
      const VertexMask mask = masks.at(5);
      const Eigen::VectorXd whole = masks.column(5);
      for (int node : mask.nodes) EXPECT_EQ(pair.mesh->shellOfVertex(node), 0);
      double kept = 0;
      for (int node : mask.nodes) kept += pair.mesh->vertexAreas()[node] * whole[node];
      EXPECT_NEAR(kept, 1, tail + 1e-12);
      EXPECT_LT(mask.nodes.size(), before);
      before = mask.nodes.size();
    }
  }
}

TEST(VariationalMask, ReportsWhatWouldHaveFallenOnTheSupport) {
  const Surface held = heldSphere();
  const Surface whole(jitteredSphere(2, 0.2), [](const auto&) { return false; });
  for (MaskPenalty penalty : kPenalties) {
    const VariationalMasks masks = held.masks(penalty, 0.2), uncut = whole.masks(penalty, 0.2);
    EXPECT_LT(masks.at(0).supportShare, 1e-3) << "at the north pole";
    double largest = 0;
    for (int v : held.conditions.freeNodes()) {
      const Eigen::VectorXd column = uncut.column(v);
      double share = 0;
      for (int u : held.conditions.fixedNodes()) share += whole.mesh->vertexAreas()[u] * column[u];
      EXPECT_NEAR(masks.at(v).supportShare, std::max(0., share), 1e-12);
      EXPECT_EQ(uncut.at(v).supportShare, 0);
      largest = std::max(largest, share);
    }
    EXPECT_GT(largest, 0.2);
  }
}

TEST(MaskSettings, MakeTheMasksTheyDescribe) {
  const Surface sphere = heldSphere();
  const auto make = [&](MaskKind kind, double radius) {
    return makeMasks(*sphere.mesh, sphere.conditions, {kind, radius, MaskDistance::Euclidean});
  };
  const auto expectSame = [](const VertexMask& a, const VertexMask& b) {
    EXPECT_EQ(a.nodes, b.nodes);
    EXPECT_EQ(a.density, b.density);
  };
  for (MaskShape shape :
       {MaskShape::Linear, MaskShape::Uniform, MaskShape::Gaussian, MaskShape::Hertzian})
    expectSame(make(static_cast<MaskKind>(shape), 0.5)->at(0),
               PressureMasks(*sphere.mesh, sphere.conditions, shape, 0.5).at(0));
  const auto length = VariationalMasks::lengthForRadius;
  EXPECT_NEAR(length(MaskPenalty::Gradient, 0.6), 0.6 * kPi / 6, 1e-15);
  EXPECT_NEAR(length(MaskPenalty::Biharmonic, 0.6), 0.6 * kPi / 6 / std::sqrt(2.), 1e-15);
  expectSame(make(MaskKind::Gradient, 0.6)->at(0),
             sphere.masks(MaskPenalty::Gradient, length(MaskPenalty::Gradient, 0.6)).at(0));
  expectSame(make(MaskKind::Biharmonic, 0.6)->at(0),
             sphere.masks(MaskPenalty::Biharmonic, length(MaskPenalty::Biharmonic, 0.6)).at(0));
  EXPECT_TRUE(isRefused([&] { make(MaskKind::Biharmonic, 0); },
                        "a variational mask needs a radius above 0, not 0"));
}

TEST(VariationalMask, WithoutALengthIsRefused) {
  const Surface sphere = heldSphere();
  for (double length : {0.0, -1.0, double(NAN), double(INFINITY), 100.0})
    EXPECT_TRUE(isRefused([&] { sphere.masks(MaskPenalty::Gradient, length); },
                          "the length of a variational mask must be above 0 and at most"));
  EXPECT_TRUE(isRefused([&] { sphere.masks(MaskPenalty::Gradient, 0.1, 0.5); },
                        "the tail of a variational mask must be 0 to 0.5, not 0.5"));
  const int fixed = sphere.conditions.fixedNodes().front();
  const VariationalMasks masks = sphere.masks(MaskPenalty::Gradient, 0.1);
  EXPECT_TRUE(isRefused([&] { masks.at(fixed); }, "is fixed: a pressure mask needs a free node"));
  EXPECT_TRUE(isRefused([&] { masks.densityAt({-1, {1, 0, 0}}); }, "there is no triangle -1"));
}

TEST(VariationalMask, SmoothsAWaveByItsWaveNumberAndKeepsConstantsAndTheIntegral) {
  // On the unit sphere div grad of a spherical harmonic of degree l is -l (l + 1) times it.
  const Surface sphere = freeSphere(4);
  const Eigen::Matrix3Xd& x = sphere.mesh->points();
  const Eigen::VectorXd first = x.row(2), second = (x.row(0).array() * x.row(1).array());
  const double length = 0.4;
  for (MaskPenalty penalty : kPenalties) {
    const VariationalMasks masks = sphere.masks(penalty, length);
    const auto passed = [&](double degree) {
      const double square = length * length * degree * (degree + 1);
      return 1 / (1 + (penalty == MaskPenalty::Gradient ? square : square * square));
    };
    // Within the square of the edge, 0.07.
    EXPECT_LT((masks.smoothed(first) - passed(1) * first).norm(), 0.01 * first.norm());
    EXPECT_LT((masks.smoothed(second) - passed(2) * second).norm(), 0.01 * second.norm());
  }
  const Surface held = heldSphere();
  const VariationalMasks masks = held.masks(MaskPenalty::Biharmonic, length);
  const Eigen::VectorXd field = held.mesh->points().row(0).transpose().array().exp();
  double before = 0;
  for (int v : held.conditions.freeNodes()) before += held.mesh->vertexAreas()[v] * field[v];
  EXPECT_NEAR(held.force(masks.smoothed(field)) / before, 1, 1e-11);
  const Eigen::VectorXd ones = masks.smoothed(Eigen::VectorXd::Ones(field.size()));
  for (int v : held.conditions.freeNodes()) EXPECT_NEAR(ones[v], 1, 1e-10);
  EXPECT_THROW(masks.smoothed(Eigen::VectorXd::Ones(3)), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::test
