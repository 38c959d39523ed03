// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cmath>
#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "greens/greens_functions.h"
#include "linear_algebra/aligned_buffer.h"

namespace palpate {

/// A change of constraint at one node along one direction, with respect to the reference BVP: at a
/// free node the displacement component becomes prescribed (contact), at a fixed node the traction
/// component does (release). Three of them along the axes switch the whole node.
struct ConstraintSwitch {
  int node;
  Eigen::Vector3d direction;  ///< unit vector
  /// What the constraint itself gives way, 0 for nothing: at a free node, area over the stiffness
  /// of a spring whose far end has the prescribed displacement (m/Pa); at a released fixed node,
  /// stiffness over area of a spring to where it was fixed (Pa/m).
  double yield = 0;
  bool isUnit() const { return std::abs(direction.norm() - 1) < 1e-6; }
};

/// @throws std::invalid_argument for a node without column, a direction that is not a unit vector
///         or named twice at a node, more than three of them at a node, or a yield that is negative
///         or not finite.
void requireSwitches(const GreensFunctions& greens, const std::vector<ConstraintSwitch>& switches);

/// The three switches of a whole node.
std::vector<ConstraintSwitch> switchesOfNodes(const std::vector<int>& nodes);

/// The capacitance matrix C = -E^T Xi E of a set of switched constraints ([JP01] eq. 19; the
/// columns of E are node times direction), less the constraints' own yields on its diagonal, with
/// its explicit inverse. Adding or removing a node
/// costs O(s^2).
///
/// Inside, rows and columns are scaled to be non-dimensional and tractions are forces, so that the
/// condition number depends neither on units nor on vertex areas, and the matrix is symmetric where
/// the Green's functions are reciprocal. All memory is reserved by the constructor: add, removeNode
/// and solve neither allocate nor throw.
class CapacitanceMatrix {
 public:
  /// @param capacity  most switches that will ever be added.
  /// @throws std::invalid_argument if it is negative.
  CapacitanceMatrix(std::shared_ptr<const GreensFunctions> greens, int capacity);

  /// The matrix of a whole set at once (LAPACK).
  /// @throws as requireSwitches; std::runtime_error naming the condition number and the pair of
  ///         nodes that cause it if the matrix is singular to working precision.
  CapacitanceMatrix(std::shared_ptr<const GreensFunctions> greens,
                    const std::vector<ConstraintSwitch>& switches, int capacity = 0);

  CapacitanceMatrix(const CapacitanceMatrix& other);
  CapacitanceMatrix& operator=(const CapacitanceMatrix&) = delete;

  const GreensFunctions& greens() const { return *greens_; }
  int size() const { return static_cast<int>(switches_.size()); }
  int capacity() const { return capacity_; }
  const std::vector<ConstraintSwitch>& switches() const { return switches_; }
  bool contains(int node) const;

  /// What an addition did.
  struct Addition {
    bool done;        ///< false where the switches or the pivot forbid it; nothing changes then
    double pivot;     ///< smallest pivot relative to the diagonal: 1 independent, 0 dependent
    int nearestNode;  ///< the present node that the new one depends on most, -1 if there is none
  };

  /// Adds up to three switches of one node. Refused below the pivot kSmallestPivot, beyond the
  /// capacity, and for what the constructor would refuse (pivot 0 and node -1 then).
  Addition add(const ConstraintSwitch* switches, int count) noexcept;

  /// Removes all switches of a node. @return false, with nothing changed but the order of the
  /// switches, if it has none or if what remains would be singular.
  bool removeNode(int node) noexcept;

  /// The values that the switches make unknown: lambda = (E^T Xi E)^-1 right, where `right` is what
  /// is prescribed less what the rest of the given values causes there (eq. 18-21).
  /// @param right   size() values: metres at free, pascals at fixed nodes.
  /// @param values  size() values: pascals at free, metres at fixed nodes.
  void solve(const double* right, double* values) const noexcept;

  /// C in the units of Xi, size() by size().
  Eigen::MatrixXd matrix() const;
  /// C^-1 in units of 1/Xi.
  Eigen::MatrixXd inverse() const;

  /// 1-norm condition number of the scaled matrix, from the explicit inverse.
  double condition() const;

  /// |C C^-1 z - z| / |z| for a fixed pseudo-random z: the drift of the updates. Uses the object's
  /// own memory, so it is not for several threads.
  double residual() noexcept;

  /// The two nodes, in ascending order, with the largest shares in the combination of switches that
  /// is nearest to zero (rank-revealing QR); twice the same if one node has it all. (-1, -1) below
  /// two switches.
  std::pair<int, int> weakestPair() const;

  /// Refactorisations that the watch over drift has caused so far.
  int refactorisations() const { return refactorisations_; }

  static constexpr double kLargestCondition = 1e13;  ///< or 1/(2 epsilon): beyond, a set is refused
  static constexpr double kSmallestPivot = 1e-12;
  static constexpr double kTaintedPivot = 1e-6;  ///< below it, each update looks at the residual
  static constexpr int kCheckInterval = 32;      ///< else updates between such looks
  /// Of updates, beyond which they start afresh; up to 100 times that where C is ill-conditioned.
  static constexpr double kLargestResidual = 1e-10;

  /// A block of up to three rows, without heap memory.
  using Pivot = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

 private:
  void reserve(int capacity);
  void gatherAll();
  double rowScale(int node) const { return greens_->isFixed(node) ? 1 / modulus_ : 1 / length_; }
  double columnScale(int node) const {
    return greens_->isFixed(node) ? length_
                                  : modulus_ * length_ * length_ / greens_->vertexArea(node);
  }
  /// The part of a matrix that the present switches fill.
  Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>> present(
      const AlignedBuffer<double>& matrix) const {
    return {matrix.data(), size(), size(), Eigen::OuterStride<>(stride_)};
  }
  double* column(const AlignedBuffer<double>& matrix, int k) const {
    return matrix.data() + std::size_t(k) * stride_;
  }
  bool canAdd(const ConstraintSwitch* switches, int count) const noexcept;
  void gatherBorder(const ConstraintSwitch* switches, int count) noexcept;
  Pivot ownBlock(const ConstraintSwitch* switches, int count) const noexcept;
  int nearestNode(int count) const noexcept;
  void appendBorder(const Pivot& diagonal, const Pivot& schurInverse) noexcept;
  void swapSwitches(int a, int b) noexcept;
  Pivot invertCorner(int count, double& pivot) const noexcept;
  void removeLast(const Pivot& cornerInverse) noexcept;
  bool refactor() noexcept;
  void watchDrift() noexcept;

  std::shared_ptr<const GreensFunctions> greens_;
  double length_ = 1, modulus_ = 1;
  int capacity_ = 0, stride_ = 0;
  std::vector<ConstraintSwitch> switches_;
  AlignedBuffer<double> compliance_, inverse_;  ///< scaled E^T Xi E and its inverse
  AlignedBuffer<double> rowBorder_, columnBorder_, left_, right_;  ///< stride by 3 each
  AlignedBuffer<double> rowBlocks_, columnBlocks_;
  AlignedBuffer<double> scratch_;
  std::vector<int> nodeScratch_, pivotScratch_;
  AlignedBuffer<double> factorScratch_;
  bool tainted_ = false;      ///< updates may have lost digits
  double freshResidual_ = 0;  ///< after the last refactorisation
  int updates_ = 0, refactorisations_ = 0;
};

}  // namespace palpate
