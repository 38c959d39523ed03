// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/measured_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "identification/robust_statistics.h"
#include "sentence.h"

namespace palpate {
namespace {

constexpr double kFalseOutliers = 0.01;  // expected in a table without any
constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
constexpr double kMost = 0.7;                       // of the displacements under a probe
constexpr double kManyOutliers = 0.2;               // of the displacements
constexpr double kNothing = 0.97, kDoubtful = 0.5;  // residuals over displacements

constexpr const char* kCheck =
    "check which rows are of which probe and marker, signs, frames and units, or identify what "
    "differs from the model";

void warnOfFit(MaterialIdentification& result) {
  const double explained = std::max(0.0, 100 * (1 - std::pow(result.fitError, 2)));
  if (result.fitError > kNothing)
    refuse(
        "the displacements that were measured are not this body's under these forces: the model "
        "that fits best explains ",
        shortly(explained), " % of their squares; ", kCheck);
  if (result.fitError > kDoubtful)
    result.warnings.push_back(sentence("the model explains only ", shortly(explained),
                                       " % of the squares of the displacements: ", kCheck));
  const double share =
      double(result.outliers.size()) / static_cast<double>(result.residuals.cols());
  if (share > kManyOutliers)
    result.warnings.push_back(
        sentence(shortly(100 * share),
                 " % of the displacements contradict the rest: the table or the model is wrong"));
}

}  // namespace

MeasuredValues::MeasuredValues(const Measurements& measurements) : table_(measurements) {
  measured_.setZero(3 * markerCount());
  weights_.setZero(3 * markerCount());
  for (int i = 0; i < markerCount(); ++i) {
    const MeasuredDisplacement& here = measurements.displacements[i];
    for (int c = 0; c < 3; ++c)
      if (!std::isnan(here.displacement[c])) {
        measured_[3 * i + c] = here.displacement[c];
        weights_[3 * i + c] = measurements.hasDeviations() ? 1 / here.deviation[c] : 1;
      }
  }
}

Eigen::VectorXd MeasuredValues::weightsWithout(const std::vector<int>& outliers) const {
  Eigen::VectorXd weights = weights_;
  for (int i : outliers) weights.segment<3>(3 * i).setZero();
  return weights;
}

double MeasuredValues::factorOf(const Eigen::VectorXd& displacements,
                                const Eigen::VectorXd& weights) const {
  const Eigen::ArrayXd squares = weights.array().square();
  return (squares * displacements.array() * measured_.array()).sum() /
         (squares * displacements.array().square()).sum();
}

double MeasuredValues::robustFactorOf(const Eigen::VectorXd& displacements) const {
  std::vector<Share> factors;
  std::vector<std::vector<Share>> ofProbes(table_.probes.size());
  for (int i = 0; i < markerCount(); ++i) {
    const Eigen::Vector3d weights = weights_.segment<3>(3 * i),
                          expected = weights.cwiseProduct(displacements.segment<3>(3 * i)),
                          seen = weights.cwiseProduct(measured_.segment<3>(3 * i));
    const double size = expected.norm();
    if (size == 0) continue;
    factors.push_back({expected.dot(seen) / (size * size), size});
    ofProbes[table_.displacements[i].probe].push_back(factors.back());
  }
  if (factors.empty()) refuse("nothing moves at the markers, whatever the material");
  if (measured_.isZero(0)) refuse("nothing moved: no displacement is other than zero");
  requireAlongForces(ofProbes);
  const double factor = weightedQuantile(std::move(factors), 0.5);
  if (!(factor > 0))
    refuse("displacements are as often against the forces as along them: ", kCheck);
  return factor;
}

/// Of most markers under most probes.
void MeasuredValues::requireAlongForces(const std::vector<std::vector<Share>>& ofProbes) const {
  std::string names;
  std::size_t count = 0;
  for (std::size_t p = 0; p < ofProbes.size(); ++p)
    if (!ofProbes[p].empty() && weightedQuantile(ofProbes[p], kMost) < 0) {
      names += (count++ > 0 ? ", " : "") + table_.probes[p].name;
    }
  if (static_cast<double>(count) > kManyOutliers * static_cast<double>(ofProbes.size()))
    refuse("the displacements are against the forces, which no material explains, under ", count,
           " of ", ofProbes.size(), " probes (", names,
           "): check the signs of the forces, which are those on the body");
}

double MeasuredValues::medianDeviationOf(const Eigen::VectorXd& residuals) const {
  std::vector<double> sizes;
  for (Eigen::Index i = 0; i < residuals.size(); ++i)
    if (weights_[i] > 0) sizes.push_back(std::abs(residuals[i]));
  return medianDeviation(std::move(sizes));
}

std::vector<int> MeasuredValues::outliersOf(const Eigen::VectorXd& residuals) const {
  const double most = chiSquaredOf(kFalseOutliers / markerCount());
  std::vector<int> outliers;
  for (int i = 0; i < markerCount(); ++i)
    if (residuals.segment<3>(3 * i).squaredNorm() > most) outliers.push_back(i);
  return outliers;
}

int MeasuredValues::foldCount(int wanted) const {
  const int probes = static_cast<int>(table_.probes.size());
  return std::min(wanted, probes > 1 ? probes : markerCount());
}

Eigen::VectorXd MeasuredValues::withoutFold(const Eigen::VectorXd& weights, int fold,
                                            int folds) const {
  const bool isByProbes = table_.probes.size() > 1;
  Eigen::VectorXd kept = weights;
  for (int i = 0; i < markerCount(); ++i)
    if ((isByProbes ? table_.displacements[i].probe : i) % folds == fold)
      kept.segment<3>(3 * i).setZero();
  return kept;
}

void MeasuredValues::setFold(const Eigen::VectorXd& residuals, int fold, int folds,
                             Eigen::VectorXd& held) const {
  const Eigen::VectorXd kept = withoutFold(weights_, fold, folds);
  held = (kept.array() == 0 && weights_.array() > 0).select(residuals, held);
}

Eigen::Matrix3Xd MeasuredValues::byMarkers(const Eigen::VectorXd& values) const {
  return (weights_.array() > 0).select(values, kNotMeasured).reshaped(3, markerCount());
}

double MeasuredValues::leftBy(const Eigen::VectorXd& residuals,
                              const Eigen::VectorXd& weights) const {
  const Eigen::ArrayXd counts = (weights.array() > 0).cast<double>();
  const double size = (counts * measured_.array().square()).sum();
  return size > 0 ? std::sqrt((counts * residuals.array().square()).sum() / size) : 0;
}

void MeasuredValues::describe(const Eigen::VectorXd& residuals, const std::vector<int>& outliers,
                              MaterialIdentification& result) const {
  const int probes = static_cast<int>(table_.probes.size());
  const Eigen::VectorXd weights = weightsWithout(outliers);
  result.residuals = byMarkers(residuals);
  result.outliers = outliers;
  result.valueCount = static_cast<int>((weights.array() > 0).count());
  for (const Probe& probe : table_.probes) result.probes.push_back({probe.name});
  for (int i : outliers) ++result.probes[table_.displacements[i].probe].outliers;
  std::vector<double> values(probes), squares(probes), sizes(probes);
  for (int i = 0; i < markerCount(); ++i) {
    const int p = table_.displacements[i].probe;
    ++result.probes[p].markers;
    for (int place = 3 * i; place < 3 * i + 3; ++place)
      if (weights[place] > 0) {
        ++values[p];
        squares[p] += std::pow(residuals[place], 2);
        sizes[p] += std::pow(measured_[place], 2);
      }
  }
  result.fitError = leftBy(residuals, weights);
  for (int p = 0; p < probes; ++p) {
    if (values[p] == 0) continue;
    result.probes[p].residual = std::sqrt(squares[p] / values[p]);
    result.probes[p].relative = sizes[p] > 0 ? std::sqrt(squares[p] / sizes[p]) : 0;
  }
  warnOfFit(result);
}

}  // namespace palpate
