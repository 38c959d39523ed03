// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <limits>

#include "greens/greens_functions.h"
#include "linear_algebra/aligned_buffer.h"

namespace palpate {

/// Green's functions as one dense column-major matrix of doubles or floats, 3 #nodes by 3 #columns.
/// Sums are formed in double either way.
template <class Scalar>
class DenseGreensFunctions final : public GreensFunctions {
 public:
  /// Takes over the matrices.
  /// @throws std::invalid_argument if they are smaller than `info` says.
  DenseGreensFunctions(GreensFunctionsInfo info, AlignedBuffer<Scalar> matrix,
                       AlignedBuffer<Scalar> patchMatrix = {});

  /// Views matrices that someone else keeps.
  /// @param matrix       3 #nodes by 3 #columns.
  /// @param patchMatrix  3 #nodes by 3 #patchColumns, null if there are none.
  /// @param keeper       held as long as this object lives.
  DenseGreensFunctions(GreensFunctionsInfo info, const Scalar* matrix, const Scalar* patchMatrix,
                       std::shared_ptr<const void> keeper);

  void gather(NodeList rows, NodeList columns, double* out) const override;
  void accumulate(NodeList columns, Values weights, Eigen::Ref<Eigen::VectorXd> out) const override;
  void accumulate(NodeList columns, Values weights, NodeList rows,
                  Eigen::Ref<Eigen::VectorXd> out) const override;
  void accumulatePatches(NodeList patchColumns, Values weights,
                         Eigen::Ref<Eigen::VectorXd> out) const override;
  double epsilon() const override { return std::numeric_limits<Scalar>::epsilon(); }
  std::shared_ptr<const GreensFunctions> withYoungsModulus(double youngsModulus) const override;

  /// The matrix as stored, for the Young's modulus it was made with.
  Eigen::Map<const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>> matrix() const {
    return {matrix_, 3 * nodeCount(), 3 * columnCount()};
  }

 private:
  const Scalar* column(int node, int component) const {
    return matrix_ + (3 * std::size_t(columnOfNode(node)) + component) * 3 * nodeCount();
  }
  /// What a stored block is multiplied with: 1/s between free, s between fixed nodes, else 1.
  double blockScale(int row, int column) const {
    return (isFixed(row) ? stiffnessScale_ : 1) * (isFixed(column) ? 1 : 1 / stiffnessScale_);
  }

  /// out += columns * weights by the streaming kernel; `columnAt(i, j)` and `weightAt(i, j)` give
  /// component j of block i.
  template <class ColumnAt, class WeightAt>
  void stream(Eigen::Index blocks, const ColumnAt& columnAt, const WeightAt& weightAt,
              Eigen::Ref<Eigen::VectorXd> out) const;

  const Scalar *matrix_, *patchMatrix_;
  std::shared_ptr<const void> keeper_;
  double stiffnessScale_ = 1;
};

extern template class DenseGreensFunctions<double>;
extern template class DenseGreensFunctions<float>;

}  // namespace palpate
