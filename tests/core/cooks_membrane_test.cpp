// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// R. D. Cook, "Improved two-dimensional finite element", J. Struct. Div. ASCE 100, 1974: a tapered
// panel, clamped on the left and sheared on the right, with corners (0, 0), (48, 44), (48, 60) and
// (0, 44). Coarse meshes of elements that lock are much too stiff in it.

#include <gtest/gtest.h>

#include "support/solids.h"

namespace palpate::test {
namespace {

bool atClamp(const Eigen::Vector3d& x) {
  return x.x() < 1e-9;
}

TetrahedralMesh panel(int divisions, int across, double thickness) {
  return kuhnBox({1, 1, 1}, {divisions, divisions, across})
      .mapped([=](const Eigen::Vector3d& x) -> Eigen::Vector3d {
        return {48 * x.x(), 44 * x.x() + x.y() * (44 - 28 * x.x()), thickness * x.z()};
      })
      .mesh();
}

/// Upward at the middle of the sheared end, under a unit force per unit of thickness.
double endRises(const ElasticModel& model, const GreensFunctions& greens) {
  const SurfaceMesh& mesh = model.mesh();
  Eigen::Matrix3Xd tractions = Eigen::Matrix3Xd::Zero(3, mesh.triangleCount()), applied;
  for (int f = 0; f < mesh.triangleCount(); ++f)
    if (mesh.triangleNormals()(0, f) > 0.99) tractions(1, f) = 1.0 / 16;
  const Eigen::Matrix3Xd u =
      solveFaceTractions(greens, mesh, model.smoothPatches(), tractions, applied);
  double rise = 0, count = 0;
  for (int v = 0; v < mesh.vertexCount(); ++v) {
    const Eigen::Vector3d x = mesh.points().col(v);
    if (std::abs(x.x() - 48) > 1e-9 || std::abs(x.y() - 52) > 1e-9) continue;
    rise += u(1, v);
    ++count;
  }
  return rise / count;
}

double byFiniteElements(const TetrahedralMesh& mesh, double poissonRatio,
                        SolidElement element = SolidElement::Quadratic) {
  const SolidProblem problem = solidProblem(mesh, atClamp, 1, poissonRatio);
  FiniteElementOptions options;
  options.element = element;
  options.reciprocal = false;
  options.patchColumns = true;
  return endRises(problem.model, *problem.greens(options));
}

double byBoundaryElements(const TetrahedralMesh& mesh, double poissonRatio) {
  const ElasticModel model = makeModel(boundaryOf(mesh), atClamp, 1, poissonRatio);
  BoundaryElementOptions options = raw();
  options.patchColumns = true;
  return endRises(model, *computeGreens(model, options));
}

TEST(CooksMembrane, RisesAsPublishedWhereItIsThin) {
  // 23.96 in plane stress (E = 1, nu = 1/3), the value that is usually quoted. The clamp holds the
  // panel's thickness, too, which plane stress does not: a fraction of a percent.
  const double coarse = byFiniteElements(panel(8, 1, 1), 1. / 3),
               fine = byFiniteElements(panel(16, 1, 1), 1. / 3);
  EXPECT_NEAR(coarse / 23.96, 1, 0.03);
  EXPECT_NEAR(fine / 23.96, 1, 0.012);
  EXPECT_LT(byFiniteElements(panel(4, 1, 1), 1. / 3, SolidElement::Linear), 0.6 * 23.96);
}

TEST(CooksMembrane, DoesNotLockWhereItIsNearlyIncompressibleAndRisesAsByBoundaryElements) {
  for (double poissonRatio : {0.4999, 0.5}) {
    const double coarse = byFiniteElements(panel(8, 2, 10), poissonRatio),
                 fine = byFiniteElements(panel(12, 3, 10), poissonRatio);
    EXPECT_NEAR(coarse / fine, 1, 0.02) << poissonRatio;
    const double boundary = byBoundaryElements(panel(12, 4, 10), poissonRatio);
    EXPECT_NEAR(boundary / fine, 1, 0.02) << poissonRatio;
  }
}

}  // namespace
}  // namespace palpate::test
