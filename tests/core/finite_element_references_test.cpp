// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The chain from a surface over its tetrahedra to compliances, against closed forms and against an
// independent solver.

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/LU>

#include "contact/pressure_mask.h"
#include "contact/surface_stiffness.h"
#include "fem/finite_element_method.h"
#include "mesh/mesh_defects.h"
#include "mesh/tetrahedralization.h"
#include "support/clamped_sphere.h"
#include "support/mask_compliances.h"
#include "support/refusals.h"
#include "support/solids.h"
#include "support/soups.h"

namespace palpate::test {
namespace {

VertexMask poleMask(const ElasticModel& model) {
  Eigen::Index pole;
  model.mesh().points().row(2).maxCoeff(&pole);
  return PressureMasks(model.mesh(), model.conditions(), MaskShape::Linear, kMaskRadius)
      .at(static_cast<int>(pole));
}

/// The compliance at the pole, m/N.
Eigen::Matrix3d poleCompliance(const SolidProblem& problem) {
  const VertexMask mask = poleMask(problem.model);
  FiniteElementOptions options;
  options.columns = mask.nodes;
  Eigen::Index pole;
  problem.model.mesh().points().row(2).maxCoeff(&pole);
  return maskedVertexStiffness(*problem.greens(options), static_cast<int>(pole), mask)
      .stiffness.inverse();
}

SolidProblem clampedSphere(double underMask, double poissonRatio) {
  const TetrahedralMesh mesh = tetrahedralize(*gradedMesh(underMask, 0.3 * underMask).mesh()).mesh;
  return solidProblem(mesh, clamped, 1, poissonRatio);
}

class FiniteElementSphere : public testing::TestWithParam<ClampedSphereReference> {};

TEST_P(FiniteElementSphere, PoleYieldsAsTheReference) {
  const auto errors = [](double underMask) {
    const SolidProblem problem = clampedSphere(underMask, GetParam().poissonRatio);
    const Eigen::Matrix3d compliance = poleCompliance(problem);
    // The sphere is round: no direction along the surface is special, nor coupled to the normal.
    EXPECT_NEAR(compliance(1, 1) / compliance(0, 0), 1, 0.01);
    EXPECT_LT(std::abs(compliance(0, 2)), 0.01 * compliance(2, 2));
    const Eigen::Vector2d found(compliance(2, 2) / GetParam().normal - 1,
                                compliance(0, 0) / GetParam().tangential - 1);
    return found;
  };
  const Eigen::Vector2d coarse = errors(0.12), fine = errors(0.07);
  EXPECT_LT(std::abs(coarse[0]), 0.03);
  EXPECT_LT(std::abs(coarse[1]), 0.06);
  EXPECT_LT(std::abs(fine[0]), 0.015);
  EXPECT_LT(std::abs(fine[1]), 0.04);
  EXPECT_LT(std::abs(fine[1]), 0.9 * std::abs(coarse[1]));  // the clamp line's singularity is slow
}

INSTANTIATE_TEST_SUITE_P(References, FiniteElementSphere,
                         testing::ValuesIn(kClampedSphereReferences));

class FiniteElementPoissonRatio : public testing::TestWithParam<double> {};

/// A2: the field of a point force outside the body, its displacement given at the cap.
TEST_P(FiniteElementPoissonRatio, PointSourceOutsideTheBodyConverges) {
  const auto errorOf = [](int levels) {
    const SolidProblem problem =
        solidProblem(tetrahedralize(*icosphere(levels).mesh()).mesh, cap, 1, GetParam());
    const auto greens = problem.greens(allColumns(problem.model));
    const NodalField exact = pointSourceField(problem.model);
    Eigen::Matrix3Xd given = exact.traction;
    for (int v : problem.model.conditions().fixedNodes()) given.col(v) = exact.displacement.col(v);
    return relativeError(solveReferenceProblem(*greens, given), exact.displacement, problem.model,
                         [&](int v) { return !problem.model.conditions().isFixed(v); });
  };
  const double coarse = errorOf(2), fine = errorOf(3);
  EXPECT_LT(fine, 0.006);  // measured 0.35 %, of order 1.6
  EXPECT_GT(convergenceOrder(coarse, 162, fine, 642), 1.4);
}

/// A8: a thick sphere under inner pressure, the exact displacement given at parts of the outer
/// surface.
TEST_P(FiniteElementPoissonRatio, InnerPressureOpensAThickSphereAsInClosedForm) {
  const double nu = GetParam();
  const Shape shape = icosphere(2).scaled(2).with(icosphere(2).flipped());
  const SolidProblem problem = solidProblem(
      tetrahedralize(*shape.mesh()).mesh,
      [](const Eigen::Vector3d& x) { return x.z() > 1.9 || x.x() > 1.95; }, 1, nu);
  const ElasticModel& model = problem.model;
  const auto greens = problem.greens(allColumns(model));
  const auto [exact, given] = thickSphere(model);
  const double error = relativeError(solveReferenceProblem(*greens, given), exact, model,
                                     [&](int v) { return !model.conditions().isFixed(v); });
  EXPECT_LT(error,
            0.04);  // measured 2.9 to 3.3 %: most of it is the polyhedra's, of 162 vertices each
}

INSTANTIATE_TEST_SUITE_P(Materials, FiniteElementPoissonRatio, testing::Values(0.3, 0.499, 0.5));

/// Two meshes of which one fills a cavity of the other.
Solid glued(const TetrahedralMesh& outer, const TetrahedralMesh& inner) {
  Eigen::Matrix3Xd all(3, outer.pointCount() + inner.pointCount());
  all << outer.points(), inner.points();
  const std::vector<int> twin = nearestDuplicates(all, 1e-9);
  std::vector<int> number(all.cols());
  Solid solid{all, Eigen::Matrix4Xi(4, outer.cellCount() + inner.cellCount())};
  int count = 0;
  for (int i = 0; i < all.cols(); ++i) {
    number[i] = twin[i] == i ? count++ : number[twin[i]];
    solid.points.col(number[i]) = all.col(i);
  }
  solid.points.conservativeResize(3, count);
  solid.tetrahedra << outer.tetrahedra(),
      (inner.tetrahedra().array() + outer.pointCount()).matrix();
  for (int& corner : solid.tetrahedra.reshaped()) corner = number[corner];
  return solid;
}

TEST(FiniteElementsOfTwoMaterials, YieldAsTheReferenceOfASphereWithAHardCore) {
  // As large as the sphere that it stands for.
  const Shape unit = icosphere(2);
  const double ball = 4.0 / 3 * std::acos(-1.0);
  const Shape core = unit.scaled(0.5 * std::cbrt(ball / signedVolume(unit.points, unit.triangles)));
  const Tetrahedralization outside =
      tetrahedralize(*gradedMesh(0.08, 0.025).with(core.flipped()).mesh());
  const Tetrahedralization inside = tetrahedralize(*core.mesh());
  ASSERT_EQ(inside.lostTriangles, 0);
  const TetrahedralMesh mesh = glued(outside.mesh, inside.mesh).mesh();
  std::vector<int> material(mesh.cellCount(), 0);
  for (int t = outside.mesh.cellCount(); t < mesh.cellCount(); ++t) material[t] = 1;
  const auto complianceOf = [&](double core) {
    const ElasticModel model = makeModel(boundaryOf(mesh), clamped, 1, 0.3);
    return poleCompliance(
        {model, SolidBody(model.mesh(), mesh,
                          {Elasticity(Material(1, 0.3)), Elasticity(Material(core, 0.3))},
                          material)})(2, 2);
  };
  const double hard = complianceOf(10), same = complianceOf(1);  // measured -0.9 and -0.1 %
  EXPECT_NEAR(hard / 2.722950, 1, 0.02);
  EXPECT_NEAR(same / 3.137999, 1, 0.02);
}

}  // namespace
}  // namespace palpate::test
