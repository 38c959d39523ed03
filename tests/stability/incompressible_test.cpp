// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Poisson's ratio up to one half, where the mean pressure of a wholly constrained body is lost.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "contact/capacitance_solver.h"
#include "greens/reciprocity.h"
#include "support/problems.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

TEST(NearlyIncompressible, ConditionAndCompliancesStayContinuousUpToOneHalf) {
  Eigen::MatrixXd last;
  double lastNu = 0;
  for (const double nu : {0.49, 0.499, 0.4999, 0.499999, 0.5}) {
    const ElasticModel model = makeModel(icosphere(2), cap, 1, nu);
    const BoundaryElementResult result = computeBoundaryElementGreensFunctions(model, raw());
    EXPECT_LT(result.info.diagnostics.conditionEstimate, 1e4) << nu;
    const Eigen::MatrixXd matrix = Eigen::Map<const Eigen::MatrixXd>(
        result.matrix.data(), 3 * model.mesh().vertexCount(), 3 * result.info.columnNodes.size());
    ASSERT_TRUE(matrix.allFinite());
    // The exact compliance changes by about as much as nu does.
    if (last.size() > 0) {
      EXPECT_LT((matrix - last).norm() / last.norm(), 20 * (nu - lastNu) + 1e-9) << nu;
    }
    last = matrix;
    lastNu = nu;
  }
}

/// Traction error, in the mean over the surface, of a sphere whose vertices are all moved as the
/// field of a point force outside moves them: the support by given values, the rest by contacts.
double constrainedTractionError(double nu, bool reciprocal,
                                Precision precision = Precision::Double) {
  const ElasticModel model = makeModel(icosphere(3), cap, 1, nu);
  BoundaryElementOptions options = rawWithAllColumns(model);
  options.reciprocal = reciprocal;
  options.precision = precision;
  const auto greens = computeGreens(model, options);
  const NodalField exact = pointSourceField(model);
  const std::vector<int> free = model.conditions().freeNodes();
  BoundaryValues values = switchWholeNodes(free, exact.displacement(Eigen::all, free));
  values.given = exact.displacement;
  CapacitanceSolver solver(greens, std::make_shared<SurfaceMesh>(model.mesh()));
  return relativeError(solver.solve(values).traction, exact.traction, model,
                       [](int) { return true; });
}

TEST(NearlyIncompressible, WhollyConstrainedBodiesKeepTheirPressureOrAreRefused) {
  for (const bool reciprocal : {false, true}) {
    const double compressible = constrainedTractionError(0.3, reciprocal);
    EXPECT_LT(compressible, reciprocal ? 0.04 : 0.02);
    for (const double nu : {0.45, 0.49, 0.499, 0.4999})
      EXPECT_LT(constrainedTractionError(nu, reciprocal), 2 * compressible) << nu;
    // At one half a moved boundary says nothing of the pressure inside.
    for (const Precision precision : {Precision::Double, Precision::Mixed, Precision::Float})
      EXPECT_THROW(constrainedTractionError(0.5, reciprocal, precision), std::runtime_error);
  }
}

TEST(NearlyIncompressible, VolumeStaysWhateverIsPressed) {
  const auto base = [](const Eigen::Vector3d& x) { return x.z() < 1e-9; };
  const ElasticModel model =
      makeModel(box(Eigen::Vector3d::Ones(), Eigen::Vector3i::Constant(4)), base, 1, 0.5);
  for (const bool reciprocal : {false, true}) {
    BoundaryElementOptions options = rawWithAllColumns(model);
    options.reciprocal = reciprocal;
    const Eigen::MatrixXd matrix = denseMatrix(*computeGreens(model, options));
    Eigen::Matrix3Xd onFree = unitPressures(model.mesh()).at(0);
    for (int node : model.conditions().fixedNodes()) onFree.col(node).setZero();
    const Eigen::VectorXd pressure = onFree.reshaped();
    for (int node : model.conditions().freeNodes()) {
      const auto columns = matrix.middleCols<3>(3 * node);
      EXPECT_LT((columns.transpose() * pressure).norm(), 1e-12 * columns.norm() * pressure.norm())
          << node;
    }
  }
}

}  // namespace
}  // namespace palpate::test
