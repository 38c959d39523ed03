// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/capacitance_matrix.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "contact/inverse_updates.h"
#include "greens/weighted_columns.h"
#include "linear_algebra/lapack.h"

namespace palpate {
namespace {

using Strided = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
using ConstStrided = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
/// A pivot block of up to three rows, without heap memory.
using Pivot = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

int padded(int size) {
  return (size + kInversePadding - 1) / kInversePadding * kInversePadding;
}

/// A fixed vector without structure, entries in [-1, 1].
double probe(int k) {
  const unsigned hash = (static_cast<unsigned>(k) + 1) * 2654435761u;
  return (hash >> 8) / 8388608.0 - 1;
}

}  // namespace

std::vector<ConstraintSwitch> switchesOfNodes(const std::vector<int>& nodes) {
  std::vector<ConstraintSwitch> switches;
  for (int node : nodes)
    for (int c = 0; c < 3; ++c) switches.push_back({node, Eigen::Vector3d::Unit(c)});
  return switches;
}

CapacitanceMatrix::CapacitanceMatrix(std::shared_ptr<const GreensFunctions> greens, int capacity)
    : greens_(std::move(greens)),
      length_(std::sqrt(greens_->info().vertexAreas.sum())),
      modulus_(greens_->info().material.youngsModulus()) {
  reserve(capacity);
}

void CapacitanceMatrix::reserve(int capacity) {
  capacity_ = capacity;
  stride_ = padded(std::max(capacity, 1));
  const std::size_t square = std::size_t(stride_) * stride_, border = 3 * std::size_t(stride_);
  for (AlignedBuffer<double>* matrix : {&compliance_, &inverse_, &factorScratch_}) {
    *matrix = AlignedBuffer<double>(square);
    std::memset(matrix->data(), 0, matrix->bytes());
  }
  for (AlignedBuffer<double>* matrix : {&rowBorder_, &columnBorder_, &left_, &right_, &scratch_}) {
    *matrix = AlignedBuffer<double>(border);
    std::memset(matrix->data(), 0, matrix->bytes());
  }
  rowBlocks_ = AlignedBuffer<double>(9 * std::size_t(stride_));
  columnBlocks_ = AlignedBuffer<double>(9 * std::size_t(stride_));
  switches_.reserve(capacity_);
  nodeScratch_.resize(stride_);
  pivotScratch_.resize(stride_);
}

CapacitanceMatrix::CapacitanceMatrix(const CapacitanceMatrix& other)
    : CapacitanceMatrix(other.greens_, other.capacity_) {
  switches_ = other.switches_;
  switches_.reserve(capacity_);
  const std::size_t used = std::size_t(stride_) * switches_.size();
  std::copy_n(other.compliance_.data(), used, compliance_.data());
  std::copy_n(other.inverse_.data(), used, inverse_.data());
  tainted_ = other.tainted_;
  updates_ = other.updates_;
}

CapacitanceMatrix::CapacitanceMatrix(std::shared_ptr<const GreensFunctions> greens,
                                     const std::vector<ConstraintSwitch>& switches, int capacity)
    : CapacitanceMatrix(std::move(greens), std::max(capacity, static_cast<int>(switches.size()))) {
  std::vector<int> nodes;
  for (const ConstraintSwitch& s : switches) {
    nodes.push_back(s.node);
    if (!(std::abs(s.direction.norm() - 1) < 1e-6))
      throw std::invalid_argument("the direction of a constraint at node " +
                                  std::to_string(s.node) + " is not a unit vector");
  }
  greens_->requireColumns(nodeList(nodes));
  switches_ = switches;
  switches_.reserve(capacity_);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  Eigen::MatrixXd blocks(3 * nodes.size(), 3 * nodes.size());
  greens_->gather(nodeList(nodes), nodeList(nodes), blocks.data());
  const auto place = [&](int node) {
    return 3 * (std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
  };
  for (int l = 0; l < size(); ++l)
    for (int k = 0; k < size(); ++k)
      column(compliance_, l)[k] =
          rowScale(switches_[k].node) * columnScale(switches_[l].node) *
          switches_[k].direction.dot(
              blocks.block<3, 3>(place(switches_[k].node), place(switches_[l].node)) *
              switches_[l].direction);
  const bool regular = refactor();
  const double conditionNumber = regular ? condition() : 1 / std::numeric_limits<double>::min();
  if (!(conditionNumber < kLargestCondition)) {
    const auto [a, b] = weakestPair();
    std::ostringstream text;
    text << "the constraints cannot be told apart (condition number " << conditionNumber
         << " of the capacitance matrix): nodes " << a << " and " << b
         << " depend on each other most";
    throw std::runtime_error(text.str());
  }
  refactorisations_ = 0;
}

double CapacitanceMatrix::rowScale(int node) const {
  return greens_->isFixed(node) ? 1 / modulus_ : 1 / length_;
}

double CapacitanceMatrix::columnScale(int node) const {
  return greens_->isFixed(node) ? length_
                                : modulus_ * length_ * length_ / greens_->vertexArea(node);
}

bool CapacitanceMatrix::contains(int node) const {
  return std::any_of(switches_.begin(), switches_.end(),
                     [&](const ConstraintSwitch& s) { return s.node == node; });
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

CapacitanceMatrix::Addition CapacitanceMatrix::add(const ConstraintSwitch* switches,
                                                   int count) noexcept {
  const int n = size(), node = switches[0].node;
  Addition result{false, 0, -1};
  if (count < 1 || count > 3 || n + count > capacity_ || !greens_->hasColumn(node)) return result;

  gatherBorder(switches, count);
  Eigen::Matrix3d own;
  const Eigen::Map<const Eigen::VectorXi> self(&node, 1);
  greens_->gather(self, self, own.data());
  Pivot diagonal(count, count);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      diagonal(i, j) = rowScale(node) * columnScale(node) *
                       switches[i].direction.dot(own * switches[j].direction);

  // left = P^-1 column border, right = P^-T row border (transposed).
  multiplyBothSides(inverse_.data(), n, stride_, columnBorder_.data(), rowBorder_.data(), count,
                    left_.data(), right_.data());
  const Strided left(left_.data(), n, count, Eigen::OuterStride<>(stride_));
  const Strided right(right_.data(), n, count, Eigen::OuterStride<>(stride_));
  const Strided columnBorder(columnBorder_.data(), n, count, Eigen::OuterStride<>(stride_));
  const Strided rowBorder(rowBorder_.data(), n, count, Eigen::OuterStride<>(stride_));
  Pivot schur = diagonal;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) schur(i, j) -= rowBorder.col(i).dot(left.col(j));

  const double smallest = Eigen::JacobiSVD<Pivot>(schur).singularValues()[count - 1];
  result.pivot = smallest / diagonal.norm();
  double largest = 0;
  for (int k = 0; k < n; ++k) {
    double weight = 0;
    for (int j = 0; j < count; ++j) weight += left(k, j) * left(k, j);
    if (weight > largest) {
      largest = weight;
      result.nearestNode = switches_[k].node;
    }
  }
  if (!(result.pivot >= kSmallestPivot)) return result;
  tainted_ = tainted_ || result.pivot < kTaintedPivot;

  const Pivot schurInverse = schur.inverse();
  // inverse += left S^-1 right^T; the new columns are -left S^-1, the new rows -S^-1 right^T.
  for (int k = 0; k < n; ++k) {
    double row[3] = {0, 0, 0};
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j)
        row[j] += left_.data()[k + i * std::size_t(stride_)] * schurInverse(i, j);
    for (int j = 0; j < count; ++j) scratch_.data()[k + j * std::size_t(stride_)] = row[j];
  }
  for (int j = 0; j < count; ++j)
    for (int k = n; k < padded(n); ++k) scratch_.data()[k + j * std::size_t(stride_)] = 0;
  addOuterProduct(inverse_.data(), n, stride_, scratch_.data(), right_.data(), count);
  for (int j = 0; j < count; ++j) {
    double* inverseColumn = column(inverse_, n + j);
    double* complianceColumn = column(compliance_, n + j);
    for (int k = 0; k < n; ++k) {
      inverseColumn[k] = -scratch_.data()[k + j * std::size_t(stride_)];
      complianceColumn[k] = columnBorder(k, j);
      double entry = 0;
      for (int i = 0; i < count; ++i) entry -= schurInverse(j, i) * right(k, i);
      column(inverse_, k)[n + j] = entry;
      column(compliance_, k)[n + j] = rowBorder(k, j);
    }
    for (int k = n + count; k < padded(n + count); ++k) inverseColumn[k] = complianceColumn[k] = 0;
    for (int i = 0; i < count; ++i) {
      inverseColumn[n + i] = schurInverse(i, j);
      complianceColumn[n + i] = diagonal(i, j);
    }
  }
  for (int i = 0; i < count; ++i) switches_.push_back(switches[i]);
  result.done = true;
  watchDrift();
  return result;
}

void CapacitanceMatrix::swapSwitches(int a, int b) noexcept {
  if (a == b) return;
  std::swap(switches_[a], switches_[b]);
  for (AlignedBuffer<double>* matrix : {&inverse_, &compliance_}) {
    std::swap_ranges(column(*matrix, a), column(*matrix, a) + size(), column(*matrix, b));
    for (int k = 0; k < size(); ++k) std::swap(column(*matrix, k)[a], column(*matrix, k)[b]);
  }
}

void CapacitanceMatrix::removeLast(int count) noexcept {
  const int n = size() - count;
  Pivot corner(count, count);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) corner(i, j) = column(inverse_, n + j)[n + i];
  const Pivot cornerInverse = corner.inverse();
  // inverse -= (columns) corner^-1 (rows), over what remains.
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
  for (int rest = count; rest > 0; rest -= 3) removeLast(std::min(rest, 3));
  if (tainted_)
    refactor();
  else
    watchDrift();
  return true;
}

/// Looks at the drift now and then and starts afresh from the stored matrix when it shows.
void CapacitanceMatrix::watchDrift() noexcept {
  if (++updates_ % kCheckInterval == 0 && residual() > kLargestResidual) refactor();
}

bool CapacitanceMatrix::refactor() noexcept {
  const int n = size();
  if (n == 0) {
    tainted_ = false;
    return true;
  }
  std::copy_n(compliance_.data(), std::size_t(stride_) * n, inverse_.data());
  if (lapack::getrf(n, n, inverse_.data(), stride_, pivotScratch_.data()) != 0 ||
      lapack::getri(n, inverse_.data(), stride_, pivotScratch_.data(), factorScratch_.data(),
                    stride_ * stride_) != 0)
    return false;
  for (int k = 0; k < n; ++k)
    for (int i = n; i < padded(n); ++i) column(inverse_, k)[i] = 0;
  tainted_ = false;
  ++refactorisations_;
  return true;
}

void CapacitanceMatrix::solve(const double* right, double* values) const noexcept {
  const int n = size();
  std::fill_n(values, n, 0.0);
  const double* columns[kColumnGroup];
  double weights[kColumnGroup];
  for (int k = 0; k < n;) {
    int count = 0;
    for (; count < kColumnGroup && k < n; ++count, ++k) {
      columns[count] = column(inverse_, k);
      weights[count] = rowScale(switches_[k].node) * right[k];
    }
    addWeightedColumns(columns, weights, count, n, values);
  }
  for (int k = 0; k < n; ++k) values[k] *= columnScale(switches_[k].node);
}

Eigen::MatrixXd CapacitanceMatrix::matrix() const {
  Eigen::MatrixXd c(size(), size());
  for (int l = 0; l < size(); ++l)
    for (int k = 0; k < size(); ++k)
      c(k, l) = -column(compliance_, l)[k] /
                (rowScale(switches_[k].node) * columnScale(switches_[l].node));
  return c;
}

Eigen::MatrixXd CapacitanceMatrix::inverse() const {
  Eigen::MatrixXd c(size(), size());
  for (int l = 0; l < size(); ++l)
    for (int k = 0; k < size(); ++k)
      c(k, l) =
          -column(inverse_, l)[k] * columnScale(switches_[k].node) * rowScale(switches_[l].node);
  return c;
}

double CapacitanceMatrix::condition() const {
  if (size() == 0) return 1;
  const auto norm = [&](const AlignedBuffer<double>& matrix) {
    return ConstStrided(matrix.data(), size(), size(), Eigen::OuterStride<>(stride_))
        .cwiseAbs()
        .colwise()
        .sum()
        .maxCoeff();
  };
  return norm(compliance_) * norm(inverse_);
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
  innerMap.noalias() = ConstStrided(inverse_.data(), n, n, Eigen::OuterStride<>(stride_)) * zMap;
  outerMap.noalias() =
      ConstStrided(compliance_.data(), n, n, Eigen::OuterStride<>(stride_)) * innerMap;
  return (outerMap - zMap).norm() / zMap.norm();
}

std::pair<int, int> CapacitanceMatrix::weakestPair() const {
  const int n = size();
  if (n < 2) return {-1, -1};
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(
      ConstStrided(compliance_.data(), n, n, Eigen::OuterStride<>(stride_)));
  // The last column in pivot order as a combination of the others: the largest share names the
  // twin.
  const Eigen::MatrixXd r = qr.matrixR().topLeftCorner(n - 1, n);
  const Eigen::VectorXd shares =
      r.leftCols(n - 1).triangularView<Eigen::Upper>().solve(r.col(n - 1));
  const auto& order = qr.colsPermutation().indices();
  Eigen::Index twin;
  shares.cwiseAbs().maxCoeff(&twin);
  return {switches_[order[n - 1]].node, switches_[order[twin]].node};
}

}  // namespace palpate
