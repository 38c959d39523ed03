// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/tetrahedral_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesh/surface_mesh.h"
#include "support/refusals.h"
#include "support/solids.h"
#include "support/soups.h"

namespace palpate::test {
namespace {

struct Case {
  const char* name;
  Solid solid;
  double volume;
  int faces;
};

const Case kCases[] = {
    {"Corner", cornerTetrahedron(), 1.0 / 6, 4},
    {"Regular", regularTetrahedron(), 8.0 / 3, 4},
    {"CubeOfFive", cubeOfFive(), 1, 12},
    {"CubeOfSix", kuhnBox({1, 1, 1}, {1, 1, 1}), 1, 12},
    {"Box", kuhnBox({1, 2, 3}, {2, 3, 4}), 6, 2 * 2 * (6 + 8 + 12)},
};

class TetrahedralMeshOf : public testing::TestWithParam<Case> {};

TEST_P(TetrahedralMeshOf, KnownBodiesHasTheirVolumeInsideItsBoundary) {
  const auto& [name, solid, volume, faces] = GetParam();
  const TetrahedralMesh mesh = solid.mesh();
  EXPECT_EQ(mesh.cellCount(), solid.tetrahedra.cols());
  EXPECT_GT(mesh.volumes().minCoeff(), 0);
  // Coordinates are small integers or thirds: rounding.
  EXPECT_NEAR(mesh.volumes().sum(), volume, 1e-14 * volume);
  ASSERT_EQ(mesh.boundary().cols(), faces);
  // By the divergence theorem, outwards: inwards it would be negative.
  EXPECT_NEAR(signedVolume(mesh.points(), mesh.boundary()), volume, 1e-14 * volume);
  EXPECT_EQ(eulerCharacteristic(boundaryOf(mesh).triangles), 2);
  const SurfaceMesh surface(boundaryOf(mesh).points, boundaryOf(mesh).triangles);  // is closed
  EXPECT_EQ(surface.shellCount(), 1);
}

TEST_P(TetrahedralMeshOf, CellsInsideOutIsTheSameTurned) {
  const Case& c = GetParam();
  const TetrahedralMesh before = c.solid.mesh();
  Solid inside = c.solid;
  for (int t = 0; t < inside.tetrahedra.cols(); t += 2)
    std::swap(inside.tetrahedra(1, t), inside.tetrahedra(2, t));
  const TetrahedralMesh after = inside.mesh();
  EXPECT_NEAR((before.volumes() - after.volumes()).norm(), 0, 1e-14 * c.volume);
  EXPECT_NEAR(signedVolume(after.points(), after.boundary()), c.volume, 1e-14 * c.volume);
}

INSTANTIATE_TEST_SUITE_P(Solids, TetrahedralMeshOf, testing::ValuesIn(kCases),
                         [](const auto& info) { return info.param.name; });

TEST(TetrahedralMesh, FacesOfACellAreListedAsSeenFromOutside) {
  const TetrahedralMesh mesh = cornerTetrahedron().mesh();
  Eigen::Matrix3Xi expected(3, 4);
  expected << 1, 0, 0, 0,  //
      2, 3, 1, 2,          //
      3, 2, 3, 1;
  EXPECT_EQ(mesh.boundary(), expected);
}

TEST(TetrahedralMesh, SmallestDihedralAnglesAreThoseOfKnownTetrahedra) {
  const double degree = std::acos(-1.0) / 180;
  EXPECT_NEAR(regularTetrahedron().mesh().smallestDihedralAngle(), std::acos(1.0 / 3) / degree,
              1e-12);
  EXPECT_NEAR(cornerTetrahedron().mesh().smallestDihedralAngle(),
              std::acos(1 / std::sqrt(3.0)) / degree, 1e-12);
  EXPECT_NEAR(kuhnBox({1, 1, 1}, {2, 2, 2}).mesh().smallestDihedralAngle(), 45, 1e-12);
  const Solid flat = regularTetrahedron().mapped(
      [](const Eigen::Vector3d& x) { return Eigen::Vector3d(x.x(), x.y(), 1e-3 * x.z()); });
  // Two edges of length sqrt 8 at right angles, 2 h apart: normals (-h, -h, 1) and (h, -h, 1) of
  // faces that meet at a side.
  EXPECT_NEAR(flat.mesh().smallestDihedralAngle(), std::acos(1 / (1 + 2e-6)) / degree, 1e-9);
}

TEST(TetrahedralMesh, RefusesWhatIsNoBody) {
  const auto refused = [](const Solid& solid, const std::string& sentence) {
    return isRefused([&] { solid.mesh(); }, sentence);
  };
  const Solid sound = cubeOfFive();
  EXPECT_TRUE(
      refused({sound.points, Eigen::Matrix4Xi(4, 0)}, "the volume mesh has no tetrahedron"));
  Solid bad = sound;
  bad.tetrahedra(2, 3) = 8;
  EXPECT_TRUE(refused(bad, "tetrahedron 3 refers to point 8 of 8"));
  bad.tetrahedra(2, 3) = -1;
  EXPECT_TRUE(refused(bad, "tetrahedron 3 refers to point -1 of 8"));
  for (double value : {std::numeric_limits<double>::quiet_NaN(), 1e200}) {
    bad = sound;
    bad.points(1, 5) = value;
    EXPECT_TRUE(refused(bad, "point 5 of the volume mesh is not finite or too far away"));
  }
  bad = sound;
  bad.points.conservativeResize(3, 9);
  bad.points.col(8) << 3, 3, 3;
  EXPECT_TRUE(refused(bad, "point 8 of the volume mesh belongs to no tetrahedron"));
  bad = sound;
  bad.points.col(6) = bad.points.col(2);
  EXPECT_TRUE(refused(bad, "points 2 and 6 of the volume mesh are the same: weld it"));
  bad = sound;
  bad.tetrahedra(1, 1) = bad.tetrahedra(0, 1);
  EXPECT_TRUE(refused(bad, "tetrahedron 1"));
  bad = regularTetrahedron().mapped(
      [](const Eigen::Vector3d& x) { return Eigen::Vector3d(x.x(), x.y(), 1e-13 * x.z()); });
  EXPECT_TRUE(refused(bad, "tetrahedron 0"));
}

TEST(TetrahedralMesh, RefusesAFaceThatThreeTetrahedraShare) {
  Solid solid{Eigen::Matrix3Xd::Zero(3, 6), Eigen::Matrix4Xi(4, 3)};
  solid.points.middleCols<3>(1).setIdentity();
  solid.points.col(4) << 0.1, 0.1, 2;
  solid.points.col(5) << 0, 0, -1;
  solid.tetrahedra << 0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 4, 5;
  EXPECT_TRUE(isRefused([&] { solid.mesh(); }, "tetrahedra 0, 1 and 2 share one face"));
}

TEST(TetrahedralMesh, RefusesCellsOnTheSameSideOfAFace) {
  Solid twice{cornerTetrahedron().points, Eigen::Matrix4Xi(4, 2)};
  twice.tetrahedra << 0, 1, 1, 2, 2, 0, 3, 3;
  EXPECT_TRUE(isRefused([&] { twice.mesh(); },
                        "tetrahedra 0 and 1 lie on the same side of a face that they share"));
  Solid overlapping{Eigen::Matrix3Xd::Zero(3, 5), Eigen::Matrix4Xi(4, 2)};
  overlapping.points.middleCols<3>(1).setIdentity();
  overlapping.points.col(4) << 0.2, 0.3, 2;
  overlapping.tetrahedra << 0, 2, 1, 1, 2, 0, 3, 4;
  EXPECT_TRUE(isRefused([&] { overlapping.mesh(); },
                        "tetrahedra 0 and 1 lie on the same side of a face that they share"));
  overlapping.points.col(4).z() = -2;
  EXPECT_NO_THROW(overlapping.mesh());
}

}  // namespace
}  // namespace palpate::test
