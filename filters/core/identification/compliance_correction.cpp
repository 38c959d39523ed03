// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/compliance_correction.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

#include "greens/reciprocity.h"
#include "identification/compliance_kernel.h"
#include "identification/measured_values.h"
#include "sentence.h"

namespace palpate {
namespace {

constexpr double kMostSmoothing = 10, kLeastSmoothing = 1e-5;
constexpr double kFinerSmoothings[] = {3, 1 / 3.0};  // of the best of those ten times apart
constexpr double kWorse = 1.2;                       // an error over the least: no need to go on
constexpr double kGross = 3;        // of what chance explains: outliers whatever the correction
constexpr double kRounding = 1e-9;  // of the largest displacement: no residual to judge by
constexpr int kTrimmings = 3, kHalvings = 6;
constexpr double kSolved = 1e-3, kRoughlySolved = 3e-2;  // of the equations' right-hand side

/// The prior's compliance between free vertices, m/N.
Eigen::MatrixXd complianceOf(const GreensFunctions& greens, const std::vector<int>& free) {
  Eigen::MatrixXd compliance(3 * free.size(), 3 * free.size());
  greens.gather(nodeList(free), nodeList(free), compliance.data());
  for (std::size_t j = 0; j < free.size(); ++j)
    compliance.middleCols<3>(3 * j) /= greens.vertexArea(free[j]);
  return (compliance + compliance.transpose().eval()) / 2;
}

/// The leading modes of a compliance, where it does most work on tractions of one size: the sum of
/// the squares of all is the compliance.
Eigen::MatrixXd leadingModes(const Eigen::MatrixXd& compliance, const GreensFunctions& greens,
                             const std::vector<int>& free, int count) {
  Eigen::VectorXd roots(compliance.rows());
  for (std::size_t i = 0; i < free.size(); ++i)
    roots.segment<3>(3 * i).setConstant(std::sqrt(greens.vertexArea(free[i])));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(
      (roots.asDiagonal() * compliance * roots.asDiagonal()).eval());
  return roots.cwiseInverse().asDiagonal() * parts.eigenvectors().rightCols(count) *
         parts.eigenvalues().tail(count).cwiseMax(0).cwiseSqrt().asDiagonal();
}

/// The fit to a table, its smoothing chosen by probes left out, its outliers left out.
class CorrectionFit {
 public:
  CorrectionFit(const ComplianceKernel& correction, const MeasuredValues& table,
                const Eigen::VectorXd& prior, const CorrectionOptions& options)
      : correction_(correction),
        table_(table),
        prior_(prior),
        options_(options),
        unit_(table.weights().maxCoeff()) {}

  void run() {
    if (options_.leaveOutOutliers) markGrossOutliers();
    smoothing = options_.smoothing > 0 ? options_.smoothing : chosenSmoothing();
    fit();
    for (int i = 0; options_.leaveOutOutliers && i < kTrimmings && markOutliers(); ++i) {
      if (i == 0 && options_.smoothing == 0) smoothing = chosenSmoothing();
      fit();
    }
    if (options_.folds < 2) return;
    held = heldOut(smoothing, kSolved);
    priorHeld = heldOut(0, kSolved);
  }

  double smoothing = 0, factor = 1;
  Eigen::VectorXd pulls, residuals;
  Eigen::VectorXd held, priorHeld;  // residuals of probes left out; none without folds
  std::vector<int> outliers;

 private:
  /// At most 1.
  Eigen::VectorXd weights() const { return table_.weightsWithout(outliers) / unit_; }

  /// The most probable factor beside a correction that has its share in what was measured
  /// (generalised least squares; Rasmussen and Williams, 2.7).
  /// @param smoothing  0 without a correction.
  double factorBeside(double smoothing, const Eigen::VectorXd& weights) const {
    const double alone = table_.factorOf(prior_, weights);
    if (smoothing == 0) return alone;
    const Eigen::VectorXd pulls = correction_.pulls(prior_, weights, smoothing, kRoughlySolved);
    return pulls.dot(table_.measured()) / pulls.dot(prior_);
  }

  void fit() {
    factor = factorBeside(smoothing, weights());
    const Eigen::VectorXd left = table_.measured() - factor * prior_;
    pulls = correction_.pulls(left, weights(), smoothing, kSolved);
    residuals = left - correction_.seen(pulls);
  }

  /// The residuals of probes left out in turn; of one probe, of markers.
  /// @param smoothing  0 for the prior alone.
  /// @param tolerance  of the equations' right-hand side.
  Eigen::VectorXd heldOut(double smoothing, double tolerance) const {
    const Eigen::VectorXd weights = this->weights();
    const int folds = table_.foldCount(options_.folds);
    Eigen::VectorXd result = table_.measured();
    for (int fold = 0; fold < folds; ++fold) {
      const Eigen::VectorXd kept = table_.withoutFold(weights, fold, folds);
      if (kept.maxCoeff() == 0) continue;
      Eigen::VectorXd left = table_.measured() - factorBeside(smoothing, kept) * prior_;
      if (smoothing > 0)
        left -= correction_.seen(correction_.pulls(left, kept, smoothing, tolerance));
      table_.setFold(left, fold, folds, result);
    }
    return result;
  }

  /// The error at probes left out, by absolute values, as outliers may be among them.
  double errorWith(double smoothing) const {
    try {
      const Eigen::VectorXd counts = (weights().array() > 0).cast<double>();
      return counts.dot(heldOut(smoothing, kRoughlySolved).cwiseAbs());
    } catch (const TooLittleSmoothing&) {
      return std::numeric_limits<double>::infinity();
    }
  }

  /// The best at probes left out.
  double chosenSmoothing() const {
    double best = kMostSmoothing, least = std::numeric_limits<double>::infinity();
    const auto isTooBad = [&](double candidate) {
      const double error = errorWith(candidate);
      if (error < least) {
        least = error;
        best = candidate;
      }
      return error > kWorse * least;
    };
    for (double candidate = kMostSmoothing; candidate > kLeastSmoothing / 2; candidate /= 10)
      if (isTooBad(candidate)) break;
    const double coarse = best;
    for (double finer : kFinerSmoothings) isTooBad(finer * coarse);
    return best;
  }

  /// Those that are wrong beyond what any correction is for.
  void markGrossOutliers() {
    const Eigen::VectorXd left =
        table_.weights().cwiseProduct(table_.measured() - table_.robustFactorOf(prior_) * prior_);
    const double scale = table_.medianDeviationOf(left);
    if (scale > 0) outliers = table_.outliersOf(left / (kGross * scale));
  }

  /// How much of noise's variance residuals still have, the rest being taken for correction: a mean
  /// over components, by Hutchinson's estimate of a trace.
  double noiseLeft() const {
    const Eigen::VectorXd weights = this->weights();
    std::mt19937 random(1);
    Eigen::VectorXd signs = Eigen::VectorXd::Zero(weights.size());
    for (Eigen::Index i = 0; i < signs.size(); ++i)
      if (weights[i] > 0) signs[i] = (random() % 2 == 0 ? 1 : -1) / weights[i];
    const Eigen::VectorXd left =
        signs - correction_.seen(correction_.pulls(signs, weights, smoothing, kSolved));
    const double share = (weights.array().square() * signs.array() * left.array()).sum() /
                         static_cast<double>((weights.array() > 0).count());
    return std::clamp(share, kSolved, 1.0);
  }

  /// @return whether there are others now.
  bool markOutliers() {
    const Eigen::VectorXd weighted = table_.weights().cwiseProduct(residuals);
    const double scale = std::max(
        table_.medianDeviationOf(weighted) / std::sqrt(noiseLeft()),
        kRounding * table_.weights().cwiseProduct(table_.measured()).cwiseAbs().maxCoeff());
    const std::vector<int> before = outliers;
    outliers = table_.outliersOf(weighted / scale);
    return outliers != before;
  }

  const ComplianceKernel& correction_;
  const MeasuredValues& table_;
  const Eigen::VectorXd& prior_;
  const CorrectionOptions& options_;
  double unit_;
};

void requireSound(const GreensFunctions& prior, const CorrectionOptions& options, int free) {
  if (options.modes < 0 || options.modes > 3 * free)
    refuse("a correction has up to ", 3 * free, " modes, not ", options.modes);
  if (!(options.smoothing >= 0) || !std::isfinite(options.smoothing))
    refuse("the smoothing must be positive, or 0 to be chosen, not ", options.smoothing);
  if (options.smoothing == 0 && options.folds < 2)
    refuse("without cross-validation a smoothing must be given");
  if (!prior.info().reciprocal)
    refuse("the model to be corrected must be reciprocal: precompute it without --raw");
  if (prior.info().domain == Domain::Unsupported)
    refuse("an unsupported body is not corrected: its displacements are counted from its mean");
  if (prior.missingCount() > 0)
    refuse("the Green's functions of ", prior.missingCount(),
           " free vertices were not computed: precompute all");
}

/// C and how much of the correction is in it.
Eigen::MatrixXd definitePart(const Eigen::MatrixXd& scaledPrior, const Eigen::MatrixXd& correction,
                             double& share) {
  share = 1;
  for (int i = 0; i <= kHalvings; ++i, share /= 2) {
    const Eigen::MatrixXd compliance = scaledPrior + share * correction;
    if (Eigen::LLT<Eigen::MatrixXd>(compliance).info() == Eigen::Success) return compliance;
  }
  throw std::runtime_error(
      "the corrected compliance is not positive definite: the measurements contradict each other, "
      "or the prior is not definite itself");
}

void describe(const CorrectionFit& fitted, const MeasuredValues& table,
              MaterialIdentification& result) {
  result.parameters.push_back(
      {"factor on the prior's compliance", "", fitted.factor, 0, fitted.factor, fitted.factor});
  result.correlations = Eigen::MatrixXd::Identity(1, 1);
  table.describe(fitted.residuals, fitted.outliers, result);
  const Eigen::VectorXd weights = table.weightsWithout(fitted.outliers);
  if (fitted.held.size() > 0) {
    result.holdOutError = table.leftBy(fitted.held, weights);
    result.heldOutResiduals = table.byMarkers(fitted.held);
  }
  result.noise =
      std::sqrt((weights.array() > 0).select(fitted.residuals.array().square(), 0).sum() /
                std::max(1, result.valueCount));
}

/// Puts a compliance in place of the prior's, all else as it was.
void setMatrix(const GreensFunctions& prior, const std::vector<int>& free,
               const Eigen::MatrixXd& compliance, double factor, ComputedGreensFunctions& greens) {
  std::vector<int> rows(prior.nodeCount());
  std::iota(rows.begin(), rows.end(), 0);
  const std::vector<int>& columns = greens.info.columnNodes;
  greens.matrix = AlignedBuffer<double>(9 * rows.size() * columns.size());
  prior.gather(nodeList(rows), nodeList(columns), greens.matrix.data());
  Eigen::Map<Eigen::MatrixXd> matrix(greens.matrix.data(), 3 * rows.size(), 3 * columns.size());
  std::vector<int> number(rows.size(), -1);
  for (std::size_t i = 0; i < free.size(); ++i) number[free[i]] = static_cast<int>(i);
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (int row : rows) {
      auto block = matrix.block<3, 3>(3 * row, 3 * c);
      if (prior.isFixed(row) && prior.isFixed(columns[c]))
        block /= factor;
      else if (!prior.isFixed(row) && !prior.isFixed(columns[c]))
        block = prior.vertexArea(columns[c]) *
                compliance.block<3, 3>(3 * number[row], 3 * number[columns[c]]);
    }
}

}  // namespace

CorrectedGreensFunctions correctCompliance(const GreensFunctions& prior, const ElasticModel& model,
                                           const MeasuredSetup& setup,
                                           const Measurements& measurements,
                                           const CorrectionOptions& options,
                                           const ProgressCallback& callback) {
  const Progress progress(callback);
  progress.report(0, "gather");
  const std::vector<int> free = model.conditions().freeNodes();
  requireSound(prior, options, static_cast<int>(free.size()));
  const MeasuredValues table(measurements);
  if ((table.weights().array() > 0).count() < 6)
    refuse("a correction needs at least two measured displacements");
  const Eigen::MatrixXd compliance = complianceOf(prior, free);
  const Eigen::MatrixXd forces = nodalForces(setup, measurements, prior.info().vertexAreas);
  Eigen::MatrixXd loads(3 * free.size(), forces.cols());
  for (std::size_t i = 0; i < free.size(); ++i)
    loads.middleRows<3>(3 * i) = forces.middleRows<3>(3 * free[i]);
  const MarkerRows markers(setup, free, prior.nodeCount());
  const Eigen::VectorXd seen = markers.seen(compliance * loads);
  const int modes = options.modes > 0 ? options.modes : static_cast<int>(compliance.rows());
  const ComplianceKernel correction(leadingModes(compliance, prior, free, modes), loads, markers,
                                    progress);
  CorrectionFit fitted(correction, table, seen, options);
  fitted.run();

  CorrectedGreensFunctions result{
      ElasticModel(model.sharedMesh(), model.material(), model.conditions(), model.smoothPatches(),
                   Domain::Given),
      {},
      0,
      1,
      {},
      -1};
  progress.report(0.9, "compose");
  const Eigen::MatrixXd corrected =
      definitePart(fitted.factor * compliance, correction.matrix(fitted.pulls), result.share);
  GreensFunctionsInfo& info = result.greens.info;
  std::vector<int> columns = prior.info().columnNodes;
  info = infoOf(result.model, columns);
  info.homogeneous = false;
  info.rotationsHeld = prior.info().rotationsHeld;
  info.reciprocal = true;
  info.source = sentence(prior.info().source, "; corrected by ", measurements.displacements.size(),
                         " displacements under ", measurements.probes.size(), " probes");
  setMatrix(prior, free, corrected, fitted.factor, result.greens);
  info.diagnostics.reciprocityDefect = makeReciprocal(result.greens.matrix.data(), info.conditions,
                                                      info.vertexAreas, info.columnNodes, true);
  info.diagnostics.rockingCompliance = rockingCompliance(*result.greens.view(), model.mesh());
  result.smoothing = fitted.smoothing;
  describe(fitted, table, result.fit);
  if (fitted.priorHeld.size() > 0)
    result.priorHoldOutError =
        table.leftBy(fitted.priorHeld, table.weightsWithout(fitted.outliers));
  if (result.share < 1)
    result.fit.warnings.push_back(
        sentence("only ", shortly(100 * result.share),
                 " % of the correction was taken: more would not be positive definite"));
  if (result.fit.holdOutError > result.priorHoldOutError && result.priorHoldOutError > 0)
    result.fit.warnings.push_back(
        "probes left out are predicted no better than by the prior with one factor: the correction "
        "is of noise, or probes are too few");
  progress.report(1, "done");
  return result;
}

}  // namespace palpate
