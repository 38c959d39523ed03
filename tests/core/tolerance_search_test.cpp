// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The error that was asked for against the error of a finer level.

#include "bem/tolerance_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "greens/error_estimate.h"
#include "support/loop_hierarchy.h"
#include "support/problems.h"

namespace palpate::test {
namespace {

struct Met {
  int loads, met;
};

/// Errors of a level by its difference from the next, continued with the order 5/4.
LoadDifferences errorsOfLevel(LoopHierarchy& levels, int level, const GreensFunctions& greens,
                              double length) {
  const ElasticModel model = levels(level), next = levels(level + 1);
  BoundaryElementOptions options;
  options.precision = next.mesh().vertexCount() < 2400 ? Precision::Float : Precision::Double;
  const auto finer = computeGreens(next, options);
  SpreadLoads loads = chooseSpreadLoads(model.mesh(), model.conditions(), 40);
  loads.length = length;
  LoadDifferences errors = compareUnderLoads(*finer, next.mesh(), greens, model.mesh(), loads);
  for (std::vector<double>* list : {&errors.field, &errors.contact})
    for (double& error : *list) error /= 1 - std::pow(2, -1.25);
  return errors;
}

/// How many of forty loads err by no more than was asked for, where no layers are allowed.
Met loadsThatMeetByLevels(const std::string& name, double tolerance) {
  LoopHierarchy levels(name);
  ToleranceLimits limits;
  limits.levels = 3;
  limits.vertices = 700;
  limits.layers = 0;
  ToleranceResult result = computeToTolerance(std::ref(levels), tolerance, limits, {});
  const ErrorEstimate estimate = result.greens.info.diagnostics.error;
  EXPECT_LE(estimate.most(), tolerance) << name;
  const LoadDifferences errors =
      errorsOfLevel(levels, result.level, *result.greens.take(), estimate.loadLength);
  Met met{static_cast<int>(errors.field.size()), 0};
  for (int i = 0; i < met.loads; ++i)
    met.met += errors.field[i] <= tolerance && errors.contact[i] <= tolerance;
  return met;
}

/// Of all loads on the four models; of each model's own the spatula's blade, which locks, misses a
/// tenth.
TEST(Tolerances, AreMetByNineteenOfTwentyLoadsOfLevelsAlone) {
  int loads = 0, met = 0;
  for (const auto& [name, tolerance] :
       std::vector<std::pair<std::string, double>>{{"nodule", 0.1},
                                                   {"nodule", 0.05},
                                                   {"kidney", 0.1},
                                                   {"spatula", 0.1},
                                                   {"banana_seat", 0.1}}) {
    const Met own = loadsThatMeetByLevels(name, tolerance);
    EXPECT_GE(own.met, 0.85 * own.loads) << name;
    loads += own.loads;
    met += own.met;
  }
  EXPECT_GE(met, 0.95 * loads);
}

/// Errors of what was chosen by its difference from the next level with a layer more, which leaves
/// a quarter of them at most.
LoadDifferences errorsOf(LoopHierarchy& levels, const ToleranceResult& result,
                         const GreensFunctions& greens, double length) {
  const ElasticModel plain = levels(result.level), model = levels(result.level, result.layers),
                     next = levels(result.level + 1, result.layers + 1);
  BoundaryElementOptions options;
  options.tolerance = 1e-4;
  options.precision = greens.epsilon() > 1e-10 ? Precision::Float : Precision::Double;
  const auto finer = computeGreens(next, options);
  SpreadLoads loads = chooseSpreadLoads(plain.mesh(), plain.conditions(), 40);
  loads.length = length;
  std::vector<int> vertices(model.mesh().vertexCount(), -1);
  std::iota(vertices.begin(), vertices.begin() + plain.mesh().vertexCount(), 0);
  LoadDifferences errors =
      compareUnderLoads(*finer, next.mesh(), greens, model.mesh(), vertices, loads);
  for (std::vector<double>* list : {&errors.field, &errors.contact})
    for (double& error : *list) error /= 1 - 0.25;
  return errors;
}

/// How many of forty loads err by no more than was asked for.
Met loadsThatMeet(const std::string& name, double tolerance) {
  LoopHierarchy levels(name);
  ToleranceLimits limits;
  limits.levels = 3;
  limits.vertices = 900;
  ToleranceResult result = computeToTolerance(std::ref(levels), tolerance, limits, {});
  const ErrorEstimate estimate = result.greens.info.diagnostics.error;
  EXPECT_LE(estimate.most(), tolerance) << name;
  const LoadDifferences errors =
      errorsOf(levels, result, *result.greens.view(), estimate.loadLength);
  Met met{static_cast<int>(errors.field.size()), 0};
  for (int i = 0; i < met.loads; ++i)
    met.met += errors.field[i] <= tolerance && errors.contact[i] <= tolerance;
  return met;
}

TEST(Tolerances, AreMetByNineteenOfTwentyLoads) {
  int loads = 0, met = 0;
  for (const auto& [name, tolerance] :
       std::vector<std::pair<std::string, double>>{{"nodule", 0.1},
                                                   {"nodule", 0.05},
                                                   {"nodule", 0.03},
                                                   {"kidney", 0.1},
                                                   {"kidney", 0.05},
                                                   {"banana_seat", 0.1}}) {
    const Met own = loadsThatMeet(name, tolerance);
    EXPECT_GE(own.met, 0.9 * own.loads) << name;
    loads += own.loads;
    met += own.met;
  }
  EXPECT_GE(met, 0.95 * loads);
}

/// Levels alone leave more than that at the rim of the support, however many the vertices allow.
TEST(Tolerances, OfOnePercentAreReachedWithLayersAlone) {
  LoopHierarchy levels("kidney");
  const ToleranceResult result = computeToTolerance(std::ref(levels), 0.01, {4, 3000}, {});
  EXPECT_EQ(result.level, 3);
  EXPECT_GT(result.layers, 0);
  EXPECT_LE(result.greens.info.diagnostics.error.most(), 0.01 / 1.2);
  ToleranceLimits levelsAlone{4, 3000};
  levelsAlone.layers = 0;
  EXPECT_THROW(computeToTolerance(std::ref(levels), 0.01, levelsAlone, {}), std::runtime_error);
}

TEST(ToleranceSearch, TakesTheCoarsestLevelThatMeetsIt) {
  LoopHierarchy levels("nodule");
  std::vector<int> asked;
  const ToleranceResult result = computeToTolerance(
      [&](int level, int layers) {
        asked.push_back(level);
        return levels(level, layers);
      },
      0.3, {4, 700}, {});
  EXPECT_EQ(result.level, 0);
  EXPECT_EQ(asked, (std::vector<int>{0, 1}));  // the next one tells a small level's error
  ASSERT_EQ(result.steps.size(), 1u);
  EXPECT_NE(result.steps[0].find("34 vertices, single precision"), std::string::npos);
}

TEST(ToleranceSearch, RefusesWithTheErrorWithinReach) {
  LoopHierarchy levels("nodule");
  const auto refusal = [&](double tolerance, ToleranceLimits limits) {
    try {
      computeToTolerance(std::ref(levels), tolerance, limits, {});
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  const std::string far = refusal(1e-3, {4, 3000});
  EXPECT_NE(far.find("a tolerance of 0.1 % is out of reach"), std::string::npos) << far;
  EXPECT_NE(far.find("level 3, the last within 4 refinements and 3000 vertices, would have about"),
            std::string::npos)
      << far;
  const std::string here = refusal(0.02, {0, 700});
  EXPECT_NE(here.find("level 0 with its 34 vertices has an estimated error of"), std::string::npos);
  EXPECT_NE(here.find("and is the last within 0 refinements"), std::string::npos) << here;
}

TEST(ToleranceSearch, RefusesASurfaceThatIsLargerThanAllowed) {
  LoopHierarchy levels("nodule");
  EXPECT_THROW(computeToTolerance(std::ref(levels), 0.5, {0, 30}, {}), std::runtime_error);
}

TEST(ToleranceSearch, RefusesImpossibleTolerances) {
  LoopHierarchy levels("nodule");
  for (double tolerance : {0.0, -1.0, 1.0, std::nan("")})
    EXPECT_THROW(computeToTolerance(std::ref(levels), tolerance, {}, {}), std::invalid_argument);
}

TEST(ToleranceSearch, CanBeAborted) {
  LoopHierarchy levels("kidney");
  EXPECT_THROW(computeToTolerance(std::ref(levels), 0.05, {}, {},
                                  [](double fraction, const char*) { return fraction < 0.5; }),
               Aborted);
}

}  // namespace
}  // namespace palpate::test
