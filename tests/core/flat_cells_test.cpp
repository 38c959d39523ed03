// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/flat_cells.h"

#include <gtest/gtest.h>

#include "mesh/tetrahedral_mesh.h"

namespace palpate::test {
namespace {

/// A square, whose diagonals are 0-1 and 2-3, with a point above and one below it.
Eigen::Matrix3Xd bipyramid() {
  Eigen::Matrix3Xd points(3, 6);
  points << 1, -1, 0, 0, 0, 0,  //
      0, 0, 1, -1, 0, 0,        //
      0, 0, 0, 0, 1, -1;
  return points;
}

void expectSound(const Eigen::Matrix3Xd& points, const Eigen::Matrix4Xi& tetrahedra, int outside) {
  const TetrahedralMesh mesh(points, tetrahedra);
  EXPECT_NEAR(mesh.volumes().sum(), 4.0 / 3, 1e-14);
  EXPECT_EQ(mesh.boundary().cols(), outside);
}

TEST(FlatCells, ACellBetweenTwoSidesIsCutAwayAtItsCrossing) {
  Eigen::Matrix3Xd points = bipyramid();
  Eigen::Matrix4Xi tetrahedra(4, 5);
  tetrahedra << 0, 0, 2, 2, 0,  //
      1, 1, 3, 3, 1,            //
      2, 3, 0, 1, 2,            //
      4, 4, 5, 5, 3;
  removeFlatCells(points, tetrahedra);
  ASSERT_EQ(points.cols(), 7);
  EXPECT_LE(points.col(6).norm(), 1e-15);
  EXPECT_EQ(points.leftCols(6), bipyramid());
  EXPECT_EQ(tetrahedra.cols(), 8);
  expectSound(points, tetrahedra, 8);
}

TEST(FlatCells, ACellAtTheBoundaryIsLeftOut) {
  Eigen::Matrix3Xd points = bipyramid().leftCols(5);
  Eigen::Matrix4Xi tetrahedra(4, 3);
  tetrahedra << 0, 0, 0,  //
      1, 1, 1,            //
      2, 3, 2,            //
      4, 4, 3;
  removeFlatCells(points, tetrahedra);
  EXPECT_EQ(points.cols(), 5);
  ASSERT_EQ(tetrahedra.cols(), 2);
  EXPECT_NEAR(TetrahedralMesh(points, tetrahedra).volumes().sum(), 2.0 / 3, 1e-14);
}

TEST(FlatCells, SoundMeshesStayAsTheyAre) {
  Eigen::Matrix3Xd points = bipyramid();
  Eigen::Matrix4Xi tetrahedra(4, 4);
  tetrahedra << 0, 0, 0, 0,  //
      1, 1, 1, 1,            //
      2, 3, 2, 3,            //
      4, 4, 5, 5;
  const Eigen::Matrix4Xi before = tetrahedra;
  removeFlatCells(points, tetrahedra);
  EXPECT_EQ(points.cols(), 6);
  EXPECT_EQ(tetrahedra, before);
  expectSound(points, tetrahedra, 8);
}

}  // namespace
}  // namespace palpate::test
