// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include "mesh/loop_subdivision.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

/// Three control vertices and the middles of the edges between them.
LoopLevel triangleLevel() {
  LoopLevel level;
  level.parents.resize(2, 6);
  level.parents << 0, 1, 2, 0, 1, 0,  //
      0, 1, 2, 1, 2, 2;
  return level;
}

TEST(BoundaryRefinement, AnOldVertexKeepsItsTypeAndANewOneIsFixedIfBothItsParentsAre) {
  EXPECT_EQ(refineBoundaryTypes(triangleLevel(), {1, 1, 0}),
            (std::vector<unsigned char>{1, 1, 0, 1, 0, 0}));
  EXPECT_EQ(refineBoundaryTypes(triangleLevel(), {0, 0, 0}), std::vector<unsigned char>(6, 0));
  EXPECT_EQ(refineBoundaryTypes(triangleLevel(), {1, 1, 1}), std::vector<unsigned char>(6, 1));
}

TEST(BoundaryRefinement, TypesForAnotherMeshAreRefused) {
  EXPECT_EQ(refusal([] {
              refineBoundaryTypes(triangleLevel(), {1, 1});
            }),
            "there are 2 boundary types for 3 control vertices");
  EXPECT_EQ(refusal([] {
              refineBoundaryTypes(triangleLevel(), {1, 1, 0, 0, 0, 0});
            }),
            "there are 6 boundary types for 3 control vertices");
}

}  // namespace
}  // namespace palpate::test
