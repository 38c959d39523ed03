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
  const double along = (squares * displacements.array() * measured_.array()).sum(),
               size = (squares * displacements.array().square()).sum();
  if (!(size > 0)) refuse("nothing moves at the markers, whatever the material");
  if ((squares * measured_.array().square()).sum() == 0)
    refuse("nothing moved: no displacement is other than zero");
  if (!(along > 0))
    refuse(
        "the displacements are against the forces, which no material explains: check the signs "
        "of the forces, which are those on the body");
  return along / size;
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
  result.residuals =
      (weights_.array() > 0).select(residuals, kNotMeasured).reshaped(3, markerCount());
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
}

}  // namespace palpate
