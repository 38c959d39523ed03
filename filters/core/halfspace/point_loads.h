// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

#include "halfspace/hat_edges.h"

namespace palpate {

/// Places in the unit disc, on as many circles as polynomials of some degree are determined by (L.
/// Bos, "Multivariate interpolation and polynomial inequalities", 1981), for loads that have the
/// same moments up to that degree as a hat function.
class PointLoads {
 public:
  /// @param radii  of degree / 2 + 1 circles, descending; on the first there are 2 degree + 1
  /// places,
  ///               on each next one four less.
  PointLoads(int degree, const std::vector<double>& radii);

  /// As many as there are, filled up to whole groups (kHatGroup).
  int size() const { return 8 * groupCount(); }
  int groupCount() const { return static_cast<int>(places_.size() / 16); }
  /// As addPointLoads takes them.
  const double* places() const { return places_.data(); }

  /// The loads for a hat, zero where the places are filled up.
  /// @param sectors  counter-clockwise triangles, within the unit disc.
  Eigen::VectorXd loadsOf(const std::vector<HatSector>& sectors) const;

 private:
  int degree_;
  std::vector<double> places_;
  Eigen::PartialPivLU<Eigen::MatrixXd> momentsOfLoads_;
};

}  // namespace palpate
