// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

namespace palpate {

/// The fields at a point of a body.
struct ProbedField {
  Eigen::Vector3d displacement;  ///< m
  Eigen::Matrix3d gradient;      ///< du_i / dx_k
  Eigen::Matrix3d stress;        ///< Pa

  Eigen::Matrix3d strain() const { return (gradient + gradient.transpose()) / 2; }
};

/// Displacement, displacement gradient (row by row) and mean stress, from which all of a field of
/// an isotropic material follows.
using ProbeValues = Eigen::Matrix<double, 13, 1>;
ProbedField fieldOf(const ProbeValues& values, double shearModulus);

/// Points inside a body as rows of its Green's functions ([JP01] section 3.5): what tractions at
/// nodes do there, the reactions of the support included, at the cost of 39 products a point and
/// node. Queries are const and allocate nothing.
class ProbeRows {
 public:
  /// @param rows          13 #points by 3 #nodes: ProbeValues per pascal; zero for nodes that bear
  ///                      none.
  /// @param shearModulus  Pa.
  ProbeRows(Eigen::MatrixXd rows, double shearModulus);

  int count() const { return static_cast<int>(rows_.rows() / 13); }
  int nodeCount() const { return static_cast<int>(rows_.cols() / 3); }
  double shearModulus() const { return shearModulus_; }

  /// values += what a traction at a node does at a point.
  /// @param traction  Pa.
  void accumulate(int point, int node, const Eigen::Vector3d& traction,
                  ProbeValues& values) const noexcept {
    values.noalias() += rows_.block<13, 3>(13 * point, 3 * node) * traction;
  }

 private:
  Eigen::MatrixXd rows_;
  double shearModulus_;
};

}  // namespace palpate
