// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/tolerance_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "bem/error_estimate.h"
#include "greens/load_differences.h"

namespace palpate {
namespace {

constexpr double kShareOfOthers = 0.01;  // of the tolerance, for integrals and arithmetic
constexpr double kFloatTolerance = 1e-3;
constexpr double kLeastIntegration = 1e-6, kMostIntegration = 1e-3;
constexpr double kDoubtful = 2;     // predictions may be wrong by this factor
constexpr int kLeastVertices = 50;  // of a level whose next one is compared with it
constexpr int kLevelFactor = 4;     // vertices of a level over those of the level before

std::string percent(double share) {
  std::ostringstream text;
  text.precision(2);
  text << 100 * share << " %";
  return text.str();
}

/// A level of the hierarchy, solved.
struct Level {
  ElasticModel model;
  BoundaryElementResult result;

  int vertices() const { return model.mesh().vertexCount(); }
  ProbeLoads loads() const {
    return chooseProbeLoads(model.mesh(), model.conditions(), kErrorLoads);
  }
};

/// @param loads  of the coarser level or one before it.
LoadDifferences differenceOf(const Level& finer, const Level& coarser, const ProbeLoads& loads) {
  std::vector<int> vertices(coarser.vertices());
  std::iota(vertices.begin(), vertices.end(), 0);
  return compareUnderLoads(*finer.result.view(), finer.model.mesh(), *coarser.result.view(),
                           coarser.model.mesh(), vertices, loads);
}

double edgeRatio(const Level& finer, const Level& coarser) {
  return std::sqrt(double(finer.vertices()) / coarser.vertices());
}

/// The order that three levels show under the loads of the coarsest, between one and two.
double observedOrder(const Level& fine, const Level& middle, const Level& coarse) {
  const ProbeLoads loads = coarse.loads();
  const double before = LoadDifferences::mean(differenceOf(middle, coarse, loads).field),
               after = LoadDifferences::mean(differenceOf(fine, middle, loads).field);
  return std::clamp(std::log(before / after) / std::log(edgeRatio(fine, middle)), 1.0, 2.0);
}

class Search {
 public:
  Search(double tolerance, const ToleranceLimits& limits, BoundaryElementOptions options)
      : tolerance_(tolerance), limits_(limits), options_(std::move(options)) {
    options_.tolerance =
        std::clamp(kShareOfOthers * tolerance, kLeastIntegration, kMostIntegration);
    options_.precision = tolerance < kFloatTolerance ? Precision::Double : Precision::Float;
  }

  ToleranceResult run(const std::function<ElasticModel(int)>& levelModel,
                      const Progress& progress) {
    for (int k = 0;; ++k) {
      solve(levelModel(k), progress.part(1 - std::pow(4.0, -k), 1 - std::pow(4.0, -k - 1)));
      Level& level = levels_.back();
      ErrorEstimate& estimate = level.result.info.diagnostics.error;
      if (estimate.discretization < 0) estimate = estimateByLevels();
      const double error = estimate.most();
      if (error < 0)
        throw std::runtime_error(
            "no error can be estimated for this surface: leave out the tolerance, or compute the "
            "Green's functions of all free vertices");
      steps_.push_back(describe(k, level.vertices(), error));
      if (error <= tolerance_) return {k, std::move(level.result), std::move(steps_)};
      requireReachable(k, error);
    }
  }

 private:
  void solve(ElasticModel model, const Progress& progress) {
    options_.estimateError = levels_.empty() || levels_.back().vertices() < kLeastVertices;
    const ProgressCallback callback = [&](double fraction, const char* stage) {
      progress.report(fraction, stage);
      return true;
    };
    try {
      levels_.push_back({model, computeBoundaryElementGreensFunctions(model, options_, callback)});
    } catch (const std::runtime_error& failure) {
      if (options_.precision != Precision::Float || dynamic_cast<const Aborted*>(&failure)) throw;
      options_.precision = Precision::Double;
      levels_.push_back({model, computeBoundaryElementGreensFunctions(model, options_, callback)});
    }
    if (levels_.size() > 3) levels_.erase(levels_.begin());
  }

  /// No estimate if there is but one level.
  ErrorEstimate estimateByLevels() {
    if (levels_.size() < 2) return levels_.back().result.info.diagnostics.error;
    const Level &fine = levels_.back(), &coarse = levels_[levels_.size() - 2];
    order_ = levels_.size() < 3 ? discretizationOrder(*fine.result.view())
                                : observedOrder(fine, coarse, levels_.front());
    ErrorEstimate estimate = otherErrors(*fine.result.view());
    const ProbeLoads loads = coarse.loads();
    addDiscretization(differenceOf(fine, coarse, loads),
                      1 / (std::pow(edgeRatio(fine, coarse), order_) - 1), loads.length, estimate);
    return estimate;
  }

  std::string describe(int level, int vertices, double error) const {
    std::ostringstream text;
    text << "level " << level << ", " << vertices << " vertices, "
         << (options_.precision == Precision::Float ? "single" : "double")
         << " precision, integrals to " << options_.tolerance << ": estimated error "
         << percent(error) << (error <= tolerance_ ? ", within " : ", above ")
         << percent(tolerance_);
    return text.str();
  }

  /// Whether a level that the limits allow may meet the tolerance, by the error of the last.
  void requireReachable(int level, double error) const {
    const int vertices = levels_.back().vertices();
    int more = 0;
    for (double next = kLevelFactor * double(vertices);
         level + more < limits_.levels && next <= limits_.vertices; next *= kLevelFactor)
      ++more;
    const double reachable = error / std::pow(2.0, order_ * more);
    if (more > 0 && reachable <= kDoubtful * tolerance_) return;
    std::ostringstream text;
    text << "a tolerance of " << percent(tolerance_) << " is out of reach: level " << level
         << " with its " << vertices << " vertices has an estimated error of " << percent(error);
    if (more > 0)
      text << ", and level " << level + more << ", the last within " << limits_.levels
           << " refinements and " << limits_.vertices << " vertices, would have about "
           << percent(reachable);
    else
      text << " and is the last within " << limits_.levels << " refinements and "
           << limits_.vertices << " vertices";
    throw std::runtime_error(text.str());
  }

  double tolerance_;
  ToleranceLimits limits_;
  BoundaryElementOptions options_;
  std::vector<Level> levels_;
  double order_ = 1;
  std::vector<std::string> steps_;
};

}  // namespace

ToleranceResult computeToTolerance(const std::function<ElasticModel(int)>& level, double tolerance,
                                   const ToleranceLimits& limits,
                                   const BoundaryElementOptions& options,
                                   const ProgressCallback& progress) {
  if (!(tolerance > 0 && tolerance < 1))
    throw std::invalid_argument("the tolerance must be above 0 and below 1, not " +
                                std::to_string(tolerance));
  const Progress whole(progress);
  ToleranceResult result = Search(tolerance, limits, options).run(level, whole);
  whole.report(1, "done");
  return result;
}

}  // namespace palpate
