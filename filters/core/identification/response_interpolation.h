// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "identification/measured_response.h"
#include "progress.h"

namespace palpate {

/// The first points of Leja's sequence in [-1, 1] from 0 on: each is where the product of the
/// distances from those before is largest. They lie as densely as Chebyshev's, and one more costs
/// one more sample.
std::vector<double> lejaPoints(int count);

/// What markers see of unit forces as a function of what the Green's functions do not simply scale
/// with: Poisson's ratio and ratios of Young's moduli. It is sampled by computing Green's functions
/// and interpolated between by polynomials at Leja points, in each coordinate as many as the
/// tolerance takes.
class ResponseInterpolation {
 public:
  /// The Green's functions at a place of the box.
  using Sample =
      std::function<MeasuredResponse(const Eigen::VectorXd& place, const Progress& progress)>;

  struct Options {
    /// Of displacements, over the largest under the same probe.
    double tolerance = 1e-4;
    int mostSamples = 200;
    /// A foundation's length that errors are looked at with besides 0; 0 for none.
    double foundationLength = 0;
  };

  /// @param lower, upper  #coordinates, none for a single sample.
  /// @throws std::invalid_argument if the tolerance takes more samples than that; what `sample`
  ///         throws.
  ResponseInterpolation(Sample sample, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                        const MeasuredSetup& setup, const Options& options,
                        const Progress& progress = {});

  int coordinateCount() const { return static_cast<int>(lower_.size()); }
  int sampleCount() const { return static_cast<int>(samples_.size()); }
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }

  /// What was found between the samples, over the largest displacement under the same probe.
  double error() const { return error_; }

  /// Value and derivatives, each 3 #markers by 3, m/N.
  struct Value {
    Eigen::MatrixXd rows;
    std::vector<Eigen::MatrixXd> byCoordinate;
    Eigen::MatrixXd byFoundation;
  };
  /// @param length  of the foundation (MeasuredResponse), 0 for a firm support.
  Value at(const Eigen::VectorXd& place, double length, bool derivatives) const;

 private:
  using Index = std::vector<int>;
  Eigen::VectorXd placeOf(const Index& index) const;
  const MeasuredResponse& sampleAt(const Index& index);
  void fillAxis(int axis);
  void fillAll();
  double errorAgainst(const Eigen::VectorXd& place, const MeasuredResponse& exact) const;
  double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) const;

  Sample sample_;
  Eigen::VectorXd lower_, upper_;
  std::vector<int> probeOf_;
  Options options_;
  Progress progress_;
  std::vector<double> leja_;
  std::vector<int> counts_;
  std::map<Index, MeasuredResponse> samples_;
  double error_ = 0;
};

}  // namespace palpate
