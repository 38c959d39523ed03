// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/contact_compliance.h"

#include <algorithm>
#include <stdexcept>

#include "contact/inverse_updates.h"
#include "greens/weighted_columns.h"

namespace palpate {

ContactCompliance::ContactCompliance(std::vector<std::shared_ptr<const GreensFunctions>> bodies,
                                     double rigidStiffness, int capacity)
    : bodies_(std::move(bodies)),
      rigidStiffness_(rigidStiffness),
      capacity_(capacity),
      stride_(padded(3 * capacity)) {
  if (bodies_.empty()) throw std::invalid_argument("contacts need at least one elastic body");
  if (!(rigidStiffness > 0))
    throw std::invalid_argument("the rigid stiffness must be positive, not " +
                                std::to_string(rigidStiffness));
  if (capacity < 1)
    throw std::invalid_argument("there must be room for at least one contact, not for " +
                                std::to_string(capacity));
  for (const auto& body : bodies_) symmetric_ = symmetric_ && body->info().reciprocal;
  sites_.resize(capacity);
  matrix_ = AlignedBuffer<double>(std::size_t(stride_) * 3 * capacity);
  std::fill_n(matrix_.data(), matrix_.size(), 0);
  const std::size_t parts = 4 * std::size_t(capacity);
  nodes_.resize(parts);
  owners_.resize(parts);
  weights_.resize(parts);
  blocks_.resize(9 * parts);
  rowBorder_.resize(9 * std::size_t(capacity));
  columnBorder_.resize(9 * std::size_t(capacity));
}

/// Blocks between a new contact and the present ones: W[present, new] into columnBorder_ (one 3 by
/// 3 block a contact), W[new, present] into rowBorder_.
void ContactCompliance::gatherBorder(const ContactSite& site) noexcept {
  std::fill_n(columnBorder_.data(), 9 * count_, 0);
  std::fill_n(rowBorder_.data(), 9 * count_, 0);
  for (int p = 0; p < site.count; ++p) {
    const ContactSite::Part& part = site.parts[p];
    const GreensFunctions& greens = *bodies_[part.body];
    if (greens.isFixed(part.node)) continue;
    int present = 0;
    for (int i = 0; i < count_; ++i)
      for (int k = 0; k < sites_[i].count; ++k) {
        const ContactSite::Part& other = sites_[i].parts[k];
        if (other.body != part.body || greens.isFixed(other.node)) continue;
        nodes_[present] = other.node;
        owners_[present] = i;
        weights_[present++] = other.weight;
      }
    const Eigen::Map<const Eigen::VectorXi> nodes(nodes_.data(), present);
    const Eigen::Map<const Eigen::VectorXi> self(&part.node, 1);
    greens.gather(nodes, self, blocks_.data());
    const Eigen::Map<const Eigen::MatrixXd> columns(blocks_.data(), 3 * present, 3);
    for (int k = 0; k < present; ++k)
      Eigen::Map<Eigen::Matrix3d>(columnBorder_.data() + 9 * owners_[k]) +=
          part.weight * weights_[k] / greens.vertexArea(part.node) * columns.middleRows<3>(3 * k);
    if (symmetric_) continue;
    greens.gather(self, nodes, blocks_.data());
    const Eigen::Map<const Eigen::Matrix3Xd> rows(blocks_.data(), 3, 3 * present);
    for (int k = 0; k < present; ++k)
      Eigen::Map<Eigen::Matrix3d>(rowBorder_.data() + 9 * owners_[k]) +=
          part.weight * weights_[k] / greens.vertexArea(nodes_[k]) * rows.middleCols<3>(3 * k);
  }
  if (symmetric_)
    for (int i = 0; i < count_; ++i)
      Eigen::Map<Eigen::Matrix3d>(rowBorder_.data() + 9 * i) =
          Eigen::Map<const Eigen::Matrix3d>(columnBorder_.data() + 9 * i).transpose();
}

Eigen::Matrix3d ContactCompliance::ownBlock(const ContactSite& site) const noexcept {
  Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
  for (int p = 0; p < site.count; ++p) {
    const ContactSite::Part& row = site.parts[p];
    const GreensFunctions& greens = *bodies_[row.body];
    if (greens.isFixed(row.node)) {
      own += row.weight * row.weight / rigidStiffness_ * Eigen::Matrix3d::Identity();
      continue;
    }
    for (int q = 0; q < site.count; ++q) {
      const ContactSite::Part& column = site.parts[q];
      if (column.body != row.body || greens.isFixed(column.node)) continue;
      Eigen::Matrix3d block;
      greens.gather(Eigen::Map<const Eigen::VectorXi>(&row.node, 1),
                    Eigen::Map<const Eigen::VectorXi>(&column.node, 1), block.data());
      own += row.weight * column.weight / greens.vertexArea(column.node) * block;
    }
  }
  return own;
}

bool ContactCompliance::add(const ContactSite& site) noexcept {
  if (count_ == capacity_) return false;
  for (int p = 0; p < site.count; ++p) {
    const ContactSite::Part& part = site.parts[p];
    if (!bodies_[part.body]->isFixed(part.node) && !bodies_[part.body]->hasColumn(part.node))
      return false;
  }
  gatherBorder(site);
  const int n = count_++;
  sites_[n] = site;
  const Eigen::Matrix3d own = ownBlock(site);
  for (int j = 0; j < 3; ++j) {
    double* newColumn = mutableColumn(3 * n + j);
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < 3; ++k) {
        newColumn[3 * i + k] = columnBorder_[9 * i + 3 * j + k];
        mutableColumn(3 * i + k)[3 * n + j] = rowBorder_[9 * i + 3 * k + j];
      }
    }
    std::fill(newColumn + 3 * n, newColumn + stride_, 0);
    for (int k = 0; k < 3; ++k) newColumn[3 * n + k] = own(k, j);
  }
  return true;
}

void ContactCompliance::remove(int contact) noexcept {
  const int last = --count_;
  if (contact != last) {
    sites_[contact] = sites_[last];
    for (int j = 0; j < 3; ++j)
      std::copy_n(column(3 * last + j), 3 * (last + 1), mutableColumn(3 * contact + j));
    for (int k = 0; k < 3 * last; ++k)
      std::copy_n(column(k) + 3 * last, 3, mutableColumn(k) + 3 * contact);
  }
  for (int k = 0; k < 3 * last; ++k) std::fill_n(mutableColumn(k) + 3 * last, 3, 0);
}

void ContactCompliance::multiply(const double* forces, double* out) const noexcept {
  std::fill_n(out, stride_, 0);
  const double* columns[kColumnGroup];
  for (int first = 0; first < 3 * count_; first += kColumnGroup) {
    const int size = std::min(kColumnGroup, 3 * count_ - first);
    for (int k = 0; k < size; ++k) columns[k] = column(first + k);
    addWeightedColumns(columns, forces + first, size, padded(3 * count_), out);
  }
}

void ContactCompliance::addColumn(int contact, const Eigen::Vector3d& force,
                                  double* out) const noexcept {
  const double* columns[3] = {column(3 * contact), column(3 * contact + 1),
                              column(3 * contact + 2)};
  addWeightedColumns(columns, force.data(), 3, padded(3 * count_), out);
}

}  // namespace palpate
