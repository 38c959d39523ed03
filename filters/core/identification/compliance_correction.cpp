// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/compliance_correction.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "greens/reciprocity.h"
#include "identification/compliance_kernel.h"
#include "identification/robust_statistics.h"
#include "identification/stiffness_field.h"
#include "sentence.h"

namespace palpate {
namespace {

constexpr double kSmoothings[] = {10, 1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5};
constexpr double kFalseOutliers = 0.01;  // expected in a table without any
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

/// The prior's factor that fits best.
double factorBy(const Eigen::VectorXd& prior, const MeasuredComponents& table,
                const Eigen::VectorXd& weights) {
  const Eigen::ArrayXd squares = weights.array().square();
  const double along = (squares * prior.array() * table.measured.array()).sum(),
               size = (squares * prior.array().square()).sum();
  if (!(size > 0)) refuse("nothing moves at the markers, whatever the stiffness");
  if (!(along > 0))
    refuse(
        "the displacements are against the forces: check the signs of the forces, which are those "
        "on the body");
  return along / size;
}

/// The fit to a table, its smoothing chosen by probes left out, its outliers left out.
class CorrectionFit {
 public:
  CorrectionFit(const ComplianceKernel& correction, const MeasuredComponents& table,
                const Eigen::VectorXd& prior, const MeasuredSetup& setup,
                const CorrectionOptions& options)
      : correction_(correction),
        table_(table),
        prior_(prior),
        setup_(setup),
        options_(options),
        weights_(table.weights) {}

  void run() {
    smoothing = options_.smoothing > 0 ? options_.smoothing : chosenSmoothing();
    fit();
    for (int i = 0; options_.leaveOutOutliers && i < kTrimmings && markOutliers(); ++i) fit();
    if (options_.folds < 2) return;
    holdOutError = heldOut(smoothing, true, 2);
    priorHoldOutError = heldOut(0, true, 2);
  }

  double smoothing = 0, factor = 1, holdOutError = -1, priorHoldOutError = -1;
  Eigen::VectorXd pulls, residuals;
  std::vector<int> outliers;
  const Eigen::VectorXd& weights() const { return weights_; }

 private:
  void fit() {
    factor = factorBy(prior_, table_, weights_);
    const Eigen::VectorXd left = table_.measured - factor * prior_;
    pulls = correction_.pulls(left, weights_, smoothing, kSolved);
    residuals = left - correction_.seen(pulls);
  }

  /// Of probes left out in turn, over the displacements; of one probe, of markers.
  /// @param smoothing  0 for the prior alone.
  /// @param power      2 for the root mean square, 1 where outliers may be among them.
  double heldOut(double smoothing, bool isFinal, int power) const {
    const int units = setup_.probeCount() > 1 ? setup_.probeCount() : setup_.markerCount();
    const int folds = std::min(options_.folds, units);
    double error = 0, size = 0;
    for (int fold = 0; fold < folds; ++fold) {
      Eigen::VectorXd kept = weights_;
      for (int i = 0; i < setup_.markerCount(); ++i)
        if ((setup_.probeCount() > 1 ? setup_.probeOf[i] : i) % folds == fold)
          kept.segment<3>(3 * i).setZero();
      if (kept.maxCoeff() == 0) continue;
      const Eigen::VectorXd left = table_.measured - factorBy(prior_, table_, kept) * prior_;
      Eigen::VectorXd wrong = left;
      if (smoothing > 0)
        wrong -= correction_.seen(
            correction_.pulls(left, kept, smoothing, isFinal ? kSolved : kRoughlySolved));
      for (Eigen::Index i = 0; i < wrong.size(); ++i)
        if (weights_[i] > 0 && kept[i] == 0) {
          error += std::pow(std::abs(wrong[i]), power);
          size += std::pow(std::abs(table_.measured[i]), power);
        }
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

  /// @return whether there are others now.
  bool markOutliers() {
    std::vector<double> sizes;
    const Eigen::VectorXd weighted = table_.weights.cwiseProduct(residuals);
    for (Eigen::Index i = 0; i < weighted.size(); ++i)
      if (table_.weights[i] > 0) sizes.push_back(std::abs(weighted[i]));
    const double scale = medianDeviation(std::move(sizes));
    const double most = chiSquaredOf(kFalseOutliers / setup_.markerCount()) * scale * scale;
    std::vector<int> found;
    weights_ = table_.weights;
    for (int i = 0; i < setup_.markerCount(); ++i)
      if (weighted.segment<3>(3 * i).squaredNorm() > most) {
        found.push_back(i);
        weights_.segment<3>(3 * i).setZero();
      }
    const bool changed = found != outliers;
    outliers = found;
    return changed;
  }

  const ComplianceKernel& correction_;
  const MeasuredComponents& table_;
  const Eigen::VectorXd& prior_;
  const MeasuredSetup& setup_;
  const CorrectionOptions& options_;
  Eigen::VectorXd weights_;
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

void describe(const CorrectionFit& fitted, const MeasuredComponents& table,
              const Measurements& measurements, MaterialIdentification& result) {
  result.parameters.push_back(
      {"factor on the prior's compliance", "", fitted.factor, 0, fitted.factor, fitted.factor});
  result.correlations = Eigen::MatrixXd::Identity(1, 1);
  result.residuals = fitted.residuals.reshaped(3, measurements.displacements.size());
  result.outliers = fitted.outliers;
  result.holdOutError = fitted.holdOutError;
  double sum = 0;
  std::vector<double> residuals(measurements.probes.size()), sizes(residuals), values(residuals);
  for (const Probe& probe : measurements.probes) result.probes.push_back({probe.name});
  for (Eigen::Index i = 0; i < fitted.residuals.size(); ++i) {
    const int p = measurements.displacements[i / 3].probe;
    if (i % 3 == 0) ++result.probes[p].markers;
    if (table.weights[i] == 0)
      result.residuals.reshaped()[i] = std::numeric_limits<double>::quiet_NaN();
    if (fitted.weights()[i] == 0) continue;
    ++result.valueCount;
    ++values[p];
    sum += std::pow(fitted.residuals[i], 2);
    residuals[p] += std::pow(fitted.residuals[i], 2);
    sizes[p] += std::pow(table.measured[i], 2);
  }
  for (int i : fitted.outliers) ++result.probes[measurements.displacements[i].probe].outliers;
  for (std::size_t p = 0; p < result.probes.size(); ++p)
    if (values[p] > 0) {
      result.probes[p].residual = std::sqrt(residuals[p] / values[p]);
      result.probes[p].relative = sizes[p] > 0 ? std::sqrt(residuals[p] / sizes[p]) : 0;
    }
  result.noise = std::sqrt(sum / std::max(1, result.valueCount));
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
  const MeasuredComponents table(setup, measurements, free, prior.nodeCount());
  if ((table.weights.array() > 0).count() < 6)
    refuse("a correction needs at least two measured displacements");
  const Eigen::MatrixXd compliance = complianceOf(prior, free);
  const Eigen::MatrixXd forces = nodalForces(setup, measurements, prior.info().vertexAreas);
  Eigen::MatrixXd loads(3 * free.size(), forces.cols());
  for (std::size_t i = 0; i < free.size(); ++i)
    loads.middleRows<3>(3 * i) = forces.middleRows<3>(3 * free[i]);
  const Eigen::VectorXd seen = table.seen(compliance * loads);
  const ComplianceKernel correction(
      options.modes > 0 ? leadingPart(compliance, prior, free, options.modes) : compliance, loads,
      table, progress);
  CorrectionFit fitted(correction, table, seen, setup, options);
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
  describe(fitted, table, measurements, result.fit);
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
