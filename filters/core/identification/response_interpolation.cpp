// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/response_interpolation.h"

#include <algorithm>
#include <cmath>

#include "sentence.h"

namespace palpate {
namespace {

constexpr int kMostPoints = 20;  // a coordinate

/// Lagrange's polynomials of some points at a place, and their derivatives.
struct Lagrange {
  std::vector<double> values, slopes;

  Lagrange(const std::vector<double>& points, int count, double at)
      : values(count, 1), slopes(count, 0) {
    for (int j = 0; j < count; ++j)
      for (int k = 0; k < count; ++k) {
        if (k == j) continue;
        const double gap = points[j] - points[k];
        slopes[j] = slopes[j] * (at - points[k]) / gap + values[j] / gap;
        values[j] *= (at - points[k]) / gap;
      }
  }
};

}  // namespace

std::vector<double> lejaPoints(int count) {
  constexpr int kGrid = 2000;
  std::vector<double> points{0};
  while (int(points.size()) < count) {
    double best = 0, most = -1;
    for (int i = 0; i <= kGrid; ++i) {
      const double x = 1 - 2.0 * i / kGrid;
      double product = 1;
      for (double p : points) product *= std::abs(x - p);
      if (product > most) {
        most = product;
        best = x;
      }
    }
    points.push_back(best);
  }
  points.resize(count);
  return points;
}

ResponseInterpolation::ResponseInterpolation(Sample sample, const Eigen::VectorXd& lower,
                                             const Eigen::VectorXd& upper,
                                             const MeasuredSetup& setup, const Options& options,
                                             const Progress& progress)
    : sample_(std::move(sample)),
      lower_(lower),
      upper_(upper),
      probeOf_(setup.probeOf),
      options_(options),
      progress_(progress),
      leja_(lejaPoints(kMostPoints)),
      counts_(lower.size(), 1) {
  sampleAt(Index(lower.size(), 0));
  for (int axis = 0; axis < coordinateCount(); ++axis) fillAxis(axis);
  if (coordinateCount() > 1) fillAll();
  progress_.report(1, "sample");
  sample_ = nullptr;  // which may refer to what does not outlive this call, as may the progress
  progress_ = Progress();
}

Eigen::VectorXd ResponseInterpolation::placeOf(const Index& index) const {
  Eigen::VectorXd place(index.size());
  for (std::size_t i = 0; i < index.size(); ++i)
    place[i] = lower_[i] + (upper_[i] - lower_[i]) * (1 + leja_[index[i]]) / 2;
  return place;
}

const MeasuredResponse& ResponseInterpolation::sampleAt(const Index& index) {
  const auto found = samples_.find(index);
  if (found != samples_.end()) return found->second;
  if (sampleCount() >= options_.mostSamples)
    refuse("to follow the response to ", shortly(options_.tolerance), " takes more than ",
           options_.mostSamples,
           " computations of Green's functions: narrow the ranges, or ask for fewer unknowns");
  // How many there will be is not known before: progress goes on by ever smaller steps.
  const double done = 1 - std::pow(0.9, sampleCount()), next = 1 - std::pow(0.9, sampleCount() + 1);
  progress_.report(done, "sample");
  return samples_.emplace(index, sample_(placeOf(index), progress_.part(done, next))).first->second;
}

/// Along one axis, the others at their middle, until two new samples are met to the tolerance: one
/// may be met by chance.
void ResponseInterpolation::fillAxis(int axis) {
  std::vector<int> others(counts_.size(), 1);
  counts_.swap(others);
  double error = 1, before = 1;
  while (std::max(error, before) > options_.tolerance && counts_[axis] < kMostPoints) {
    Index index(counts_.size(), 0);
    index[axis] = counts_[axis];
    const MeasuredResponse& exact = sampleAt(index);
    before = error;
    error = errorAgainst(placeOf(index), exact);
    ++counts_[axis];
  }
  others[axis] = counts_[axis];
  counts_.swap(others);
  error_ = std::max(error_, error);
}

/// All combinations, and a look at a place between them.
void ResponseInterpolation::fillAll() {
  Index index(counts_.size(), 0);
  for (bool more = true; more;) {
    sampleAt(index);
    more = false;
    for (std::size_t i = 0; i < index.size() && !more; ++i) {
      more = ++index[i] < counts_[i];
      if (!more) index[i] = 0;
    }
  }
  Eigen::VectorXd between(lower_.size());
  for (Eigen::Index i = 0; i < between.size(); ++i)
    between[i] = lower_[i] + (upper_[i] - lower_[i]) * (0.5 + 0.31 * (i % 2 ? -1 : 1));
  error_ = std::max(error_, errorAgainst(between, sample_(between, Progress())));
}

double ResponseInterpolation::difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) const {
  std::map<int, std::pair<double, double>> ofProbe;
  for (std::size_t i = 0; i < probeOf_.size(); ++i) {
    auto& [error, size] = ofProbe[probeOf_[i]];
    error = std::max(error, (a - b).middleRows<3>(3 * i).cwiseAbs().maxCoeff());
    size = std::max(size, b.middleRows<3>(3 * i).cwiseAbs().maxCoeff());
  }
  double most = 0;
  for (const auto& [probe, both] : ofProbe)
    if (both.second > 0) most = std::max(most, both.first / both.second);
  return most;
}

double ResponseInterpolation::errorAgainst(const Eigen::VectorXd& place,
                                           const MeasuredResponse& exact) const {
  double error = difference(at(place, 0, false).rows, exact.rows());
  if (const double length = options_.foundationLength; length > 0)
    error = std::max(
        error, difference(at(place, length, false).rows, exact.onFoundation(length, nullptr)));
  return error;
}

ResponseInterpolation::Value ResponseInterpolation::at(const Eigen::VectorXd& place, double length,
                                                       bool derivatives) const {
  const int axes = coordinateCount();
  std::vector<Lagrange> bases;
  for (int i = 0; i < axes; ++i)
    bases.emplace_back(leja_, counts_[i], 2 * (place[i] - lower_[i]) / (upper_[i] - lower_[i]) - 1);
  Value value;
  const Eigen::Index rows = 3 * probeOf_.size();
  value.rows.setZero(rows, 3);
  if (derivatives) {
    value.byCoordinate.assign(axes, Eigen::MatrixXd::Zero(rows, 3));
    value.byFoundation.setZero(rows, 3);
  }
  Eigen::MatrixXd slope, moved;
  for (const auto& [index, sample] : samples_) {
    bool isInside = true;
    double weight = 1;
    for (int i = 0; i < axes; ++i) {
      isInside = isInside && index[i] < counts_[i];
      if (isInside) weight *= bases[i].values[index[i]];
    }
    if (!isInside) continue;
    const Eigen::MatrixXd* here = &sample.rows();
    if (length > 0 || derivatives) {
      moved = sample.onFoundation(length, derivatives ? &slope : nullptr);
      here = &moved;
    }
    value.rows += weight * *here;
    if (!derivatives) continue;
    value.byFoundation += weight * slope;
    for (int axis = 0; axis < axes; ++axis) {
      double change = 2 / (upper_[axis] - lower_[axis]);
      for (int i = 0; i < axes; ++i)
        change *= i == axis ? bases[i].slopes[index[i]] : bases[i].values[index[i]];
      value.byCoordinate[axis] += change * *here;
    }
  }
  return value;
}

}  // namespace palpate
