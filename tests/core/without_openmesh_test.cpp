// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include "mesh/coarsening.h"
#include "mesh/loop_subdivision.h"
#include "support/refusals.h"
#include "support/shapes.h"

namespace palpate::test {
namespace {

TEST(WithoutOpenMesh, RefinementSaysWhatIsMissing) {
  const auto mesh = icosphere(0).mesh();
  EXPECT_EQ(refusal<std::runtime_error>([&] { subdivideLoop(*mesh); }),
            "refinement needs OpenMesh, which this build of Palpate was made without");
}

TEST(WithoutOpenMesh, CoarseningSaysWhatIsMissing) {
  const Shape shape = icosphere(1);
  const std::vector<unsigned char> types(shape.points.cols(), 0);
  const Eigen::VectorXi patches = Eigen::VectorXi::Zero(shape.triangles.cols());
  EXPECT_EQ(refusal<std::runtime_error>(
                [&] { coarsen(shape.points, shape.triangles, types, patches, 20); }),
            "coarsening needs OpenMesh, which this build of Palpate was made without");
}

}  // namespace
}  // namespace palpate::test
