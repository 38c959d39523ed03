// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/stiffness_artifacts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>

#include "contact/surface_stiffness.h"
#include "mesh/loop_subdivision.h"
#include "support/data_models.h"
#include "support/problems.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

struct Sphere {
  explicit Sphere(const Shape& shape, double radius = 1)
      : mesh(shape.mesh()),
        conditions(fixedWhere(shape, [radius](const auto& x) { return x.z() < -0.79 * radius; })) {}
  /// A field of |K|, NaN where fixed.
  Eigen::VectorXd field(const std::function<double(int)>& value) const {
    Eigen::VectorXd norms = Eigen::VectorXd::Constant(mesh->vertexCount(), kNothing);
    for (int v : conditions.freeNodes()) norms[v] = value(v);
    return norms;
  }
  StiffnessArtifacts artifacts(const Eigen::VectorXd& norms, double length = 0.5) const {
    return findStiffnessArtifacts(*mesh, conditions, norms, length);
  }
  std::shared_ptr<const SurfaceMesh> mesh;
  BoundaryConditions conditions;
};

TEST(StiffnessArtifacts, AUniformFieldHasNone) {
  const Sphere sphere(jitteredSphere(2, 0.2));
  const StiffnessArtifacts found = sphere.artifacts(sphere.field([](int) { return 3.; }));
  EXPECT_LT(found.variation, 1e-9);  // rounding of the sparse solve
  EXPECT_EQ(found.largestJump, 0);
  EXPECT_EQ(found.areaCorrelation, 0);
  EXPECT_EQ(found.vertices, static_cast<int>(sphere.conditions.freeNodes().size()));
  for (int v : sphere.conditions.fixedNodes()) EXPECT_TRUE(std::isnan(found.smooth[v]));
}

TEST(StiffnessArtifacts, AFieldThatGrowsWithTheAreasCorrelatesWhollyAndTheUnitDoesNotMatter) {
  const Shape shape = jitteredSphere(2, 0.2);
  const Sphere sphere(shape), inMillimetres(shape.scaled(1e3), 1e3);
  const auto root = [](const Sphere& s) {
    return [&s](int v) { return std::sqrt(s.mesh->vertexAreas()[v]); };
  };
  const StiffnessArtifacts found = sphere.artifacts(sphere.field(root(sphere)));
  EXPECT_NEAR(found.areaCorrelation, 1, 1e-12);
  EXPECT_GT(found.variation, 0.05);
  const StiffnessArtifacts scaled =
      inMillimetres.artifacts(inMillimetres.field(root(inMillimetres)), 500);
  EXPECT_NEAR(scaled.variation, found.variation, 1e-8 * found.variation);
  EXPECT_NEAR(scaled.largestJump, found.largestJump, 1e-9);
}

TEST(StiffnessArtifacts, SmoothVariationIsTheBodysAndNoiseIsTheMeshs) {
  const Sphere sphere(icosphere(3));
  const auto wave = [&](int v) { return std::exp(0.3 * sphere.mesh->points()(0, v)); };
  const double smooth = sphere.artifacts(sphere.field(wave)).variation;
  const double noisy =
      sphere.artifacts(sphere.field([&](int v) { return wave(v) * (v % 2 ? 1.1 : 1 / 1.1); }))
          .variation;
  EXPECT_LT(smooth, 0.04);  // a wave of degree 1 passes by 80 %: 0.2 of 0.3 / sqrt(3) = 0.17
  EXPECT_NEAR(noisy, 0.095, 0.01);
}

TEST(StiffnessArtifacts, OneVertexOffJumpsByItsShareAndIsNamed) {
  const Sphere sphere(icosphere(2));
  const int odd = sphere.conditions.freeNodes().back();
  const StiffnessArtifacts found =
      sphere.artifacts(sphere.field([&](int v) { return v == odd ? 3. : 1.; }));
  EXPECT_NEAR(found.largestJump, 1, 1e-12);  // |3 - 1| over 2
  EXPECT_TRUE(found.jumpFrom == odd || found.jumpTo == odd);
  EXPECT_NEAR(found.jump[odd], 1, 1e-12);
}

TEST(StiffnessArtifacts, AVertexWithoutStiffnessIsLeftOut) {
  const Sphere sphere(jitteredSphere(2, 0.2));
  Eigen::VectorXd norms = sphere.field([](int) { return 2.; });
  const int missing = sphere.conditions.freeNodes()[7];
  norms[missing] = kNothing;
  const StiffnessArtifacts found = sphere.artifacts(norms);
  EXPECT_LT(found.variation, 1e-9);
  EXPECT_TRUE(std::isnan(found.artifact[missing]));
}

TEST(StiffnessArtifacts, RefusesWhatIsNoField) {
  const Sphere sphere(icosphere(1));
  const Eigen::VectorXd fine = sphere.field([](int) { return 1.; });
  const Eigen::VectorXd none = sphere.field([](int) { return kNothing; });
  const Eigen::VectorXd zero = sphere.field([](int) { return 0.; });
  EXPECT_THROW(sphere.artifacts(none), std::invalid_argument);
  EXPECT_THROW(sphere.artifacts(zero), std::invalid_argument);
  EXPECT_THROW(sphere.artifacts(Eigen::VectorXd::Ones(3)), std::invalid_argument);
  for (double length : {0., -1., 100., kNothing})
    EXPECT_THROW(sphere.artifacts(fine, length), std::invalid_argument) << length;
}

TEST(RankCorrelation, IsOneOfAnyRisingFunctionAndMinusOneOfAnyFallingOne) {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(20, -2, 3);
  EXPECT_NEAR(rankCorrelation(x, x.array().exp()), 1, 1e-12);
  EXPECT_NEAR(rankCorrelation(x, -x.array().cube()), -1, 1e-12);
  EXPECT_EQ(rankCorrelation(x, Eigen::VectorXd::Ones(20)), 0);
}

TEST(RankCorrelation, GivesTiesTheirMeanRank) {
  // Ranks 0, 1.5, 1.5, 3 against 0, 1, 2, 3: sum of products 4.5 over sqrt(4.5 * 5).
  const Eigen::Vector4d tied(1, 2, 2, 7), plain(1, 2, 3, 4);
  EXPECT_NEAR(rankCorrelation(tied, plain), 4.5 / std::sqrt(22.5), 1e-12);
}

TEST(PrincipalStiffness, ComposesTheMatrixAgainAndPointsOutwards) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Matrix3d stiffness = turn * Eigen::Vector3d(2, 8, 4).asDiagonal() * turn.transpose();
  const Eigen::Vector3d outward(-1, 0.2, -0.3);
  const PrincipalStiffness found = principalStiffness(stiffness, outward);
  EXPECT_LT((found.values - Eigen::Vector3d(8, 4, 2)).norm(), 1e-13);
  EXPECT_NEAR(found.condition, 4, 1e-13);
  EXPECT_LT(
      (found.directions * found.values.asDiagonal() * found.directions.transpose() - stiffness)
          .norm(),
      1e-13);
  for (int k = 0; k < 3; ++k) EXPECT_GE(found.directions.col(k).dot(outward), 0);
}

TEST(PointSingularity, FindsTheBodyAndTheLawThatMadeTheCompliances) {
  const Eigen::Vector4d sizes(0.1, 0.05, 0.02, 0.01);
  const Eigen::Vector4d both = 3 + 0.4 * sizes.cwiseInverse().array();
  const PointSingularity found = fitPointSingularity(sizes, both);
  EXPECT_NEAR(found.body, 3, 1e-10);
  EXPECT_NEAR(found.coefficient, 0.4, 1e-11);
  EXPECT_NEAR(found.fit, 1, 1e-12);
  EXPECT_LT(found.exponent, 1);  // the body's share flattens the power law
  const PointSingularity pure = fitPointSingularity(sizes, 0.4 * sizes.cwiseInverse());
  EXPECT_NEAR(pure.exponent, 1, 1e-12);
  EXPECT_THROW(fitPointSingularity(Eigen::Vector2d(1, 1), Eigen::Vector2d(1, 2)),
               std::invalid_argument);
  EXPECT_THROW(fitPointSingularity(Eigen::Vector2d(1, 2), Eigen::Vector2d(1, 0)),
               std::invalid_argument);
}

TEST(CompareStiffness, OfOneFieldOnTwoMeshesIsTheInterpolationsError) {
  // K = (2 + z) I on two unrelated meshes of the sphere: they differ by second order in the edge.
  const Sphere coarse(jitteredSphere(2, 0.2)), fine(jitteredSphere(3, 0.2, 5));
  const auto at = [](const Sphere& s) {
    return [&s](int v) { return std::sqrt(3) * (2 + s.mesh->points()(2, v)); };
  };
  std::vector<Eigen::Matrix3d> there(fine.mesh->vertexCount(), Eigen::Matrix3d::Constant(kNothing));
  for (int v : fine.conditions.freeNodes())
    there[v] = (2 + fine.mesh->points()(2, v)) * Eigen::Matrix3d::Identity();
  const SurfaceLocator locator(fine.mesh);
  const StiffnessChange same =
      compareStiffness(*coarse.mesh, coarse.field(at(coarse)), locator, there);
  EXPECT_GT(same.matched, 0.9 * coarse.conditions.freeNodes().size());
  EXPECT_LT(same.ninetyFifth, 0.02);
  const StiffnessChange stiffer =
      compareStiffness(*coarse.mesh, 1.5 * coarse.field(at(coarse)), locator, there);
  EXPECT_NEAR(stiffer.median, 1.5 * (1 + same.median) - 1, 1e-12);
  EXPECT_NEAR(stiffer.variation, same.variation, 1e-12);
}

TEST(CompareStiffness, DoesNotTakeTheFarSideOfAThinPlateForTheSamePoint) {
  // The other plate hangs below: its top is nearest to this one's bottom, whose normal is opposite.
  const Shape plate = box({1, 1, 0.05}, {8, 8, 1}), below = plate.moved({0, 0, -0.06});
  const auto mesh = plate.mesh(), other = below.mesh();
  Eigen::VectorXd norms = Eigen::VectorXd::Constant(mesh->vertexCount(), kNothing);
  for (int v = 0; v < mesh->vertexCount(); ++v) {
    const Eigen::Vector3d x = mesh->points().col(v);
    if (x.z() == 0 && x.x() > 0.2 && x.x() < 0.8 && x.y() > 0.2 && x.y() < 0.8) norms[v] = 1;
  }
  const std::vector<Eigen::Matrix3d> there(other->vertexCount(), Eigen::Matrix3d::Identity());
  EXPECT_THROW(compareStiffness(*mesh, norms, SurfaceLocator(other), there), std::invalid_argument);
}

/// The kidney of [JP01] fig. 7 at the paper's level: 322 vertices.
class KidneyArtifacts : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    DataModel data = readDataModel("kidney");
    for (int step = 0; step < 2; ++step) {
      const SubdivisionLevel finer = subdivideLoop(*data.shape.mesh());
      data.boundaryTypes = refineBoundaryTypes(finer, data.boundaryTypes);
      data.shape = {finer.points, finer.triangles};
    }
    mesh_ = data.shape.mesh();
    const ElasticModel model(mesh_, Material(data.youngsModulus, data.poissonRatio),
                             BoundaryConditions(data.boundaryTypes),
                             Eigen::VectorXi::Zero(mesh_->triangleCount()));
    greens_ = computeGreens(model, {});
  }
  static void TearDownTestSuite() {
    mesh_.reset();
    greens_.reset();
  }
  static StiffnessArtifacts under(double radius) {
    const SurfaceStiffness stiffness(greens_, mesh_, MaskShape::Linear, radius);
    Eigen::VectorXd norms = Eigen::VectorXd::Constant(mesh_->vertexCount(), kNothing);
    for (int v = 0; v < mesh_->vertexCount(); ++v)
      if (!greens_->isFixed(v)) norms[v] = stiffness.elastic(v).norm();
    return findStiffnessArtifacts(*mesh_, greens_->info().conditions, norms,
                                  0.1 * mesh_->diagonal());
  }
  static inline std::shared_ptr<const SurfaceMesh> mesh_;
  static inline std::shared_ptr<const GreensFunctions> greens_;
};

TEST_F(KidneyArtifacts, ShowTheAreasAtSingleVerticesAndNotUnderMasks) {
  // Fig. 7: masks of two mean edges.
  const StiffnessArtifacts single = under(0), masked = under(2 * mesh_->meanEdgeLength());
  RecordProperty("single", std::to_string(single.areaCorrelation) + " " +
                               std::to_string(single.variation) + " " +
                               std::to_string(single.largestJump));
  RecordProperty("masked", std::to_string(masked.areaCorrelation) + " " +
                               std::to_string(masked.variation) + " " +
                               std::to_string(masked.largestJump));
  EXPECT_GT(single.areaCorrelation, 0.8);
  EXPECT_LT(std::abs(masked.areaCorrelation), 0.2);
  EXPECT_LT(masked.variation, 0.7 * single.variation);
  EXPECT_LT(masked.largestJump, 0.8 * single.largestJump);
}

}  // namespace
}  // namespace palpate::test
