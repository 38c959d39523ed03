// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/load_patches.h"

#include <gtest/gtest.h>

#include <numeric>

#include "mesh/smooth_patches.h"
#include "support/shapes.h"

namespace palpate {
namespace {

struct Sites {
  explicit Sites(const test::Shape& shape)
      : mesh(shape.mesh()), patches(findSmoothPatches(*mesh, 30)) {
    std::vector<int> all(mesh->vertexCount());
    std::iota(all.begin(), all.end(), 0);
    sites = loadSites(*mesh, patches, all);
  }
  std::shared_ptr<const SurfaceMesh> mesh;
  Eigen::VectorXi patches;
  std::vector<LoadSite> sites;
};

TEST(LoadPatches, SitesOfACubePushAgainstItsFaces) {
  const Sites cube(test::box({1, 1, 1}, {4, 4, 4}));
  // Inner vertices of six faces, two sites at those of twelve edges, three at eight corners.
  EXPECT_EQ(cube.sites.size(), 6u * 9 + 2 * 12 * 3 + 3 * 8);
  double area = 0;
  for (const LoadSite& site : cube.sites) {
    EXPECT_NEAR(site.axis.cwiseAbs().maxCoeff(), 1, 1e-12);
    EXPECT_LT(site.axis.dot(cube.mesh->points().col(site.vertex) - Eigen::Vector3d(.5, .5, .5)), 0);
    area += site.area;
  }
  EXPECT_NEAR(area, 6, 1e-12);
}

TEST(LoadPatches, SharesSumToOneWithinTheRadiusOnOneSideOfEdges) {
  for (const Sites& body : {Sites(test::box({1, 1, 1}, {5, 5, 5})), Sites(test::icosphere(2))})
    for (double radius : {0.0, 0.35, 0.8}) {
      const auto patches = loadPatches(*body.mesh, body.patches, body.sites, radius);
      ASSERT_EQ(patches.size(), body.sites.size());
      for (std::size_t i = 0; i < patches.size(); ++i) {
        EXPECT_EQ(patches[i].sites.front(), int(i));
        EXPECT_NEAR(std::accumulate(patches[i].shares.begin(), patches[i].shares.end(), 0.0), 1,
                    1e-12);
        if (radius == 0) {
          EXPECT_EQ(patches[i].sites.size(), 1u);
        }
        for (std::size_t j = 0; j < patches[i].sites.size(); ++j) {
          const LoadSite &here = body.sites[i], &there = body.sites[patches[i].sites[j]];
          EXPECT_GT(patches[i].shares[j], 0);
          EXPECT_EQ(here.patch, there.patch);
          EXPECT_GE(here.axis.dot(there.axis), 0.5);
          EXPECT_LE(
              (body.mesh->points().col(here.vertex) - body.mesh->points().col(there.vertex)).norm(),
              radius);
        }
      }
    }
}

TEST(LoadPatches, DoNotCrossThinWalls) {
  const Sites plate(test::box({1, 1, 0.01}, {5, 5, 1}));
  for (const LoadPatch& patch : loadPatches(*plate.mesh, plate.patches, plate.sites, 0.5))
    for (int site : patch.sites)
      EXPECT_GT(plate.sites[site].axis.dot(plate.sites[patch.sites[0]].axis), 0.99);
}

}  // namespace
}  // namespace palpate
