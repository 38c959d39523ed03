// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Poisson's ratio up to one half, where the mean pressure of a wholly constrained body is lost.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "contact/capacitance_solver.h"
#include "support/problems.h"

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
double constrainedTractionError(double nu) {
  const ElasticModel model = makeModel(icosphere(3), cap, 1, nu);
  const auto greens = computeGreens(model, rawWithAllColumns(model));
  const NodalField exact = pointSourceField(model);
  const std::vector<int> free = model.conditions().freeNodes();
  BoundaryValues values = switchWholeNodes(free, exact.displacement(Eigen::all, free));
  values.given = exact.displacement;
  CapacitanceSolver solver(greens, std::make_shared<SurfaceMesh>(model.mesh()));
  return relativeError(solver.solve(values).traction, exact.traction, model,
                       [](int) { return true; });
}

TEST(NearlyIncompressible, WhollyConstrainedBodiesKeepTheirPressureOrAreRefused) {
  const double compressible = constrainedTractionError(0.3);
  EXPECT_LT(compressible, 0.02);
  for (const double nu : {0.45, 0.49, 0.499, 0.4999}) {
    const double error = constrainedTractionError(nu);
    EXPECT_LT(error, 2 * compressible) << nu;
  }
  // At one half a moved boundary says nothing of the pressure inside.
  EXPECT_THROW(constrainedTractionError(0.5), std::runtime_error);
}

}  // namespace
}  // namespace palpate::test
