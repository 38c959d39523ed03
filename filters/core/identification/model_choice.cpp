// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/model_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "identification/measured_values.h"

namespace palpate {
namespace {

constexpr double kAsGood = 1.05;  // an error over the least

/// How many of the kinds that predict anything take a marker for an outlier, as a share.
Eigen::VectorXd outlierShares(const std::vector<TriedModel>& tried, int markers) {
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(markers);
  int kinds = 0;
  for (const TriedModel& model : tried) {
    if (model.heldOut.size() == 0) continue;
    ++kinds;
    for (int marker : model.outliers) ++counts[marker];
  }
  return counts / std::max(1, kinds);
}

/// The sum over a table, and its standard error by how probes (of one probe, markers) differ.
struct Sum {
  double value, deviation;
};

Sum sumOver(const Eigen::VectorXd& byMarker, const Measurements& table) {
  const bool isByProbes = table.probes.size() > 1;
  Eigen::VectorXd parts = byMarker;
  if (isByProbes) {
    parts.setZero(static_cast<Eigen::Index>(table.probes.size()));
    for (Eigen::Index i = 0; i < byMarker.size(); ++i)
      parts[table.displacements[i].probe] += byMarker[i];
  }
  const double count = static_cast<double>(parts.size()),
               variance = (parts.array() - parts.mean()).square().sum() / std::max(1.0, count - 1);
  return {parts.sum(), std::sqrt(count * variance)};
}

}  // namespace

ModelChoice chooseModel(const Measurements& measurements, const std::vector<TriedModel>& tried) {
  const MeasuredValues table(measurements);
  const int markers = table.markerCount();
  const Eigen::VectorXd shares = outlierShares(tried, markers);
  const auto counted = [&](const Eigen::Matrix3Xd& values) -> Eigen::VectorXd {
    return (shares.array() < 1)
        .select(values.array().isNaN().select(0, values).colwise().squaredNorm().transpose(), 0);
  };
  const double size = counted(table.measured().reshaped(3, markers)).sum();
  ModelChoice choice;
  std::vector<Eigen::VectorXd> squares;
  int best = -1;
  for (std::size_t k = 0; k < tried.size(); ++k) {
    const bool predicts = tried[k].heldOut.size() > 0 && size > 0;
    squares.push_back(predicts ? counted(tried[k].heldOut) : Eigen::VectorXd());
    choice.errors.push_back(predicts ? std::sqrt(squares[k].sum() / size)
                                     : std::numeric_limits<double>::quiet_NaN());
    if (predicts && !(best >= 0 && choice.errors[best] <= choice.errors[k]))
      best = static_cast<int>(k);
  }
  for (int k = 0; choice.taken < 0 && k <= best; ++k) {
    if (std::isnan(choice.errors[k])) continue;
    const Sum worse = sumOver(squares[k] - squares[best], measurements);
    if (choice.errors[k] <= kAsGood * choice.errors[best] || worse.value <= worse.deviation)
      choice.taken = k;
  }
  return choice;
}

}  // namespace palpate
