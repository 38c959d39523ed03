// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include "fem/finite_element_method.h"
#include "linear_algebra/sparse_factorization.h"
#include "support/problems.h"
#include "support/refusals.h"
#include "support/solids.h"
#include "support/thin_shells.h"

namespace palpate::test {
namespace {

TEST(WithoutMumps, FiniteElementsSayWhatIsMissing) {
  EXPECT_FALSE(SparseFactorization::isAvailable());
  const TetrahedralMesh mesh = kuhnBox({1, 1, 1}, {1, 1, 1}).mesh();
  const ElasticModel model = makeModel(
      boundaryOf(mesh), [](const Eigen::Vector3d& x) { return x.z() == 0; }, 1, 0.3);
  const SolidBody body(model.mesh(), mesh, {Elasticity(model.material())});
  EXPECT_EQ(refusal<std::runtime_error>([&] { computeFiniteElementGreensFunctions(model, body); }),
            "finite elements and shells need MUMPS, which this build of Palpate was made without");
}

TEST(WithoutMumps, ShellsSayWhatIsMissing) {
  EXPECT_EQ(
      refusal<std::runtime_error>([] {
        shellProblem(plate(1, 2), [](const Eigen::Vector3d& x) { return x.x() < 0; }).greens();
      }),
      "finite elements and shells need MUMPS, which this build of Palpate was made without");
}

}  // namespace
}  // namespace palpate::test
