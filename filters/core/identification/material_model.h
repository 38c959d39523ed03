// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/material_identification.h"
#include "identification/profile_interval.h"

namespace palpate {

/// Displacements at the markers as a function of the unknowns, in the order ln E, Poisson's ratio,
/// ln E_r / E of the other regions, E / k over the body's size.
class MaterialModel {
 public:
  MaterialModel(const MaterialUnknowns& unknowns, double size, ResponseInterpolation response,
                std::vector<int> probeOf);

  int count() const { return static_cast<int>(lower_.size()); }
  int poisson() const { return unknowns_.poisson ? 1 : -1; }  ///< its place, -1 if it is known
  int support() const { return unknowns_.support ? count() - 1 : -1; }
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }
  const Eigen::VectorXd& middle() const { return middle_; }
  const std::vector<int>& probeOf() const { return probeOf_; }
  const ResponseInterpolation& response() const { return response_; }
  int regionOf(int unknown) const;  ///< whose modulus it is of, -1 for none
  double size() const { return size_; }

  /// @param forces    3 by #probes, N.
  /// @param jacobian  3 #markers by count(), set if not null.
  /// @return 3 #markers, m.
  Eigen::VectorXd displacements(const Eigen::VectorXd& unknowns, const Eigen::Matrix3Xd& forces,
                                Eigen::MatrixXd* jacobian) const;

  /// @return #regions.
  std::vector<Material> materials(const Eigen::VectorXd& unknowns) const;
  double foundationLength(const Eigen::VectorXd& unknowns) const;

  /// Unknowns as people read them, with their standard deviations, of moduli and of lengths, and
  /// with the intervals that these make. The deviation of what is at a bound is as if that were not
  /// there.
  std::vector<IdentifiedParameter> parameters(const Eigen::VectorXd& unknowns,
                                              const Eigen::MatrixXd& covariance) const;
  /// What of the unknowns a parameter is a function of: ln E of its region, or an unknown.
  Eigen::VectorXd combinationOf(int parameter) const;
  /// @param interval  of that.
  void setInterval(int parameter, const Interval& interval, IdentifiedParameter& of) const;
  /// The unknowns of parameters.
  Eigen::VectorXd unknownsOf(const Eigen::VectorXd& parameters) const;

 private:
  double shown(int parameter, double combination) const;

  MaterialUnknowns unknowns_;
  double size_;
  ResponseInterpolation response_;
  std::vector<int> probeOf_;
  Eigen::VectorXd lower_, upper_, middle_;
};

/// The materials that stand for a place between the samples, of Young's modulus 1 in the first.
std::vector<Material> materialsAt(const MaterialUnknowns& unknowns, const Eigen::VectorXd& place);

/// The box of such places. @throws std::invalid_argument for ranges that hold nothing.
void boxOf(const MaterialUnknowns& unknowns, Eigen::VectorXd& lower, Eigen::VectorXd& upper);

}  // namespace palpate
