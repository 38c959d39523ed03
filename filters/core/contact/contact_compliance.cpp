// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/contact_compliance.h"

#include <algorithm>
#include <cmath>
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
  orientations_.assign(bodies_.size(), Eigen::Matrix3d::Identity());
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

/// Contacts that a fixed node bears yield by it together, or each would be a stiffness of its own.
void ContactCompliance::addSharedYield(const ContactSite::Part& part) noexcept {
  for (int i = 0; i < count_; ++i)
    for (int k = 0; k < sites_[i].count; ++k) {
      const ContactSite::Part& other = sites_[i].parts[k];
      if (other.body != part.body || other.node != part.node) continue;
      const double yield = part.weight * other.weight / rigidStiffness_;
      for (double* border : {columnBorder_.data(), rowBorder_.data()})
        Eigen::Map<Eigen::Matrix3d>(border + 9 * i) += yield * Eigen::Matrix3d::Identity();
    }
}

/// Blocks between a new contact and the present ones: W[present, new] into columnBorder_ (one 3 by
/// 3 block a contact), W[new, present] into rowBorder_.
void ContactCompliance::gatherBorder(const ContactSite& site) noexcept {
  std::fill_n(columnBorder_.data(), 9 * count_, 0);
  std::fill_n(rowBorder_.data(), 9 * count_, 0);
  for (int p = 0; p < site.count; ++p) {
    const ContactSite::Part& part = site.parts[p];
    const GreensFunctions& greens = *bodies_[part.body];
    const Eigen::Matrix3d& turn = orientations_[part.body];
    if (greens.isFixed(part.node)) {
      addSharedYield(part);
      continue;
    }
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
    const Eigen::Map<const Eigen::MatrixX3d> columns(blocks_.data(), 3 * present, 3);
    for (int k = 0; k < present; ++k)
      Eigen::Map<Eigen::Matrix3d>(columnBorder_.data() + 9 * owners_[k]) +=
          part.weight * weights_[k] / greens.vertexArea(part.node) *
          (turn * columns.middleRows<3>(3 * k) * turn.transpose());
    if (symmetric_) continue;
    greens.gather(self, nodes, blocks_.data());
    const Eigen::Map<const Eigen::Matrix3Xd> rows(blocks_.data(), 3, 3 * present);
    for (int k = 0; k < present; ++k)
      Eigen::Map<Eigen::Matrix3d>(rowBorder_.data() + 9 * owners_[k]) +=
          part.weight * weights_[k] / greens.vertexArea(nodes_[k]) *
          (turn * rows.middleCols<3>(3 * k) * turn.transpose());
  }
  if (symmetric_)
    for (int i = 0; i < count_; ++i)
      Eigen::Map<Eigen::Matrix3d>(rowBorder_.data() + 9 * i) =
          Eigen::Map<const Eigen::Matrix3d>(columnBorder_.data() + 9 * i).transpose();
}

/// Raised by the site's spread towards the weighted compliances of its nodes one by one.
Eigen::Matrix3d ContactCompliance::ownBlock(const ContactSite& site) const noexcept {
  Eigen::Matrix3d own = Eigen::Matrix3d::Zero(), mean = own;
  for (int p = 0; p < site.count; ++p) {
    const ContactSite::Part& row = site.parts[p];
    const GreensFunctions& greens = *bodies_[row.body];
    if (greens.isFixed(row.node)) {
      own += row.weight * row.weight / rigidStiffness_ * Eigen::Matrix3d::Identity();
      mean += std::abs(row.weight) / rigidStiffness_ * Eigen::Matrix3d::Identity();
      continue;
    }
    for (int q = 0; q < site.count; ++q) {
      const ContactSite::Part& column = site.parts[q];
      if (column.body != row.body || greens.isFixed(column.node)) continue;
      Eigen::Matrix3d block;
      greens.gather(Eigen::Map<const Eigen::VectorXi>(&row.node, 1),
                    Eigen::Map<const Eigen::VectorXi>(&column.node, 1), block.data());
      block = orientations_[row.body] * block * orientations_[row.body].transpose();
      const double area = greens.vertexArea(column.node);
      own += row.weight * column.weight / area * block;
      if (p == q) mean += std::abs(row.weight) / area * block;
    }
  }
  return own + site.spread * (mean - own);
}

bool ContactCompliance::hasColumns(const ContactSite& site) const noexcept {
  return std::all_of(site.parts.begin(), site.parts.begin() + site.count, [&](const auto& part) {
    return bodies_[part.body]->isFixed(part.node) || bodies_[part.body]->hasColumn(part.node);
  });
}

bool ContactCompliance::add(const ContactSite& site) noexcept {
  if (count_ == capacity_ || !hasColumns(site)) return false;
  sites_[count_] = {};  // without parts: it has no share in its own border
  move(count_++, site);
  return true;
}

void ContactCompliance::move(int contact, const ContactSite& site) noexcept {
  gatherBorder(site);
  sites_[contact] = site;
  const Eigen::Matrix3d own = ownBlock(site);
  for (int j = 0; j < 3; ++j) {
    double* newColumn = mutableColumn(3 * contact + j);
    for (int i = 0; i < count_; ++i)
      for (int k = 0; k < 3; ++k) {
        newColumn[3 * i + k] = columnBorder_[9 * i + 3 * j + k];
        mutableColumn(3 * i + k)[3 * contact + j] = rowBorder_[9 * i + 3 * k + j];
      }
    std::fill(newColumn + 3 * count_, newColumn + stride_, 0);
  }
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 3; ++k) mutableColumn(3 * contact + j)[3 * contact + k] = own(k, j);
}

void ContactCompliance::turn(int body, const Eigen::Matrix3d& orientation) noexcept {
  orientations_[body] = orientation;
  for (int i = 0; i < count_; ++i)
    if (std::any_of(sites_[i].parts.begin(), sites_[i].parts.begin() + sites_[i].count,
                    [&](const auto& part) { return part.body == body; }))
      move(i, ContactSite(sites_[i]));
}

bool ContactCompliance::isOnFixed(int contact) const noexcept {
  const ContactSite& site = sites_[contact];
  return std::any_of(site.parts.begin(), site.parts.begin() + site.count,
                     [&](const auto& part) { return bodies_[part.body]->isFixed(part.node); });
}

void ContactCompliance::setRigidStiffness(double rigidStiffness) noexcept {
  rigidStiffness_ = rigidStiffness;
  for (int i = 0; i < count_; ++i)
    if (isOnFixed(i)) move(i, ContactSite(sites_[i]));
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
  double weights[kColumnGroup];
  int group = 0, loaded = 0;
  for (int contact = 0; contact < count_; ++contact) {
    const double* force = forces + 3 * contact;
    if (force[0] == 0 && force[1] == 0 && force[2] == 0) continue;
    ++loaded;
    for (int k = 0; k < 3; ++k) {
      columns[group] = column(3 * contact + k);
      weights[group++] = force[k];
    }
    if (group < kColumnGroup) continue;
    addWeightedColumns(columns, weights, group, padded(3 * count_), out);
    group = 0;
  }
  addWeightedColumns(columns, weights, group, padded(3 * count_), out);
  const double entries = 3. * loaded * padded(3 * count_);
  work_.add(entries, entries);
}

void ContactCompliance::addColumn(int contact, const Eigen::Vector3d& force,
                                  double* out) const noexcept {
  const double* columns[3] = {column(3 * contact), column(3 * contact + 1),
                              column(3 * contact + 2)};
  addWeightedColumns(columns, force.data(), 3, padded(3 * count_), out);
  const double entries = 3. * padded(3 * count_);
  work_.add(entries, entries);
}

}  // namespace palpate
