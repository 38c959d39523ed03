// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/tolerance_search.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <sstream>
#include <stdexcept>

#include "bem/tolerance_levels.h"
#include "mesh/rim_grading.h"

namespace palpate {
namespace {

constexpr double kShareOfOthers = 0.01;  // of the tolerance, for integrals and arithmetic
constexpr double kFloatTolerance = 1e-3;
constexpr double kLeastIntegration = 1e-6, kMostIntegration = 1e-3;
constexpr double kMargin = 1.2;      // of estimates that are relied on
constexpr double kDoubtful = 2;      // predictions may be wrong by this factor
constexpr int kLeastVertices = 50;   // of a level that tells of the next one's error
constexpr int kLeastWithParts = 20;  // of one that also shows its parts
constexpr int kSmall = 200;  // vertices; below, the next level tells of the error, and costs little
constexpr double kLevelCost = 64;
constexpr double kForeseen = 0.9;  // share of the progress; the rest is left for one level more

std::string percent(double share) {
  std::ostringstream text;
  text.precision(2);
  text << 100 * share << " %";
  return text.str();
}

std::string alongRim(int layers) {
  if (layers == 0) return "";
  return " with " + std::to_string(layers) + (layers == 1 ? " layer" : " layers") +
         " along the rim of the support";
}

/// The parts of a level's error without layers, as ToleranceLevels tells them.
struct ErrorParts {
  int level = 0;
  double rim = 0, rest = 0;

  double at(MeshSetting setting) const {
    const double edges = std::pow(kEdgeGrowth, setting.level - level);
    return rim * std::pow(kLayerShare, setting.layers) / edges + rest / (edges * edges);
  }

  /// At the level of a mesh whose error is known; of several there the largest rest.
  ErrorParts observed(MeshSetting setting, double error) const {
    const double edges = std::pow(kEdgeGrowth, setting.level - level), there = rim / edges;
    const double left = there * std::pow(kLayerShare, setting.layers);
    return {setting.level, there, std::max(error - left, setting.level == level ? rest : 0.0)};
  }
};

/// A mesh that was not tried yet, and what is expected of it.
struct Candidate {
  MeshSetting setting;
  double vertices, error;
};

class Search {
 public:
  Search(const MeshHierarchy& hierarchy, double tolerance, const ToleranceLimits& limits,
         const BoundaryElementOptions& options, const Progress& progress)
      : tolerance_(tolerance),
        limits_(limits),
        levels_(hierarchy, limits.vertices, optionsFor(tolerance, options)),
        progress_(progress),
        expected_(std::min(limits.levels, 2)) {}

  ToleranceResult run() {
    for (int k = 0;; ++k) {
      solveUpTo(k);
      if (judge({k, 0}, estimateLevel(k))) return result();
      if (showsParts(k)) return chooseLayers(k);
      requireReachable(k);
      const double missing = std::log2(kMargin * best_.error / tolerance_) / order_;
      expected_ = k + std::max(1, static_cast<int>(std::ceil(missing)));
    }
  }

 private:
  static BoundaryElementOptions optionsFor(double tolerance, BoundaryElementOptions options) {
    options.estimateError = false;  // done here
    options.solver = LinearSolver::Direct;
    options.tolerance = std::clamp(kShareOfOthers * tolerance, kLeastIntegration, kMostIntegration);
    options.precision = tolerance < kFloatTolerance ? Precision::Double : Precision::Float;
    return options;
  }

  /// Notes an estimate, and whether it is within the tolerance.
  bool judge(MeshSetting setting, const ErrorEstimate& estimate) {
    const double error = estimate.most();
    if (error < 0)
      throw std::runtime_error(
          "no error can be estimated for this surface: leave out the tolerance");
    steps_.push_back(describe(setting, error));
    tried_.insert(setting);
    if (tried_.size() == 1 || error < best_.error) {
      best_ = {setting, double(vertices(setting)), error};
      bestEstimate_ = estimate;
    }
    return kMargin * error <= tolerance_;
  }

  /// The best.
  ToleranceResult result() {
    ToleranceResult result{best_.setting.level, best_.setting.layers, levels_.take(best_.setting),
                           std::move(steps_)};
    result.greens.info.diagnostics.error = bestEstimate_;
    return result;
  }

  int vertices(MeshSetting setting) const { return levels_.at(setting).vertices(); }

  std::shared_ptr<const GreensFunctions> greens(int level) const {
    return levels_.at({level, 0}).result.view();
  }

  void solveUpTo(int level) {
    for (int k = 0; k <= level; ++k)
      if (!levels_.isSolved({k, 0})) levels_.solve({k, 0}, partOf(k));
  }

  /// A level's part of the progress, as far as is foreseen: levels cost 64 times the one before.
  Progress partOf(int level) {
    return nextPart(kForeseen * std::pow(kLevelCost, std::min(0, level - expected_)));
  }

  /// @param share  of what is left.
  Progress nextPart(double share) {
    const double begin = done_;
    done_ += share * (1 - done_);
    return progress_.part(begin, done_);
  }

  bool mayRefine(int level) const {
    return level < limits_.levels && kLevelGrowth * vertices({level, 0}) <= limits_.vertices;
  }

  bool hasCoarser(int level) const {
    return level > 0 && vertices({level - 1, 0}) >= kLeastVertices;
  }

  ErrorEstimate estimateLevel(int level) {
    const bool isSmall = vertices({level, 0}) < kSmall;
    if (showsParts(level)) return levels_.estimateByParts({level, 0});
    if (isSmall && mayRefine(level)) return estimateByFiner(level);
    if (!isSmall && hasCoarser(level)) return estimateByCoarser(level);
    return estimateError(levels_.at({level, 0}).model, estimatedMethod(levels_.options()),
                         *greens(level), progress_.part(done_, done_));
  }

  LoadDifferences differences(int finer, const SpreadLoads& loads) const {
    return levels_.differences({finer, 0}, {finer - 1, 0}, loads);
  }

  ErrorEstimate estimateByFiner(int level) {
    solveUpTo(level + 1);
    order_ = discretizationOrder(*greens(level + 1));
    const double gain = std::pow(levels_.edgeRatio(level + 1), order_);
    return estimateBy(level + 1, levels_.loads(level), gain / (gain - 1), level);
  }

  ErrorEstimate estimateByCoarser(int level) {
    order_ = level < 2 ? discretizationOrder(*greens(level)) : observedOrder(level);
    const double gain = std::pow(levels_.edgeRatio(level), order_);
    return estimateBy(level, levels_.loads(level - 1), 1 / (gain - 1), level);
  }

  /// @param finer  of the two levels whose difference, by this factor, is the error.
  ErrorEstimate estimateBy(int finer, const SpreadLoads& loads, double factor, int level) const {
    ErrorEstimate estimate = otherErrors(*greens(level));
    addDiscretization(differences(finer, loads), factor, loads.length, estimate);
    return estimate;
  }

  /// The order that three levels show under the loads of the coarsest, between a half and two.
  double observedOrder(int fine) const {
    const SpreadLoads loads = levels_.loads(fine - 2);
    const double before = LoadDifferences::mean(differences(fine - 1, loads).field),
                 after = LoadDifferences::mean(differences(fine, loads).field);
    return std::clamp(std::log(before / after) / std::log(levels_.edgeRatio(fine)), 0.5, 2.0);
  }

  /// Whether the level before can show the parts of a level's error: it is large enough, and there
  /// is a rim.
  bool showsParts(int level) {
    const MeshSetting before{level - 1, 0}, layered{level - 1, 1};
    if (limits_.layers == 0) return false;
    if (level == 0 ? !levels_.hasCoarsened() : vertices(before) < kLeastWithParts) return false;
    if (!levels_.isAllowed(layered)) return false;
    try {
      levels_.solve(before, nextPart(1 / kLevelCost));
      levels_.solve(layered, nextPart(1 / kLevelCost));
    } catch (const std::runtime_error& failure) {
      if (level > 0 || dynamic_cast<const Aborted*>(&failure)) throw;
      return false;  // what was coarsened is singular
    }
    return vertices(layered) > vertices(before);
  }

  /// Tries meshes, the smallest that should meet the tolerance first.
  ToleranceResult chooseLayers(int level) {
    const MeshSetting plain{level - 1, 0}, layered{level - 1, 1};
    const double ratio = levels_.edgeRatio(level),
                 rim = mostOf(levels_.rimErrors(layered, levels_.loads(level - 1))) / ratio;
    ErrorParts parts = ErrorParts{level, rim, 0}.observed({level, 0}, best_.error);
    const double layer = ratio * (vertices(layered) - vertices(plain));
    bool isProbed = false;
    for (;;) {
      const std::vector<Candidate> all = candidates(parts, level, layer);
      const Candidate* next = choose(all);
      if (!isProbed) next = probe(all, next);
      isProbed = true;
      if (!next) refuse(bestOf(all));
      const MeshSetting setting = next->setting;
      if (!levels_.isAllowed(setting)) {
        tried_.insert(setting);
        continue;
      }
      levels_.solveWithCoarser(setting, nextPart(kForeseen));
      const ErrorEstimate estimate = levels_.estimateByParts(setting);
      if (judge(setting, estimate)) return result();
      parts = parts.observed(setting, estimate.most());
    }
  }

  /// What the limits allow from a level on and was not tried; no small level before the last.
  /// @param layer  vertices of a layer there.
  std::vector<Candidate> candidates(const ErrorParts& parts, int level, double layer) const {
    std::vector<Candidate> all;
    double plain = vertices({level, 0});
    for (int k = level; k <= limits_.levels; ++k) {
      const bool isPassed =
          plain < kSmall && k < limits_.levels && kLevelGrowth * plain <= limits_.vertices;
      for (int layers = 0; !isPassed && layers <= limits_.layers; ++layers) {
        const MeshSetting setting{k, layers};
        const double count = plain + layers * layer;
        if (count <= limits_.vertices && tried_.count(setting) == 0)
          all.push_back({setting, count, parts.at(setting)});
      }
      plain *= kLevelGrowth;
      layer *= kEdgeGrowth;
    }
    return all;
  }

  /// The one with the least error that is expected, if that is below the best's so far.
  const Candidate* bestOf(const std::vector<Candidate>& all) const {
    const auto best = std::min_element(
        all.begin(), all.end(), [](const auto& a, const auto& b) { return a.error < b.error; });
    return best != all.end() && best->error < best_.error ? &*best : nullptr;
  }

  /// The smallest that should meet the tolerance, or the best if it may.
  const Candidate* choose(const std::vector<Candidate>& all) const {
    const Candidate* smallest = nullptr;
    for (const Candidate& candidate : all)
      if (kMargin * candidate.error <= tolerance_ &&
          (!smallest || candidate.vertices < smallest->vertices))
        smallest = &candidate;
    if (smallest) return smallest;
    const Candidate* best = bestOf(all);
    return best && best->error <= kDoubtful * tolerance_ ? best : nullptr;
  }

  /// Before a level is left or all are refused, what tells most of them at little cost: a layer on
  /// the first.
  const Candidate* probe(const std::vector<Candidate>& all, const Candidate* next) const {
    if (all.empty() || (next && next->setting.level == all.front().setting.level)) return next;
    for (const Candidate& candidate : all)
      if (candidate.setting.level == all.front().setting.level && candidate.setting.layers == 1)
        return &candidate;
    return next;
  }

  std::string describe(MeshSetting setting, double error) const {
    std::ostringstream text;
    text << "level " << setting.level << ", " << vertices(setting) << " vertices"
         << alongRim(setting.layers) << ", "
         << (levels_.at(setting).result.floatMatrix.size() > 0 ? "single" : "double")
         << " precision, integrals to " << levels_.options().tolerance << ": estimated error "
         << percent(error)
         << (kMargin * error <= tolerance_ ? ", by a fifth within " : ", not by a fifth within ")
         << percent(tolerance_);
    return text.str();
  }

  /// Whether a level that the limits allow may meet the tolerance, by the error of the last.
  void requireReachable(int level) const {
    Candidate last{{level, 0}, double(vertices({level, 0})), 0};
    while (last.setting.level < limits_.levels &&
           kLevelGrowth * last.vertices <= limits_.vertices) {
      ++last.setting.level;
      last.vertices *= kLevelGrowth;
    }
    const int more = last.setting.level - level;
    if (more == 0) refuse(nullptr);
    // Layers may yet take the rim's part away, which leaves an order of two.
    const double order = limits_.layers > 0 ? std::max(order_, 2.0) : order_;
    last.error = best_.error / std::pow(kEdgeGrowth, order * more);
    if (vertices({level, 0}) >= kSmall && last.error > kDoubtful * tolerance_) refuse(&last);
  }

  /// @param best  of the meshes that the limits allow, if it is better than those tried.
  [[noreturn]] void refuse(const Candidate* best) const {
    std::ostringstream text;
    text << "a tolerance of " << percent(tolerance_) << " is out of reach: level "
         << best_.setting.level << " with its " << best_.vertices << " vertices"
         << alongRim(best_.setting.layers) << " has an estimated error of " << percent(best_.error);
    std::ostringstream within;
    within << " within " << limits_.levels << " refinements and " << limits_.vertices
           << " vertices";
    if (best)
      text << ", and level " << best->setting.level << ", the last" << within.str()
           << ", would have about " << percent(best->error) << alongRim(best->setting.layers);
    else
      text << " and is the " << (tried_.size() > 1 ? "best" : "last") << within.str();
    throw std::runtime_error(text.str());
  }

  const double tolerance_;
  const ToleranceLimits limits_;
  ToleranceLevels levels_;
  Progress progress_;
  double order_ = 1, done_ = 0;
  int expected_;  ///< level that may meet the tolerance
  std::set<MeshSetting> tried_;
  Candidate best_;  ///< of those
  ErrorEstimate bestEstimate_;
  std::vector<std::string> steps_;
};

}  // namespace

ToleranceResult computeToTolerance(const MeshHierarchy& hierarchy, double tolerance,
                                   const ToleranceLimits& limits,
                                   const BoundaryElementOptions& options,
                                   const ProgressCallback& progress) {
  if (!(tolerance > 0 && tolerance < 1))
    throw std::invalid_argument("the tolerance must be above 0 and below 1, not " +
                                std::to_string(tolerance));
  const Progress whole(progress);
  ToleranceResult result = Search(hierarchy, tolerance, limits, options, whole).run();
  whole.report(1, "done");
  return result;
}

}  // namespace palpate
