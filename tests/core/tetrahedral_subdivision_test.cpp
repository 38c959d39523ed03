// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/tetrahedral_subdivision.h"

#include <gtest/gtest.h>

#include "support/solids.h"

namespace palpate::test {
namespace {

TEST(TetrahedralSubdivision, FillsEachCellByEightOfAnEighth) {
  const TetrahedralMesh coarse = kuhnBox({1, 2, 3}, {2, 1, 2}).mesh(), fine = subdivided(coarse);
  ASSERT_EQ(fine.cellCount(), 8 * coarse.cellCount());
  for (int cell = 0; cell < coarse.cellCount(); ++cell)
    for (int part = 0; part < 8; ++part)
      EXPECT_NEAR(fine.volumes()[8 * cell + part] / coarse.volumes()[cell], 0.125, 1e-12);
  EXPECT_EQ(fine.boundary().cols(), 4 * coarse.boundary().cols());
  EXPECT_EQ(fine.points().leftCols(coarse.pointCount()), coarse.points());
}

// Kuhn's cubes of half the edges are the same points.
TEST(TetrahedralSubdivision, HasAPointAnEdge) {
  const TetrahedralMesh fine = subdivided(kuhnBox({1, 1, 1}, {2, 2, 2}).mesh());
  EXPECT_EQ(fine.pointCount(), kuhnBox({1, 1, 1}, {4, 4, 4}).mesh().pointCount());
  EXPECT_GT(subdivided(cubeOfFive().mesh()).smallestDihedralAngle(), 30);
}

}  // namespace
}  // namespace palpate::test
