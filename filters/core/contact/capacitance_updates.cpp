// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Additions to and removals from a CapacitanceMatrix, and the watch over their drift.

#include <algorithm>
#include <cmath>
#include <Eigen/LU>

#include "contact/capacitance_matrix.h"
#include "contact/inverse_updates.h"
#include "linear_algebra/lapack.h"

namespace palpate {
namespace {

using Strided = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

/// A fixed vector without structure, entries in [-1, 1].
double probe(int k) {
  const unsigned hash = (static_cast<unsigned>(k) + 1) * 2654435761u;
  return (hash >> 8) / 8388608.0 - 1;
}

}  // namespace

/// That they are new switches of one node with a column, and that there is room for them.
bool CapacitanceMatrix::canAdd(const ConstraintSwitch* switches, int count) const noexcept {
  if (count < 1 || count > 3 || size() + count > capacity_) return false;
  const int node = switches[0].node;
  if (node < 0 || node >= greens_->nodeCount() || !greens_->hasColumn(node)) return false;
  for (int k = 0; k < count; ++k)
    if (switches[k].node != node || !switches[k].isUnit() || !(switches[k].yield >= 0) ||
        !std::isfinite(switches[k].yield))
      return false;
  const auto present = std::count_if(switches_.begin(), switches_.end(),
                                     [&](const ConstraintSwitch& s) { return s.node == node; });
  return present + count <= 3;
}

/// Rows and columns of the scaled matrix between the present switches and new ones of one node.
void CapacitanceMatrix::gatherBorder(const ConstraintSwitch* switches, int count) noexcept {
  const int n = size(), node = switches[0].node;
  // Nodes without repetition where they stand together, as they do after whole-node additions.
  int distinct = 0;
  for (int k = 0; k < n; ++k)
    if (distinct == 0 || nodeScratch_[distinct - 1] != switches_[k].node)
      nodeScratch_[distinct++] = switches_[k].node;
  const Eigen::Map<const Eigen::VectorXi> nodes(nodeScratch_.data(), distinct);
  const Eigen::Map<const Eigen::VectorXi> self(&node, 1);
  greens_->gather(nodes, self, columnBlocks_.data());
  greens_->gather(self, nodes, rowBlocks_.data());
  const Eigen::Map<const Eigen::MatrixXd> columns(columnBlocks_.data(), 3 * distinct, 3);
  const Eigen::Map<const Eigen::MatrixXd> rows(rowBlocks_.data(), 3, 3 * distinct);
  for (int m = 0; m < count; ++m) {
    const Eigen::Vector3d& direction = switches[m].direction;
    double* column = columnBorder_.data() + m * std::size_t(stride_);
    double* row = rowBorder_.data() + m * std::size_t(stride_);
    for (int k = 0, block = 0; k < n; ++k) {
      if (k > 0 && switches_[k].node != switches_[k - 1].node) ++block;
      const Eigen::Vector3d& other = switches_[k].direction;
      column[k] = rowScale(switches_[k].node) * columnScale(node) *
                  other.dot(columns.block<3, 3>(3 * block, 0) * direction);
      row[k] = rowScale(node) * columnScale(switches_[k].node) *
               direction.dot(rows.block<3, 3>(0, 3 * block) * other);
    }
    for (int k = n; k < padded(n); ++k) column[k] = row[k] = 0;
  }
}

/// The scaled block of new switches of one node among themselves.
CapacitanceMatrix::Pivot CapacitanceMatrix::ownBlock(const ConstraintSwitch* switches,
                                                     int count) const noexcept {
  const int node = switches[0].node;
  Eigen::Matrix3d own;
  const Eigen::Map<const Eigen::VectorXi> self(&node, 1);
  greens_->gather(self, self, own.data());
  Pivot block(count, count);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      block(i, j) = rowScale(node) * columnScale(node) *
                    (switches[i].direction.dot(own * switches[j].direction) +
                     (i == j ? switches[i].yield : 0));
  return block;
}

/// The present node whose switches have the largest share in the new ones, given left_.
int CapacitanceMatrix::nearestNode(int count) const noexcept {
  int nearest = -1;
  double largest = 0;
  for (int k = 0; k < size(); ++k) {
    double weight = 0;
    for (int j = 0; j < count; ++j) {
      const double share = left_.data()[k + j * std::size_t(stride_)];
      weight += share * share;
    }
    if (weight > largest) {
      largest = weight;
      nearest = switches_[k].node;
    }
  }
  return nearest;
}

CapacitanceMatrix::Addition CapacitanceMatrix::add(const ConstraintSwitch* switches,
                                                   int count) noexcept {
  Addition result{false, 0, -1};
  if (!canAdd(switches, count)) return result;
  const int n = size();
  gatherBorder(switches, count);
  const Pivot diagonal = ownBlock(switches, count);

  // left = P^-1 column border, right = P^-T row border (transposed).
  multiplyBothSides(inverse_.data(), n, stride_, columnBorder_.data(), rowBorder_.data(), count,
                    left_.data(), right_.data());
  const Strided left(left_.data(), n, count, Eigen::OuterStride<>(stride_));
  const Strided rowBorder(rowBorder_.data(), n, count, Eigen::OuterStride<>(stride_));
  Pivot schur = diagonal;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) schur(i, j) -= rowBorder.col(i).dot(left.col(j));
  const Pivot schurInverse = schur.inverse();
  result.pivot = count / (schurInverse.norm() * diagonal.norm());
  result.nearestNode = nearestNode(count);
  if (!(result.pivot >= std::max(kSmallestPivot, greens_->epsilon()))) return result;
  tainted_ = tainted_ || result.pivot < kTaintedPivot;

  appendBorder(diagonal, schurInverse);
  for (int i = 0; i < count; ++i) switches_.push_back(switches[i]);
  result.done = true;
  watchDrift();
  return result;
}

/// inverse += left S^-1 right^T; the new columns are -left S^-1, the new rows -S^-1 right^T.
void CapacitanceMatrix::appendBorder(const Pivot& diagonal, const Pivot& schurInverse) noexcept {
  const int n = size(), count = static_cast<int>(diagonal.rows());
  for (int j = 0; j < count; ++j) {
    double* scaled = scratch_.data() + j * std::size_t(stride_);
    for (int k = 0; k < n; ++k) {
      scaled[k] = 0;
      for (int i = 0; i < count; ++i)
        scaled[k] += left_.data()[k + i * std::size_t(stride_)] * schurInverse(i, j);
    }
    for (int k = n; k < padded(n); ++k) scaled[k] = 0;
  }
  addOuterProduct(inverse_.data(), n, stride_, scratch_.data(), right_.data(), count);
  for (int j = 0; j < count; ++j) {
    double* inverseColumn = column(inverse_, n + j);
    double* complianceColumn = column(compliance_, n + j);
    for (int k = 0; k < n; ++k) {
      inverseColumn[k] = -scratch_.data()[k + j * std::size_t(stride_)];
      complianceColumn[k] = columnBorder_.data()[k + j * std::size_t(stride_)];
      double entry = 0;
      for (int i = 0; i < count; ++i)
        entry -= schurInverse(j, i) * right_.data()[k + i * std::size_t(stride_)];
      column(inverse_, k)[n + j] = entry;
      column(compliance_, k)[n + j] = rowBorder_.data()[k + j * std::size_t(stride_)];
    }
    for (int k = n + count; k < padded(n + count); ++k) inverseColumn[k] = complianceColumn[k] = 0;
    for (int i = 0; i < count; ++i) {
      inverseColumn[n + i] = schurInverse(i, j);
      complianceColumn[n + i] = diagonal(i, j);
    }
  }
}

void CapacitanceMatrix::swapSwitches(int a, int b) noexcept {
  if (a == b) return;
  std::swap(switches_[a], switches_[b]);
  for (AlignedBuffer<double>* matrix : {&inverse_, &compliance_}) {
    std::swap_ranges(column(*matrix, a), column(*matrix, a) + size(), column(*matrix, b));
    for (int k = 0; k < size(); ++k) std::swap(column(*matrix, k)[a], column(*matrix, k)[b]);
  }
}

/// Inverse of the block of the inverse that belongs to the last switches, and how it compares with
/// the matrix's largest diagonal entry: 0 where the rest is singular without them, not below about
/// 1 where they are independent of the rest.
CapacitanceMatrix::Pivot CapacitanceMatrix::invertCorner(int count, double& pivot) const noexcept {
  const int n = size() - count;
  Pivot corner(count, count);
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i) corner(i, j) = column(inverse_, n + j)[n + i];
  double largest = 0;
  for (int k = 0; k < size(); ++k) largest = std::max(largest, std::abs(column(compliance_, k)[k]));
  const Pivot cornerInverse = corner.inverse();
  pivot = largest / cornerInverse.norm();
  return cornerInverse;
}

/// inverse -= (its last columns) corner^-1 (its last rows), over what remains.
void CapacitanceMatrix::removeLast(const Pivot& cornerInverse) noexcept {
  const int count = static_cast<int>(cornerInverse.rows()), n = size() - count;
  for (int j = 0; j < count; ++j)
    for (int k = 0; k < padded(n); ++k) {
      double entry = 0;
      for (int i = 0; i < count && k < n; ++i)
        entry -= column(inverse_, n + i)[k] * cornerInverse(i, j);
      left_.data()[k + j * std::size_t(stride_)] = entry;
      right_.data()[k + j * std::size_t(stride_)] = k < n ? column(inverse_, k)[n + j] : 0;
    }
  for (int k = 0; k < n; ++k)  // the padding below what remains is zero again
    for (int i = 0; i < count; ++i) column(inverse_, k)[n + i] = column(compliance_, k)[n + i] = 0;
  addOuterProduct(inverse_.data(), n, stride_, left_.data(), right_.data(), count);
  switches_.resize(n, ConstraintSwitch{-1, Eigen::Vector3d::Zero()});
}

bool CapacitanceMatrix::removeNode(int node) noexcept {
  int count = 0;
  for (int k = size() - 1; k >= 0; --k)
    if (switches_[k].node == node) swapSwitches(k, size() - 1 - count++);
  if (count == 0) return false;
  double pivot;
  const Pivot cornerInverse = invertCorner(count, pivot);
  if (!(pivot >= kSmallestPivot) && count < size()) return false;
  tainted_ = tainted_ || !(pivot >= kTaintedPivot);
  removeLast(cornerInverse);
  watchDrift();
  return true;
}

double CapacitanceMatrix::residual() noexcept {
  const int n = size();
  if (n == 0) return 0;
  double* z = scratch_.data();
  double* inner = z + stride_;
  double* outer = inner + stride_;
  for (int k = 0; k < n; ++k) z[k] = probe(k);
  const Eigen::Map<const Eigen::VectorXd> zMap(z, n);
  Eigen::Map<Eigen::VectorXd> innerMap(inner, n), outerMap(outer, n);
  innerMap.noalias() = present(inverse_) * zMap;
  outerMap.noalias() = present(compliance_) * innerMap;
  return (outerMap - zMap).norm() / zMap.norm();
}

/// Looks at the drift now and then, and after each update where digits may have been lost; starts
/// afresh from the stored matrix when it shows.
void CapacitanceMatrix::watchDrift() noexcept {
  if (++updates_ % kCheckInterval != 0 && !tainted_) return;
  const double conditionNumber = condition();
  const bool isRegular = conditionNumber < 1 / kTaintedPivot;
  // Border after border loses some digits more than a factorisation with pivots does.
  const double natural = std::min(conditionNumber * 3e-15, 100 * kLargestResidual);
  const double limit =
      isRegular ? kLargestResidual : std::max({kLargestResidual, natural, 4 * freshResidual_});
  if (!(residual() <= limit))
    refactor();
  else
    tainted_ = !isRegular;
}

/// The inverse from the stored matrix. @return false, with the inverse as it was, if the matrix is
/// singular.
bool CapacitanceMatrix::refactor() noexcept {
  const int n = size();
  tainted_ = false;
  if (n == 0) return true;
  double* lu = factorScratch_.data();
  std::copy_n(compliance_.data(), std::size_t(stride_) * n, lu);
  if (lapack::getrf(n, n, lu, stride_, pivotScratch_.data()) != 0 ||
      lapack::getri(n, lu, stride_, pivotScratch_.data(), scratch_.data(), 3 * stride_) != 0) {
    tainted_ = true;
    return false;
  }
  std::copy_n(lu, std::size_t(stride_) * n, inverse_.data());
  for (int k = 0; k < n; ++k)
    for (int i = n; i < padded(n); ++i) column(inverse_, k)[i] = 0;
  freshResidual_ = residual();
  tainted_ = !(condition() < 1 / kTaintedPivot);
  ++refactorisations_;
  return true;
}

}  // namespace palpate
