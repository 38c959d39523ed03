// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

namespace palpate {

/// Loads that may act, each a force within a cone about its axis: its normal component along the
/// axis is not negative, its tangential one at most `friction` times that.
struct ConeLoads {
  Eigen::MatrixXd response;  ///< #values by 3 #loads, of unit forces, over the values' deviations
  Eigen::Matrix3Xd axes;     ///< 3 by #loads, of length 1
  double friction = 0;

  int count() const { return static_cast<int>(axes.cols()); }
};

/// A share of a load's force along one ray of its cone.
struct ConeRay {
  int load;
  Eigen::Vector3d direction;  ///< its component along the axis is 1
  double size;                ///< positive: the normal component
};

/// The forces that explain values best.
struct ConeFit {
  std::vector<ConeRay> rays;  ///< at most three a load
  double squares = 0;         ///< of what is not explained
  bool isSettled = true;      ///< false where it was given up

  Eigen::Vector3d force(int load) const;
  /// Loads that bear, ascending.
  std::vector<int> loads() const;
  /// Numbers that were free to fit: of a load with one ray two (one without friction), of one with
  /// more three.
  int freedom(double friction) const;
};

/// Minimises |A f - d|^2 over forces f_k in their cones by the active set method of Lawson and
/// Hanson (Solving least squares problems, 1974, ch. 23) whose columns are rays of the cones: the
/// one that would lower the sum most joins, and those that would turn negative leave. Cones are
/// round, as rays are made when they are wanted.
/// @param data        #values, over their deviations.
/// @param tolerance   no further ray would lower the sum by more than about its square.
/// @throws std::invalid_argument if sizes differ.
ConeFit fitInCones(const ConeLoads& loads, const Eigen::VectorXd& data, double tolerance);

}  // namespace palpate
