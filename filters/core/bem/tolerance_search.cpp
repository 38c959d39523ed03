// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/tolerance_search.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "greens/error_estimate.h"
#include "greens/load_differences.h"

namespace palpate {
namespace {

constexpr double kShareOfOthers = 0.01;  // of the tolerance, for integrals and arithmetic
constexpr double kFloatTolerance = 1e-3;
constexpr double kLeastIntegration = 1e-6, kMostIntegration = 1e-3;
constexpr double kMargin = 1.2;     // of estimates that are relied on
constexpr double kDoubtful = 2;     // predictions may be wrong by this factor
constexpr int kLeastVertices = 50;  // of a level that tells of the next one's error
constexpr int kSmall = 200;  // vertices; below, the next level tells of the error, and costs little
constexpr int kLevelFactor = 4;  // vertices of a level over those of the level before
constexpr double kLevelCost = 64;
constexpr double kForeseen = 0.9;  // share of the progress; the rest is left for one level more

std::string percent(double share) {
  std::ostringstream text;
  text.precision(2);
  text << 100 * share << " %";
  return text.str();
}

/// A level of the hierarchy, solved.
struct Level {
  ElasticModel model;
  ComputedGreensFunctions result;

  int vertices() const { return model.mesh().vertexCount(); }
  SpreadLoads loads() const { return errorLoads(model); }
};

/// @param loads  of the coarser level or one before it.
LoadDifferences differenceOf(const Level& finer, const Level& coarser, const SpreadLoads& loads) {
  return compareUnderLoads(*finer.result.view(), finer.model.mesh(), *coarser.result.view(),
                           coarser.model.mesh(), loads);
}

double edgeRatio(const Level& finer, const Level& coarser) {
  return std::sqrt(double(finer.vertices()) / coarser.vertices());
}

/// The order that three levels show under the loads of the coarsest, between a half and two.
double observedOrder(const Level& fine, const Level& middle, const Level& coarse) {
  const SpreadLoads loads = coarse.loads();
  const double before = LoadDifferences::mean(differenceOf(middle, coarse, loads).field),
               after = LoadDifferences::mean(differenceOf(fine, middle, loads).field);
  return std::clamp(std::log(before / after) / std::log(edgeRatio(fine, middle)), 0.5, 2.0);
}

class Search {
 public:
  Search(const std::function<ElasticModel(int)>& model, double tolerance,
         const ToleranceLimits& limits, BoundaryElementOptions options, const Progress& progress)
      : model_(model),
        tolerance_(tolerance),
        limits_(limits),
        options_(std::move(options)),
        progress_(progress),
        expected_(std::min(limits.levels, 2)) {
    options_.estimateError = false;  // done here
    options_.solver = LinearSolver::Direct;
    options_.tolerance =
        std::clamp(kShareOfOthers * tolerance, kLeastIntegration, kMostIntegration);
    options_.precision = tolerance < kFloatTolerance ? Precision::Double : Precision::Float;
  }

  ToleranceResult run() {
    for (int k = 0;; ++k) {
      solve(k);
      const ErrorEstimate estimate = estimateLevel(k);
      levels_[k].result.info.diagnostics.error = estimate;
      if (estimate.most() < 0)
        throw std::runtime_error(
            "no error can be estimated for this surface: leave out the tolerance");
      steps_.push_back(describe(k, estimate.most()));
      if (kMargin * estimate.most() <= tolerance_)
        return {k, std::move(levels_[k].result), std::move(steps_)};
      requireReachable(k, estimate.most());
      const double missing = std::log2(kMargin * estimate.most() / tolerance_) / order_;
      expected_ = k + std::max(1, static_cast<int>(std::ceil(missing)));
    }
  }

 private:
  /// Solves the levels up to this one that are not yet.
  void solve(int level) {
    for (int k = static_cast<int>(levels_.size()); k <= level; ++k) {
      const ProgressCallback callback = partOf(k).callback();
      const ElasticModel model = model_(k);
      requireAllowed(model.mesh().vertexCount());
      try {
        levels_.push_back(
            {model, computeBoundaryElementGreensFunctions(model, options_, callback)});
      } catch (const std::runtime_error& failure) {
        if (options_.precision != Precision::Float || dynamic_cast<const Aborted*>(&failure)) throw;
        options_.precision = Precision::Double;
        levels_.push_back(
            {model, computeBoundaryElementGreensFunctions(model, options_, callback)});
      }
    }
  }

  /// A level's part of the progress, as far as is foreseen: levels cost 64 times the one before.
  Progress partOf(int level) {
    const double begin = done_, share = std::pow(kLevelCost, std::min(0, level - expected_));
    done_ += kForeseen * share * (1 - done_);
    return progress_.part(begin, done_);
  }

  void requireAllowed(int vertices) const {
    if (vertices <= limits_.vertices) return;
    throw std::runtime_error("the surface has " + std::to_string(vertices) +
                             " vertices, more than the " + std::to_string(limits_.vertices) +
                             " that a tolerance may take: allow more, or make the mesh coarser");
  }

  bool mayRefine(int level) const {
    return level < limits_.levels && kLevelFactor * levels_[level].vertices() <= limits_.vertices;
  }

  ErrorEstimate estimateLevel(int level) {
    const bool isSmall = levels_[level].vertices() < kSmall;
    if (isSmall && mayRefine(level)) return estimateByFiner(level);
    if (!isSmall && level > 0 && levels_[level - 1].vertices() >= kLeastVertices)
      return estimateByCoarser(level);
    const Level& own = levels_[level];
    return estimateError(own.model, estimatedMethod(options_), *own.result.view(),
                         progress_.part(done_, done_));
  }

  ErrorEstimate estimateByFiner(int level) {
    solve(level + 1);
    const Level &own = levels_[level], &finer = levels_[level + 1];
    order_ = discretizationOrder(*finer.result.view());
    const double gain = std::pow(edgeRatio(finer, own), order_);
    return estimateBy(differenceOf(finer, own, own.loads()), gain / (gain - 1), own, own);
  }

  ErrorEstimate estimateByCoarser(int level) {
    const Level &own = levels_[level], &coarser = levels_[level - 1];
    order_ = level < 2 ? discretizationOrder(*own.result.view())
                       : observedOrder(own, coarser, levels_[level - 2]);
    const double gain = std::pow(edgeRatio(own, coarser), order_);
    return estimateBy(differenceOf(own, coarser, coarser.loads()), 1 / (gain - 1), own, coarser);
  }

  /// @param loaded  the level that the loads were chosen for.
  static ErrorEstimate estimateBy(const LoadDifferences& differences, double factor,
                                  const Level& own, const Level& loaded) {
    ErrorEstimate estimate = otherErrors(*own.result.view());
    addDiscretization(differences, factor, loaded.loads().length, estimate);
    return estimate;
  }

  std::string describe(int level, double error) const {
    std::ostringstream text;
    text << "level " << level << ", " << levels_[level].vertices() << " vertices, "
         << (levels_[level].result.floatMatrix.size() > 0 ? "single" : "double")
         << " precision, integrals to " << options_.tolerance << ": estimated error "
         << percent(error)
         << (kMargin * error <= tolerance_ ? ", by a fifth within " : ", not by a fifth within ")
         << percent(tolerance_);
    return text.str();
  }

  /// Whether a level that the limits allow may meet the tolerance, by the error of the last.
  void requireReachable(int level, double error) const {
    const int vertices = levels_[level].vertices();
    int more = 0;
    for (double next = double(kLevelFactor) * vertices;
         level + more < limits_.levels && next <= limits_.vertices; next *= kLevelFactor)
      ++more;
    const double reachable = error / std::pow(2.0, order_ * more);
    if (more > 0 && (vertices < kSmall || reachable <= kDoubtful * tolerance_)) return;
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

  const std::function<ElasticModel(int)>& model_;
  double tolerance_;
  ToleranceLimits limits_;
  BoundaryElementOptions options_;
  Progress progress_;
  std::vector<Level> levels_;
  double order_ = 1, done_ = 0;
  int expected_;  ///< level that may meet the tolerance
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
  ToleranceResult result = Search(level, tolerance, limits, options, whole).run();
  whole.report(1, "done");
  return result;
}

}  // namespace palpate
