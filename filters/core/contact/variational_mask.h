// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <memory>

#include "contact/pressure_mask.h"
#include "mesh/surface_point.h"

namespace palpate {

/// The penalty operator B of a variational mask, alpha the length it is made for.
enum class MaskPenalty {
  Gradient,    ///< B = alpha grad: no pull anywhere, a peak at the centre, a tail e^(-x / alpha)
  Biharmonic,  ///< B = alpha^2 div grad: smooth at the centre, pulls a little around the push
};

/// Masks that are the smooth pressure nearest to a point load, in the sense of [JP01] appendix A:
/// the columns of A^-1, A_ij = integral of phi_i phi_j + B phi_i . B phi_j (eq. 36), m^2. A is
/// sparse and factored once (Eigen's LDL^T); any column costs one solve.
///
/// What the penalty leaves alone, the constants, is also what carries the force: a^T A^-1 = 1^T, so
/// that every column transmits a unit force (eq. 31) as it is. It stays so at the support, where
/// pressures end without being drawn to zero: A is that of the free vertices, with the fixed
/// corners of a triangle at the mean of its free ones under B, and with mass that couples to fixed
/// vertices put on the diagonal.
class VariationalMasks : public VertexMasks {
 public:
  /// @param mesh, conditions  must outlive this.
  /// @param length  alpha, in the mesh's unit, > 0 and at most the mesh's diagonal. Waves of a
  ///                length of 2 pi alpha pass by half. Below half an edge the masks pull, too.
  /// @param tail    share of the force that `at` may leave out far away and give to the rest.
  /// @throws std::invalid_argument for another length or a tail outside [0, 0.5), or boundary types
  ///         of another number of vertices.
  VariationalMasks(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                   MaskPenalty penalty, double length, double tail = 0.01);
  ~VariationalMasks() override;

  /// The length for which a unit force sinks the centre of its mask on a half-space as much as
  /// under the paper's linear mask of a radius: pi r / 6, by the biharmonic pi r / (6 sqrt 2).
  static double lengthForRadius(MaskPenalty penalty, double radius);

  /// Without the tail.
  VertexMask at(int vertex) const override;

  /// A^-1's column of a free vertex, whole: #V, 1/m^2, zero where fixed.
  /// @throws std::invalid_argument as at.
  Eigen::VectorXd column(int vertex) const;

  /// The density of a load at a point of the surface (eq. 37), #V, 1/m^2: the barycentric average
  /// of the columns of its triangle (eq. 38). What falls on fixed vertices goes into the support.
  Eigen::VectorXd densityAt(const SurfacePoint& point) const;

  /// The smooth part of a field, s = A^-1 (a f) in all free vertices: what makes the integral of
  /// (f - s)^2 + (B s)^2 least. Constants are left as they are, and so is the integral; a wave of
  /// wave number k is passed by 1 / (1 + (alpha k)^2), by the biharmonic 1 / (1 + (alpha k)^4).
  /// @param values  #V, finite where free; others do not count.
  /// @return #V, zero where fixed.
  /// @throws std::invalid_argument for another number of values.
  Eigen::VectorXd smoothed(const Eigen::VectorXd& values) const;

 private:
  struct Factors;
  Eigen::VectorXd wholeSolution(const Eigen::VectorXd& loads) const;

  double tail_;
  std::unique_ptr<const Factors> free_;  ///< of the free vertices' A
  Eigen::VectorXd supportShares_;        ///< #V, of all vertices' A
};

}  // namespace palpate
