// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Solid finite elements of which single components are held, as planes of symmetry hold them.

#include <gtest/gtest.h>

#include <cmath>

#include "bem/interior_probes.h"
#include "fem/finite_element_method.h"
#include "support/refusals.h"
#include "support/solids.h"

namespace palpate::test {
namespace {

bool onBase(const Eigen::Vector3d& x) {
  return x.z() < 1e-9;
}

/// The block [-1, 1] by [0, 1] by [0, 1.5], its cells mirrored at x = 0, or its half of x > 0.
TetrahedralMesh block(bool isWhole) {
  const Solid half = kuhnBox({1, 1, 1.5}, {3, 3, 4});
  if (!isWhole) return half.mesh();
  Solid whole{Eigen::Matrix3Xd(3, 0), Eigen::Matrix4Xi(4, 2 * half.tetrahedra.cols())};
  std::vector<Eigen::Vector3d> points;
  std::vector<int> mirrored;
  for (const auto& x : half.points.colwise()) points.push_back(x);
  for (const auto& x : half.points.colwise()) {
    mirrored.push_back(x.x() < 1e-9 ? static_cast<int>(mirrored.size())
                                    : static_cast<int>(points.size()));
    if (x.x() >= 1e-9) points.emplace_back(-x.x(), x.y(), x.z());
  }
  whole.points.resize(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) whole.points.col(i) = points[i];
  whole.tetrahedra.leftCols(half.tetrahedra.cols()) = half.tetrahedra;
  for (int t = 0; t < half.tetrahedra.cols(); ++t) {
    Eigen::Vector4i cell;
    for (int k = 0; k < 4; ++k) cell[k] = mirrored[half.tetrahedra(k, t)];
    std::swap(cell[0], cell[1]);
    whole.tetrahedra.col(half.tetrahedra.cols() + t) = cell;
  }
  return whole.mesh();
}

HeldDisplacements acrossThePlane(const ElasticModel& model) {
  HeldDisplacements held(3, model.mesh().vertexCount());
  for (int v = 0; v < held.cols(); ++v)
    held.col(v) << (model.mesh().points()(0, v) < 1e-9), false, false;
  return held;
}

/// Displacements under a slanting traction on the top.
Eigen::Matrix3Xd underTraction(const ElasticModel& model, const GreensFunctions& greens) {
  Eigen::Matrix3Xd tractions = Eigen::Matrix3Xd::Zero(3, model.mesh().triangleCount()), applied;
  for (int f = 0; f < tractions.cols(); ++f)
    if (model.mesh().triangleNormals()(2, f) > 0.5) tractions.col(f) << 0, 0.4, -1;
  return solveFaceTractions(greens, model.mesh(), model.smoothPatches(), tractions, applied);
}

class HeldDisplacementsOf : public testing::TestWithParam<SolidElement> {};

TEST_P(HeldDisplacementsOf, AHalfMakeItMoveAsTheWholeUnderASymmetricLoad) {
  FiniteElementOptions options;
  options.element = GetParam();
  options.patchColumns = true;
  options.reciprocal = false;
  const SolidProblem whole = solidProblem(block(true), onBase, 1, 0.3),
                     half = solidProblem(block(false), onBase, 1, 0.3);
  const Eigen::Matrix3Xd ofWhole = underTraction(whole.model, *whole.greens(options));
  options.held = acrossThePlane(half.model);
  const Eigen::Matrix3Xd ofHalf = underTraction(half.model, *half.greens(options));
  // Linear displacements are what vertices show. Of quadratic ones they show the nearest linear,
  // and the plane of symmetry belongs to the surface of the half alone: 1.2 %.
  const double tolerance = GetParam() == SolidElement::Linear ? 1e-11 : 0.02;
  double largest = 0;
  for (int v : half.model.conditions().freeNodes()) {
    const Eigen::Vector3d x = half.model.mesh().points().col(v);
    Eigen::Index same;
    if ((whole.model.mesh().points().colwise() - x).colwise().norm().minCoeff(&same) > 1e-12)
      continue;  // inside the whole
    largest = std::max(largest, (ofHalf.col(v) - ofWhole.col(same)).norm());
  }
  EXPECT_LT(largest, tolerance * ofWhole.colwise().norm().maxCoeff());
}

TEST_P(HeldDisplacementsOf, NothingAlongThemMovesOrBearsAForceAndTheRestIsReciprocal) {
  const SolidProblem half = solidProblem(block(false), onBase, 1, 0.3);
  FiniteElementOptions all = allColumns(half.model), few;
  all.element = few.element = GetParam();
  all.held = few.held = acrossThePlane(half.model);
  few.columns = {half.model.conditions().freeNodes().front()};
  const auto greens = half.greens(all), ofFew = half.greens(few);
  EXPECT_LT(greens->info().diagnostics.reciprocityDefect, 1e-10);
  Eigen::MatrixXd block(3, 3), transposed(3, 3);
  const auto gather = [](const GreensFunctions& from, int row, int column, Eigen::MatrixXd& out) {
    const std::vector<int> rows = {row}, columns = {column};
    from.gather(nodeList(rows), nodeList(columns), out.data());
  };
  const auto& areas = greens->info().vertexAreas;
  for (int v : half.model.conditions().freeNodes())
    for (int w : half.model.conditions().freeNodes()) {
      gather(*greens, v, w, block);
      if (all.held(0, v)) {
        EXPECT_EQ(block.row(0).cwiseAbs().maxCoeff(), 0);
      }
      if (all.held(0, w)) {
        EXPECT_EQ(block.col(0).cwiseAbs().maxCoeff(), 0);
      }
      gather(*greens, w, v, transposed);
      EXPECT_LT((block / areas[w] - transposed.transpose() / areas[v]).norm(),
                1e-10 * block.norm() / areas[w] + 1e-300);
      if (w != few.columns[0]) continue;
      gather(*ofFew, v, w, transposed);
      EXPECT_LT((block - transposed).norm(), 1e-9 * block.norm() + 1e-300);
    }
}

INSTANTIATE_TEST_SUITE_P(Elements, HeldDisplacementsOf,
                         testing::Values(SolidElement::Linear, SolidElement::Quadratic));

TEST(HeldDisplacements, TellAModelFromOthers) {
  const SolidProblem half = solidProblem(block(false), onBase, 1, 0.3);
  FiniteElementOptions held, none;
  held.held = acrossThePlane(half.model);
  none.held = HeldDisplacements::Constant(3, held.held.cols(), false);
  const auto fingerprint = [&](const FiniteElementOptions& options) {
    return half.greens(options)->info().fingerprint;
  };
  EXPECT_EQ(fingerprint(none), half.model.fingerprint());
  EXPECT_NE(fingerprint(held), half.model.fingerprint());
}

TEST(HeldDisplacements, LeaveTheInsideToTheElementsOwnProbes) {
  const SolidProblem half = solidProblem(block(false), onBase, 1, 0.3);
  FiniteElementOptions options;
  options.held = acrossThePlane(half.model);
  options.probes = Eigen::Vector3d(0.4, 0.5, 0.7);
  const auto greens = half.greens(options);
  EXPECT_EQ(greens->info().probes->count(), 1);
  EXPECT_TRUE(isRefused([&] { probeRows(*greens, half.model, options.probes); }, "material"));
  options.held.setConstant(false);
  EXPECT_EQ(probeRows(*half.greens(options), half.model, options.probes).count(), 1);
}

TEST(HeldDisplacements, OfWrongSizeOfAWholeFreeVertexOrOfALooseBodyAreRefused) {
  const SolidProblem half = solidProblem(block(false), onBase, 1, 0.3);
  FiniteElementOptions options;
  options.held = HeldDisplacements::Constant(3, 2, false);
  EXPECT_TRUE(isRefused([&] { half.greens(options); }, "held components of 2 vertices"));
  options.held = acrossThePlane(half.model);
  const int free = half.model.conditions().freeNodes().back();
  options.held.col(free) = true;
  EXPECT_TRUE(isRefused([&] { half.greens(options); }, "is free, but all of it is held: fix it"));
  const ElasticModel loose = makeModel(
      boundaryOf(half.body.mesh()), [](const auto&) { return false; }, 1, 0.3, 30,
      Domain::Unsupported);
  options.held = acrossThePlane(loose);
  EXPECT_TRUE(isRefused([&] { computeFiniteElementGreensFunctions(loose, half.body, options); },
                        "an unsupported body has no held components"));
}

}  // namespace
}  // namespace palpate::test
