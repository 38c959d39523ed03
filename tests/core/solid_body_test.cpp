// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fem/solid_body.h"

#include <gtest/gtest.h>

#include "support/refusals.h"
#include "support/solids.h"
#include "support/soups.h"

namespace palpate::test {
namespace {

const Elasticity kSoft(Material(1, 0.3)), kHard(Material(1e3, 0.2));

TEST(SolidBody, FindsTheSurfacesVerticesAmongItsPointsInAnyOrder) {
  const TetrahedralMesh mesh = kuhnBox({1, 2, 3}, {2, 3, 4}).mesh();
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto surface = renumbered(boundaryOf(mesh), seed).mesh();
    const SolidBody body(*surface, mesh, {kSoft});
    for (int v = 0; v < surface->vertexCount(); ++v)
      EXPECT_EQ(mesh.points().col(body.pointOfVertex(v)), surface->points().col(v));
  }
}

TEST(SolidBody, AllowsTheRoundingOfAFileBetweenSurfaceAndMesh) {
  const TetrahedralMesh mesh = kuhnBox({1, 1, 1}, {2, 2, 2}).mesh();
  const Shape exact = boundaryOf(mesh);
  const auto shifted = [&](double by) { return exact.moved({by, 0, 0}).mesh(); };
  // 1e-9 of the diagonal, sqrt 3.
  EXPECT_NO_THROW(SolidBody(*shifted(1.5e-9), mesh, {kSoft}));
  EXPECT_TRUE(isRefused([&] { SolidBody(*shifted(2e-9), mesh, {kSoft}); },
                        "vertex 0 of the surface is no point of the volume mesh"));
}

TEST(SolidBody, HasTheMaterialOfEachCell) {
  const TetrahedralMesh mesh = cubeOfFive().mesh();
  const auto surface = boundaryOf(mesh).mesh();
  const SolidBody one(*surface, mesh, {kHard});
  EXPECT_EQ(one.materialNumber(3), 0);
  const SolidBody two(*surface, mesh, {kSoft, kHard}, {0, 1, 0, 0, 1});
  EXPECT_EQ(two.materialCount(), 2);
  EXPECT_EQ(two.materialNumber(4), 1);
  EXPECT_EQ(two.material(4).stiffness(), kHard.stiffness());
  EXPECT_EQ(two.material(2).stiffness(), kSoft.stiffness());
  EXPECT_EQ(two.largestStiffness(), kHard.stiffness()(0, 0));
}

TEST(SolidBody, RefusesASurfaceThatIsNotItsBoundary) {
  const TetrahedralMesh cube = kuhnBox({1, 1, 1}, {1, 1, 1}).mesh();
  const auto refused = [](const Shape& shape, const TetrahedralMesh& mesh, const char* sentence) {
    return isRefused([&] { SolidBody(*shape.mesh(), mesh, {kSoft}); }, sentence);
  };
  Shape other = boundaryOf(cube);
  other.points(0, 7) += 1e-3;
  EXPECT_TRUE(refused(other, cube, "vertex 7 of the surface is no point of the volume mesh"));
  // The same cube with other diagonals.
  EXPECT_TRUE(refused(boundaryOf(cubeOfFive().mesh()), cube,
                      "of the surface is not on the boundary of the volume mesh"));
  // One of two bodies.
  Solid two = kuhnBox({1, 1, 1}, {1, 1, 1});
  const Eigen::Matrix3Xd points = two.points;
  const Eigen::Matrix4Xi cells = two.tetrahedra;
  two.points.resize(3, 16);
  two.points << points, points.colwise() + Eigen::Vector3d(3, 0, 0);
  two.tetrahedra.resize(4, 12);
  two.tetrahedra << cells, (cells.array() + 8).matrix();
  EXPECT_TRUE(refused(boundaryOf(cube), two.mesh(),
                      "the surface has 12 triangles, the boundary of the volume mesh 24"));
}

TEST(SolidBody, RefusesCellsWithoutAMaterial) {
  const TetrahedralMesh mesh = cubeOfFive().mesh();
  const auto surface = boundaryOf(mesh).mesh();
  const auto refused = [&](std::vector<Elasticity> materials, std::vector<int> numbers,
                           const char* sentence) {
    return isRefused([&] { SolidBody(*surface, mesh, materials, numbers); }, sentence);
  };
  EXPECT_TRUE(refused({}, {}, "there are 0 materials, and their numbers of 0 of 5 tetrahedra"));
  EXPECT_TRUE(refused({kSoft, kHard}, {}, "there are 2 materials, and their numbers of 0 of 5"));
  EXPECT_TRUE(refused({kSoft}, {0, 0}, "there are 1 materials, and their numbers of 2 of 5"));
  EXPECT_TRUE(refused({kSoft, kHard}, {0, 1, 2, 1, 0}, "tetrahedron 2 has no material"));
  EXPECT_TRUE(refused({kSoft, kHard}, {0, 1, 1, 1, -1}, "tetrahedron 4 has no material"));
}

}  // namespace
}  // namespace palpate::test
