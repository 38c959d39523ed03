// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/tetrahedral_refinement.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "fem/solid_body.h"
#include "mesh/smooth_patches.h"
#include "mesh/subdivision.h"
#include "support/solids.h"

namespace palpate::test {
namespace {

TEST(TetrahedralRefinement, FillsEachCellWithEightOfItsVolume) {
  const TetrahedralMesh coarse = cubeOfFive()
                                     .mapped([](const Eigen::Vector3d& x) {
                                       return Eigen::Vector3d(x.x() + x.y(), x.y(), 3 * x.z());
                                     })
                                     .mesh();
  const TetrahedralMesh fine = refineTetrahedra(coarse);
  ASSERT_EQ(fine.cellCount(), 8 * coarse.cellCount());
  EXPECT_EQ(fine.points().leftCols(coarse.pointCount()), coarse.points());
  for (int cell = 0; cell < fine.cellCount(); ++cell) {
    const int parent = cell / 8;
    EXPECT_NEAR(8 * fine.volumes()[cell] / coarse.volumes()[parent], 1, 1e-12) << cell;
    // Inside the parent, as no volume is left over: its barycentric coordinates are none below 0.
    const auto corners = coarse.tetrahedra().col(parent);
    Eigen::Matrix4d places;
    places << coarse.points()(Eigen::all, corners), Eigen::RowVector4d::Ones();
    for (int point : fine.tetrahedra().col(cell))
      EXPECT_GT((places.inverse() * fine.points().col(point).homogeneous()).minCoeff(), -1e-12);
  }
}

TEST(TetrahedralRefinement, KeepsItsAnglesLevelByLevel) {
  TetrahedralMesh mesh = kuhnBox({1, 2, 1}, {1, 2, 1}).mesh();
  const double angle = mesh.smallestDihedralAngle();
  for (int level = 0; level < 3; ++level) {
    mesh = refineTetrahedra(mesh);
    EXPECT_GT(mesh.smallestDihedralAngle(), 0.6 * angle) << level;
  }
}

TEST(TetrahedralRefinement, HasTheBoundaryOfASurfaceSubdividedFlat) {
  const TetrahedralMesh coarse = kuhnBox({1, 2, 1}, {2, 3, 2}).mesh();
  const Shape shape = boundaryOf(coarse);
  const SurfaceMesh surface(shape.points, shape.triangles);
  const SubdivisionLevel made =
      subdivide(surface, findSmoothPatches(surface, 30), Subdivision::Flat);
  const SurfaceMesh finer(made.points, made.triangles);
  // Which SolidBody refuses unless all triangles are the boundary's.
  EXPECT_NO_THROW(SolidBody(finer, refineTetrahedra(coarse), {Elasticity(Material(1, 0.3))}));
}

}  // namespace
}  // namespace palpate::test
