// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/capacitance_matrix.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <Eigen/QR>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

#include "contact/inverse_updates.h"
#include "greens/weighted_columns.h"

namespace palpate {
void requireSwitches(const GreensFunctions& greens, const std::vector<ConstraintSwitch>& switches) {
  std::vector<int> nodes;
  for (const ConstraintSwitch& s : switches) nodes.push_back(s.node);
  greens.requireColumns(nodeList(nodes));
  std::vector<std::vector<Eigen::Vector3d>> directions(greens.nodeCount());
  for (const ConstraintSwitch& s : switches) {
    std::vector<Eigen::Vector3d>& ofNode = directions[s.node];
    std::ostringstream text;
    if (!s.isUnit())
      text << "the direction (" << s.direction.x() << ", " << s.direction.y() << ", "
           << s.direction.z() << ") of a constraint at node " << s.node << " is not a unit vector";
    else if (std::count(ofNode.begin(), ofNode.end(), s.direction) > 0)
      text << "node " << s.node << " is constrained twice along the same direction";
    else if (ofNode.size() == 3)
      text << "node " << s.node << " has more than three constraints";
    if (!(s.yield >= 0 && std::isfinite(s.yield)))
      text << "the spring of the constraint at node " << s.node << " must yield by a number from 0 "
           << "on, not by " << s.yield;
    if (!text.str().empty()) throw std::invalid_argument(text.str());
    ofNode.push_back(s.direction);
  }
}

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
  if (capacity < 0)
    throw std::invalid_argument("the capacity of a capacitance matrix must be at least 0, not " +
                                std::to_string(capacity));
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
  freshResidual_ = other.freshResidual_;
  updates_ = other.updates_;
}

CapacitanceMatrix::CapacitanceMatrix(std::shared_ptr<const GreensFunctions> greens,
                                     const std::vector<ConstraintSwitch>& switches, int capacity)
    : CapacitanceMatrix(std::move(greens), std::max(capacity, static_cast<int>(switches.size()))) {
  requireSwitches(*greens_, switches);
  switches_ = switches;
  switches_.reserve(capacity_);
  gatherAll();
  const bool regular = refactor();
  const double conditionNumber = regular ? condition() : std::numeric_limits<double>::infinity();
  // The noise of what is stored must not pass for a solution.
  if (!(conditionNumber < std::min(kLargestCondition, 0.5 / greens_->epsilon()))) {
    const auto [a, b] = weakestPair();
    std::ostringstream text;
    text << "the constraints cannot be told apart (condition number " << conditionNumber
         << " of the capacitance matrix): ";
    if (a == b)
      text << "those of node " << a << " depend on each other";
    else
      text << "nodes " << a << " and " << b << " depend on each other most";
    throw std::runtime_error(text.str());
  }
  refactorisations_ = 0;
}

/// The scaled matrix of all present switches.
void CapacitanceMatrix::gatherAll() {
  std::vector<int> nodes;
  for (const ConstraintSwitch& s : switches_) nodes.push_back(s.node);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  Eigen::MatrixXd blocks(3 * nodes.size(), 3 * nodes.size());
  greens_->gather(nodeList(nodes), nodeList(nodes), blocks.data());
  std::vector<Eigen::Index> place;
  for (const ConstraintSwitch& s : switches_)
    place.push_back(3 * (std::lower_bound(nodes.begin(), nodes.end(), s.node) - nodes.begin()));
  for (int l = 0; l < size(); ++l)
    for (int k = 0; k < size(); ++k)
      column(compliance_, l)[k] =
          rowScale(switches_[k].node) * columnScale(switches_[l].node) *
          (switches_[k].direction.dot(blocks.block<3, 3>(place[k], place[l]) *
                                      switches_[l].direction) +
           (k == l ? switches_[k].yield : 0));
}

bool CapacitanceMatrix::contains(int node) const {
  return std::any_of(switches_.begin(), switches_.end(),
                     [&](const ConstraintSwitch& s) { return s.node == node; });
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
    return present(matrix).cwiseAbs().colwise().sum().maxCoeff();
  };
  return norm(compliance_) * norm(inverse_);
}

std::pair<int, int> CapacitanceMatrix::weakestPair() const {
  const int n = size();
  if (n < 2) return {-1, -1};
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(present(compliance_));
  // The columns before the largest drop of the pivots span the matrix. The last one less its
  // combination of those is what the matrix all but annihilates.
  const Eigen::VectorXd pivots = qr.matrixR().diagonal().cwiseAbs();
  const double least = std::numeric_limits<double>::epsilon() * pivots[0];
  int rank = 1;
  double largestDrop = 0;
  for (int k = 1; k < n; ++k) {
    const double drop = pivots[k - 1] / std::max(pivots[k], least);
    if (pivots[k - 1] > least && drop > largestDrop) {
      largestDrop = drop;
      rank = k;
    }
  }
  const Eigen::VectorXd combination = qr.matrixR()
                                          .topLeftCorner(rank, rank)
                                          .triangularView<Eigen::Upper>()
                                          .solve(qr.matrixR().col(n - 1).head(rank));
  const auto& order = qr.colsPermutation().indices();
  std::map<int, double> shares;  // of nodes, squared
  shares[switches_[order[n - 1]].node] += 1;
  for (int k = 0; k < rank; ++k)
    shares[switches_[order[k]].node] += combination[k] * combination[k];
  std::vector<std::pair<double, int>> largest;
  for (const auto& [node, share] : shares) largest.push_back({share, node});
  std::sort(largest.rbegin(), largest.rend());
  constexpr double negligible = 1e-4;
  if (largest.size() < 2 || largest[1].first < negligible * largest[0].first)
    return {largest[0].second, largest[0].second};
  return std::minmax({largest[0].second, largest[1].second});
}

}  // namespace palpate
