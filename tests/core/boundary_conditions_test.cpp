// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/boundary_conditions.h"

#include <gtest/gtest.h>

#include "support/refusals.h"

namespace palpate::test {
namespace {

TEST(BoundaryConditions, EveryNodeIsInJustOneOfTheTwoSets) {
  const BoundaryConditions conditions({1, 0, 0, 1, 0});
  EXPECT_EQ(conditions.nodeCount(), 5);
  EXPECT_EQ(conditions.fixedNodes(), (std::vector<int>{0, 3}));
  EXPECT_EQ(conditions.freeNodes(), (std::vector<int>{1, 2, 4}));
  for (int node = 0; node < 5; ++node)
    EXPECT_EQ(conditions.isFixed(node), conditions.types()[node] == 1);
}

TEST(BoundaryConditions, AnyOtherTypeNamesItsNodeAndValue) {
  EXPECT_EQ(refusal([] {
              BoundaryConditions({0, 1, 2, 0});
            }),
            "the boundary type of node 2 must be 0 (free) or 1 (fixed), not 2");
  EXPECT_EQ(refusal([] { BoundaryConditions({255}); }),
            "the boundary type of node 0 must be 0 (free) or 1 (fixed), not 255");
}

TEST(BoundaryConditions, WithoutNodesAreEmpty) {
  EXPECT_EQ(BoundaryConditions().nodeCount(), 0);
  EXPECT_TRUE(BoundaryConditions().freeNodes().empty());
}

}  // namespace
}  // namespace palpate::test
