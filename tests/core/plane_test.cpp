// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/plane.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/half_space.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

Shape bumped(double height) {
  Shape shape = plate(1, 4);
  shape.points(2, 7) += height;
  return shape;
}

TEST(Plane, IsThatOfAFlatSurfaceInAnyPosition) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(2, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (double scale : {1e-6, 1., 1e6}) {
    const Plane plane = planeOf(*plate(1, 3)
                                     .mapped([&](const auto& x) -> Eigen::Vector3d {
                                       return scale * (turn * x + Eigen::Vector3d(7, 8, 9));
                                     })
                                     .sheet());
    EXPECT_LE((plane.normal - turn.col(2)).norm(), 1e-14);
    EXPECT_LE((plane.origin / scale - Eigen::Vector3d(7, 8, 9)).norm(), 1e-13);
    EXPECT_LE((plane.first.cross(plane.second) - plane.normal).norm(), 1e-14);
  }
  EXPECT_EQ(planeOf(*plate(1, 3).sheet()).normal, Eigen::Vector3d::UnitZ());
}

TEST(Plane, OfSinglePrecisionCoordinatesIsFlat) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(2, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  planeOf(*plate(1, 8)
               .mapped([&](const auto& x) -> Eigen::Vector3d {
                 return Eigen::Vector3d(turn * x + Eigen::Vector3d(.1, .2, .3))
                     .cast<float>()
                     .cast<double>();
               })
               .sheet());
}

TEST(Plane, ASurfaceThatIsNotFlatIsRefusedByItsVertexAndHowFarItIsOff) {
  planeOf(*bumped(1e-7).sheet());
  const std::string sentence = refusal([] { planeOf(*bumped(0.1).sheet()); });
  EXPECT_TRUE(contains(sentence, "vertex 7 lies 0.09"));
  EXPECT_TRUE(contains(sentence, "off the plane of the surface"));
  EXPECT_TRUE(isRefused([] { planeOf(*icosphere(1).sheet()); }, "off the plane of the surface"));
}

TEST(Plane, PiecesLieInOnePlaneAndFaceOneSide) {
  const Shape shape = plate(1, 2);
  EXPECT_EQ(shape.with(shape.moved({2, 0, 0})).sheet()->bodyCount(), 2);
  planeOf(*shape.with(shape.moved({2, 0, 0})).sheet());
  EXPECT_TRUE(isRefused(
      [&] {
        planeOf(*shape.with(shape.moved({2, 0, 1})).sheet());
      },
      "off the plane of the surface"));
  EXPECT_TRUE(isRefused(
      [&] {
        planeOf(*shape.with(plate(0.5, 2).flipped().moved({2, 0, 0})).sheet());
      },
      "triangle 8 faces away from the side that most of the surface faces"));
}

TEST(HalfSpaceModel, WithAFixedVertexOrOfAnotherDomainIsRefused) {
  const auto mesh = plate(1, 2).sheet();
  std::vector<unsigned char> types(9, 0);
  const auto model = [&](Domain domain) {
    return ElasticModel(mesh, Material(1, 0.3), BoundaryConditions(types), Eigen::VectorXi::Zero(8),
                        domain);
  };
  EXPECT_NE(model(Domain::HalfSpace).fingerprint(), 0u);
  EXPECT_TRUE(isRefused([&] { model(Domain::Exterior); }, "a sheet with rims bounds a half-space"));
  types[4] = 1;
  EXPECT_TRUE(isRefused([&] { model(Domain::HalfSpace); },
                        "vertex 4 is fixed: a half-space needs no support"));
  EXPECT_TRUE(isRefused([&] { model(Domain::Interior); }, "a sheet with rims bounds a half-space"));
}

}  // namespace
}  // namespace palpate::test
