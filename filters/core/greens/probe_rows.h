// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/elasticity.h"

namespace palpate {

/// The fields at a point of a body.
struct ProbedField {
  Eigen::Vector3d displacement;  ///< m
  Eigen::Matrix3d gradient;      ///< du_i / dx_k
  Eigen::Matrix3d stress;        ///< Pa

  Eigen::Matrix3d strain() const { return (gradient + gradient.transpose()) / 2; }
};

/// Displacement, displacement gradient (row by row), and what of the mean stress the strain does
/// not tell (see Elasticity::isSplit): all of a field.
using ProbeValues = Eigen::Matrix<double, 13, 1>;
/// @param stiffness  Pa, Voigt.
ProbedField fieldOf(const ProbeValues& values, const Matrix6d& stiffness);

/// Points inside a body as rows of its Green's functions ([JP01] section 3.5): what tractions at
/// nodes do there, the reactions of the support included, at the cost of 39 products a point and
/// node. Queries are const and allocate nothing.
class ProbeRows {
 public:
  /// @param points     3 by #points, m.
  /// @param rows       13 #points by 3 #nodes: ProbeValues per pascal at free nodes, per metre at
  ///                   fixed ones; zero where no column was computed.
  /// @param stiffness  of each point's material, Pa, Voigt.
  /// @throws std::invalid_argument if sizes differ.
  ProbeRows(Eigen::Matrix3Xd points, Eigen::MatrixXd rows, std::vector<Matrix6d> stiffness);

  int count() const { return static_cast<int>(points_.cols()); }
  int nodeCount() const { return static_cast<int>(rows_.cols() / 3); }
  const Eigen::Matrix3Xd& points() const { return points_; }
  const Eigen::MatrixXd& rows() const { return rows_; }
  const Matrix6d& stiffness(int point) const { return stiffness_[point]; }

  /// values += what is given at a node does at a point.
  /// @param traction  Pa, at a fixed node its displacement, m.
  void accumulate(int point, int node, const Eigen::Vector3d& traction,
                  ProbeValues& values) const noexcept {
    values.noalias() += rows_.block<13, 3>(13 * point, 3 * node) * traction;
  }

  /// The body with all its stiffness so many times as large, of free nodes.
  ProbeRows stiffer(double factor) const;

  /// Those at these places.
  /// @param tolerance  m, up to which a place is a point's.
  /// @throws std::invalid_argument naming the first place where there is none.
  ProbeRows at(const Eigen::Matrix3Xd& places, double tolerance) const;

 private:
  Eigen::Matrix3Xd points_;
  Eigen::MatrixXd rows_;
  std::vector<Matrix6d> stiffness_;
};

}  // namespace palpate
