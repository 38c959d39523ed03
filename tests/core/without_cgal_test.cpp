// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include "contact/pressure_mask.h"
#include "mesh/geodesic_distance.h"
#include "mesh/mesh_defects.h"
#include "mesh/polygon_file.h"
#include "mesh/repair.h"
#include "mesh/tetrahedralization.h"
#include "mesh/wall_thickness.h"
#include "support/refusals.h"
#include "support/soups.h"

namespace palpate::test {
namespace {

TEST(WithoutCgal, RepairAndOffFilesSayWhatIsMissing) {
  const Shape shape = icosphere(0);
  EXPECT_EQ(refusal<std::runtime_error>([&] { repairSurface(shape.points, shape.triangles); }),
            "repair needs CGAL, which this build of Palpate was made without");
  EXPECT_EQ(refusal<std::runtime_error>([] { readOffFile("any.off"); }),
            "OFF files need CGAL, which this build of Palpate was made without");
}

TEST(WithoutCgal, MasksAlongTheSurfaceSayWhatIsMissing) {
  const auto mesh = icosphere(0).mesh();
  const BoundaryConditions conditions(std::vector<unsigned char>(12, 0));
  EXPECT_EQ(
      refusal<std::runtime_error>(
          [&] { PressureMasks(*mesh, conditions, MaskShape::Linear, 1, MaskDistance::Geodesic); }),
      "distances along the surface (geodesic masks) need CGAL, which this build of Palpate was "
      "made without");
  EXPECT_NO_THROW(PressureMasks(*mesh, conditions, MaskShape::Linear, 1));
}

TEST(WithoutCgal, CuttingIntoTetrahedraSaysWhatIsMissing) {
  EXPECT_EQ(
      refusal<std::runtime_error>([] { tetrahedralize(*icosphere(0).mesh()); }),
      "cutting a surface's inside into tetrahedra needs CGAL, which this build of Palpate was "
      "made without: give a volume mesh");
}

TEST(WithoutCgal, WhatCannotBeMeasuredIsMarkedAsUnknown) {
  const auto mesh = cubeWithSpikeThroughItsBase().mesh();
  EXPECT_TRUE(findSelfIntersections(*mesh).empty());
  EXPECT_EQ(largestWallRatio(*mesh).ratio, -1);
  EXPECT_EQ(largestWallRatio(*mesh).triangle, -1);
}

}  // namespace
}  // namespace palpate::test
