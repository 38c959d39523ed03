// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/elastic_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "mesh/smooth_patches.h"
#include "mesh/wall_thickness.h"
#include "model/support.h"
#include "support/problems.h"
#include "support/refusals.h"
#include "support/soups.h"

namespace palpate::test {
namespace {

bool isBase(const Eigen::Vector3d& x) {
  return x.z() < 1e-9;
}
bool nowhere(const Eigen::Vector3d&) {
  return false;
}
bool everywhere(const Eigen::Vector3d&) {
  return true;
}

Shape cube() {
  return box({1, 1, 1}, {4, 4, 4});
}

ElasticModel modelOf(const Shape& shape, std::vector<unsigned char> types, Eigen::VectorXi patches,
                     double youngsModulus = 1, double poissonRatio = 0.3,
                     Domain domain = Domain::Interior) {
  return ElasticModel(shape.mesh(), Material(youngsModulus, poissonRatio),
                      BoundaryConditions(std::move(types)), std::move(patches), domain);
}

TEST(ElasticModel, WithoutAFreeNodeIsRefused) {
  EXPECT_EQ(refusal([] { makeModel(cube(), everywhere, 1, 0.3); }),
            "the model has no free node: there is nothing that could be touched");
}

TEST(ElasticModel, WithoutSupportIsRefused) {
  EXPECT_TRUE(
      contains(refusal([] { makeModel(cube(), nowhere, 1, 0.3); }),
               "the body of vertex 0 has no fixed node, which leaves a rigid motion free ("));
}

TEST(ElasticModel, AnUnsupportedComponentIsRefusedByItsFirstVertex) {
  // The second cube hangs above the plane that fixes the first.
  EXPECT_TRUE(contains(refusal([] {
                         makeModel(cube().with(cube().moved({0, 0, 2})), isBase, 1, 0.3);
                       }),
                       "the body of vertex " + std::to_string(cube().points.cols()) +
                           " has no fixed node, which leaves a rigid motion free ("));
}

TEST(ElasticModel, AWrongBoundaryTypeIsRefusedByItsNode) {
  std::vector<unsigned char> types = fixedWhere(cube(), isBase);
  types[5] = 7;
  EXPECT_EQ(refusal([&] { modelOf(cube(), types, Eigen::VectorXi::Zero(192)); }),
            "the boundary type of node 5 must be 0 (free) or 1 (fixed), not 7");
}

TEST(ElasticModel, ArraysOfAnotherMeshAreRefusedWithBothCounts) {
  const std::vector<unsigned char> types = fixedWhere(cube(), isBase);
  ASSERT_EQ(types.size(), 98u);
  EXPECT_EQ(refusal([&] {
              modelOf(cube(), {1, 1, 1, 0}, Eigen::VectorXi::Zero(192));
            }),
            "there are 4 boundary types for 98 vertices");
  EXPECT_EQ(refusal([&] { modelOf(cube(), types, Eigen::VectorXi::Zero(98)); }),
            "there are 98 smooth patch numbers for 192 triangles");
}

TEST(ElasticModel, AnExteriorDomainNeedsNoSupport) {
  EXPECT_NO_THROW(makeModel(icosphere(1), nowhere, 1, 0.3, 30, Domain::Exterior));
}

TEST(ElasticModel, AnExteriorDomainHasNoNestedSurfaces) {
  EXPECT_EQ(refusal([] { makeModel(hollowSphere(1, 0.5), nowhere, 1, 0.3, 30, Domain::Exterior); }),
            "in an exterior domain no surface may lie inside another: the material is outside all");
}

TEST(ElasticModel, FingerprintKnowsEverythingButYoungsModulus) {
  const Shape shape = cube();
  const std::vector<unsigned char> types = fixedWhere(shape, isBase);
  const Eigen::VectorXi patches = findSmoothPatches(*shape.mesh(), 30);
  const std::uint64_t original = modelOf(shape, types, patches).fingerprint();
  EXPECT_EQ(modelOf(shape, types, patches, 1e9).fingerprint(), original);
  EXPECT_NE(modelOf(shape, types, patches, 1, 0.31).fingerprint(), original);
  EXPECT_NE(modelOf(shape, types, patches, 1, 0.3, Domain::Exterior).fingerprint(), original);
  EXPECT_NE(modelOf(shape, types, Eigen::VectorXi::Zero(patches.size())).fingerprint(), original);
  EXPECT_NE(modelOf(shape.scaled(2), types, patches).fingerprint(), original);
  for (std::size_t v = 0; v < types.size(); ++v) {
    std::vector<unsigned char> others = types;
    others[v] = 1 - others[v];
    EXPECT_NE(modelOf(shape, others, patches).fingerprint(), original) << "node " << v;
  }
}

struct Warnings {
  double wallRatio, supportWidth;
  std::vector<std::string> sentences;
  explicit Warnings(const ElasticModel& model)
      : sentences(modelWarnings(model, wallRatio, supportWidth)) {}
};

std::string threeDigits(double x) {
  std::ostringstream text;
  text.precision(3);
  text << x;
  return text.str();
}

TEST(ModelWarnings, AWellResolvedBlockHasNone) {
  const Warnings warnings(makeModel(box({1, 1, 1}, {6, 6, 6}), isBase, 1, 0.3));
  EXPECT_TRUE(warnings.sentences.empty());
  EXPECT_GT(warnings.supportWidth, 3);
}

TEST(ModelWarnings, ASmallSupportIsNamedWithItsWidth) {
  const ElasticModel model = makeModel(
      box({1, 1, 1}, {6, 6, 6}),
      [](const Eigen::Vector3d& x) { return isBase(x) && x.x() < 0.2 && x.y() < 0.2; }, 1, 0.3);
  const Warnings warnings(model);
  ASSERT_EQ(warnings.sentences.size(), 1u);
  EXPECT_EQ(warnings.supportWidth, supportWidthInEdges(model.mesh(), model.conditions()));
  EXPECT_LT(warnings.supportWidth, 2);
  EXPECT_EQ(
      warnings.sentences[0],
      "a support is only " + threeDigits(warnings.supportWidth) +
          " edges wide: its compliance depends on the mesh; fix an area at least 3 edges wide");
}

TEST(ElasticModel, WhatAMatrixIsGivenOfMayHaveRimsAndNoSupport) {
  const auto mesh = plate(1, 2).sheet();
  const auto model = [&](Domain domain, unsigned char type) {
    std::vector<unsigned char> types(mesh->vertexCount(), 0);
    types[3] = type;
    return ElasticModel(mesh, Material(1, 0), BoundaryConditions(types),
                        Eigen::VectorXi::Zero(mesh->triangleCount()), domain);
  };
  EXPECT_NE(model(Domain::Given, 0).fingerprint(), model(Domain::HalfSpace, 0).fingerprint());
  EXPECT_EQ(model(Domain::Given, 1).conditions().fixedNodes(), std::vector<int>{3});
  EXPECT_TRUE(isRefused([&] { model(Domain::Exterior, 0); }, "a sheet with rims"));
}

TEST(ModelWarnings, AnExteriorDomainHasNeitherWallsNorSupport) {
  const Warnings warnings(
      makeModel(box({1, 1, 0.01}, {4, 4, 1}), nowhere, 1, 0.3, 30, Domain::Exterior));
  EXPECT_TRUE(warnings.sentences.empty());
  EXPECT_EQ(warnings.wallRatio, -1);
  EXPECT_EQ(warnings.supportWidth, -1);
}

#ifdef PALPATE_WITH_CGAL
/// A plate of this height with edges up to 0.1 sqrt 2, clamped along a broad strip.
Warnings plateWarnings(double height) {
  return Warnings(makeModel(
      box({1, 1, height}, {10, 10, 1}), [](const Eigen::Vector3d& x) { return x.x() < 0.45; }, 1,
      0.3));
}

TEST(ModelWarnings, AThinWallIsNamedWithItsRatio) {
  const Warnings warnings = plateWarnings(0.14);
  ASSERT_EQ(warnings.sentences.size(), 1u);
  EXPECT_NEAR(warnings.wallRatio, 0.1 * std::sqrt(2.0) / 0.14, 1e-12);
  EXPECT_TRUE(contains(warnings.sentences[0], "the wall at triangle "));
  EXPECT_TRUE(contains(warnings.sentences[0],
                       " is thin for the mesh (edge over thickness 1.01): if it bends, compare "
                       "with a finer mesh"));
}

TEST(ModelWarnings, AWallThinnerThanTheEdgesIsNamedWithACure) {
  const Warnings warnings = plateWarnings(0.05);
  ASSERT_EQ(warnings.sentences.size(), 1u);
  EXPECT_NEAR(warnings.wallRatio, 2 * std::sqrt(2.0), 1e-12);
  EXPECT_TRUE(contains(warnings.sentences[0],
                       " is thinner than the edges there (edge over thickness 2.83): it is too "
                       "stiff in bending; refine until edges are shorter than the wall is thick"));
}
#else
TEST(ModelWarnings, WithoutCgalWallsAreNotMeasured) {
  EXPECT_EQ(Warnings(makeModel(cube(), isBase, 1, 0.3)).wallRatio, -1);
}
#endif

}  // namespace
}  // namespace palpate::test
