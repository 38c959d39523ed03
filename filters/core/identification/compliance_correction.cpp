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

constexpr double kSmoothings[] = {10, 1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5};
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

/// That of its leading modes: where it does most work on tractions of one size.
Eigen::MatrixXd leadingPart(const Eigen::MatrixXd& compliance, const GreensFunctions& greens,
                            const std::vector<int>& free, int modes) {
  Eigen::VectorXd roots(compliance.rows());
  for (std::size_t i = 0; i < free.size(); ++i)
    roots.segment<3>(3 * i).setConstant(std::sqrt(greens.vertexArea(free[i])));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(
      (roots.asDiagonal() * compliance * roots.asDiagonal()).eval());
  const Eigen::MatrixXd leading =
      roots.cwiseInverse().asDiagonal() * parts.eigenvectors().rightCols(modes) *
      parts.eigenvalues().tail(modes).cwiseMax(0).cwiseSqrt().asDiagonal();
  return leading * leading.transpose();
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
    smoothing = options_.smoothing > 0 ? options_.smoothing : chosenSmoothing();
    fit();
    for (int i = 0; options_.leaveOutOutliers && i < kTrimmings && markOutliers(); ++i) {
      if (i == 0 && options_.smoothing == 0) smoothing = chosenSmoothing();
      fit();
    }
    if (options_.folds < 2) return;
    holdOutError = heldOut(smoothing, true, 2);
    priorHoldOutError = heldOut(0, true, 2);
  }

  double smoothing = 0, factor = 1, holdOutError = -1, priorHoldOutError = -1;
  Eigen::VectorXd pulls, residuals;
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

  /// Of probes left out in turn, over the displacements; of one probe, of markers.
  /// @param smoothing  0 for the prior alone.
  /// @param power      2 for the root mean square, 1 where outliers may be among them.
  double heldOut(double smoothing, bool isFinal, int power) const {
    const Eigen::VectorXd weights = this->weights();
    const int folds = table_.foldCount(options_.folds);
    double error = 0, size = 0;
    for (int fold = 0; fold < folds; ++fold) {
      const Eigen::VectorXd kept = table_.withoutFold(weights, fold, folds);
      if (kept.maxCoeff() == 0) continue;
      const Eigen::VectorXd left = table_.measured() - factorBeside(smoothing, kept) * prior_;
      Eigen::VectorXd wrong = left;
      if (smoothing > 0)
        wrong -= correction_.seen(
            correction_.pulls(left, kept, smoothing, isFinal ? kSolved : kRoughlySolved));
      const Eigen::ArrayXd held = (weights.array() > 0 && kept.array() == 0).cast<double>();
      error += (held * wrong.array().abs().pow(power)).sum();
      size += (held * table_.measured().array().abs().pow(power)).sum();
    }
    return size > 0 ? std::pow(error / size, 1.0 / power) : -1;
  }

  double chosenSmoothing() const {
    double best = kSmoothings[0], least = std::numeric_limits<double>::infinity();
    for (double candidate : kSmoothings) {
      const double error = heldOut(candidate, false, 1);
      if (error < least) {
        least = error;
        best = candidate;
      } else if (error > 1.5 * least) {
        break;
      }
    }
    return best;
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
  result.holdOutError = fitted.holdOutError;
  const Eigen::VectorXd weights = table.weightsWithout(fitted.outliers);
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
  const ComplianceKernel correction(
      options.modes > 0 ? leadingPart(compliance, prior, free, options.modes) : compliance, loads,
      markers, progress);
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
  result.priorHoldOutError = fitted.priorHoldOutError;
  describe(fitted, table, result.fit);
  if (result.share < 1)
    result.fit.warnings.push_back(
        sentence("only ", shortly(100 * result.share),
                 " % of the correction was taken: more would not be positive definite"));
  if (fitted.holdOutError > fitted.priorHoldOutError && fitted.priorHoldOutError > 0)
    result.fit.warnings.push_back(
        "probes left out are predicted no better than by the prior with one factor: the correction "
        "is of noise, or probes are too few");
  progress.report(1, "done");
  return result;
}

}  // namespace palpate
