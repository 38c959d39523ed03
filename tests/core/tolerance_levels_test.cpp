// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What layers along the rim of a support gain, and whether estimates by parts see it.

#include "bem/tolerance_levels.h"

#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

#include "mesh/rim_grading.h"
#include "support/loop_hierarchy.h"
#include "support/problems.h"

namespace palpate::test {
namespace {

BoundaryElementOptions rough() {
  BoundaryElementOptions options;
  options.tolerance = 1e-4;
  options.precision = Precision::Float;
  return options;
}

class Errors : public testing::TestWithParam<const char*> {
 protected:
  LoopHierarchy hierarchy_{GetParam()};
  const MeshHierarchy function_ = std::ref(hierarchy_);
  ToleranceLevels levels_{function_, 3000, rough()};
};

/// The reference has a quarter of a level's error but for the rim's part, of which it has an eighth
/// at most.
TEST_P(Errors, AreEstimatedWithinAFactorThreeAndNeverBelowHalf) {
  const MeshSetting finest{3, 1};
  levels_.solve(finest, {});
  for (int layers = 0; layers <= 2; ++layers) {
    const MeshSetting setting{2, layers};
    levels_.solveWithCoarser(setting, {});
    const SpreadLoads loads = levels_.loads(1);
    const LoadDifferences truth = levels_.differences(finest, setting, loads);
    const ErrorEstimate estimate = levels_.estimateByParts(setting);
    for (const auto& [estimated, error] : std::vector<std::pair<double, double>>{
             {estimate.discretization, LoadDifferences::mean(truth.field)},
             {estimate.mostDiscretization, LoadDifferences::most(truth.field)},
             {estimate.contact, LoadDifferences::mean(truth.contact)},
             {estimate.mostContact, LoadDifferences::most(truth.contact)}}) {
      EXPECT_GT(estimated, 0.5 * error) << layers;
      EXPECT_LT(estimated, 3 * error) << layers;
    }
  }
}

/// Levels alone gain with the first power of the edges, as the rim asks for; with a layer more on
/// each, with the second.
TEST_P(Errors, FallWithTheSecondPowerOnceLayersFollowTheLevels) {
  const MeshSetting finest{3, 1};
  levels_.solve(finest, {});
  const auto error = [&](MeshSetting setting) {
    for (int layers : {0, setting.layers}) levels_.solve({setting.level, layers}, {});
    return LoadDifferences::mean(levels_.differences(finest, setting, levels_.loads(1)).field);
  };
  levels_.solve({1, 0}, {});
  const double plain = std::log2(error({1, 0}) / error({2, 0})),
               layered = std::log2(error({1, 1}) / error({2, 2}));
  EXPECT_LT(plain, 1.4);
  EXPECT_GT(layered, 1.7);
}

INSTANTIATE_TEST_SUITE_P(OfModels, Errors, testing::Values("kidney", "nodule"),
                         [](const auto& model) { return std::string(model.param); });

}  // namespace
}  // namespace palpate::test
