// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/contact_newton_inverse.h"

#include <algorithm>
#include <Eigen/LU>

#include "contact/inverse_updates.h"
#include "greens/weighted_columns.h"
#include "linear_algebra/lapack.h"

namespace palpate {
namespace {

constexpr double kRegularisation = 1e-6;  ///< epsilon; r W is of the order of one

// Multiplications, and numbers that are read, of a block of the Newton matrix.
constexpr double kEntry = 36, kBlock = 9;

}  // namespace

ContactNewtonInverse::ContactNewtonInverse(const ContactCompliance& compliance)
    : compliance_(&compliance), stride_(compliance.stride()) {
  const int capacity = compliance.capacity();
  share_.resize(capacity);
  scale_.resize(capacity);
  slotOf_.resize(capacity, -1);
  contactOf_.resize(capacity);
  const std::size_t size = std::size_t(stride_) * 3 * capacity;
  inverse_ = AlignedBuffer<double>(size);
  factor_ = AlignedBuffer<double>(size);
  std::fill_n(inverse_.data(), size, 0);
  for (AlignedBuffer<double>* buffer : {&left_, &right_, &x_, &y_}) {
    *buffer = AlignedBuffer<double>(3 * std::size_t(stride_));
    std::fill_n(buffer->data(), buffer->size(), 0);
  }
  pivots_.resize(3 * capacity);
}

void ContactNewtonInverse::append() noexcept {
  const int contact = compliance_->count() - 1;
  slotOf_[contact] = -1;
  moved(contact);
}

void ContactNewtonInverse::moved(int contact) noexcept {
  if (slotOf_[contact] >= 0) erase(contact);
  scale_[contact] = 3 / compliance_->block(contact, contact).trace();
  share_[contact].setZero();
}

void ContactNewtonInverse::remove(int contact) noexcept {
  if (slotOf_[contact] >= 0) erase(contact);
  const int last = compliance_->count() - 1;
  share_[contact] = share_[last];
  scale_[contact] = scale_[last];
  slotOf_[contact] = slotOf_[last];
  if (slotOf_[contact] >= 0) contactOf_[slotOf_[contact]] = contact;
}

void ContactNewtonInverse::clear() noexcept {
  for (int k = 0; k < 3 * active_; ++k) std::fill_n(column(k), stride_, 0);
  std::fill(slotOf_.begin(), slotOf_.end(), -1);
  for (Eigen::Matrix3d& share : share_) share.setZero();
  active_ = 0;
}

/// Block of the Newton matrix between two contacts, with a share of the row's.
Eigen::Matrix3d ContactNewtonInverse::entry(int row, int column,
                                            const Eigen::Matrix3d& share) const noexcept {
  Eigen::Matrix3d entry = scale_[row] * share * compliance_->block(row, column);
  if (row == column) entry += Eigen::Matrix3d::Identity() - (1 - kRegularisation) * share;
  return entry;
}

/// x = H b and y = H^T c, three columns each.
void ContactNewtonInverse::multiplyBoth(const double* b, const double* c, double* x,
                                        double* y) const noexcept {
  multiplyBothSides(inverse_.data(), 3 * active_, stride_, b, c, 3, x, y);
  const double entries = 3. * active_ * padded(3 * active_);
  work_.add(6 * entries, entries);
}

/// y = H^T c alone.
void ContactNewtonInverse::multiplyRows(const double* c, double* y) const noexcept {
  multiplyTransposed(inverse_.data(), 3 * active_, stride_, c, y);
  const double entries = 3. * active_ * padded(3 * active_);
  work_.add(3 * entries, entries);
}

/// H += x y^T, three columns each.
void ContactNewtonInverse::addProduct(const double* x, const double* y) noexcept {
  addOuterProduct(inverse_.data(), 3 * active_, stride_, x, y, 3);
  const double entries = 3. * active_ * padded(3 * active_);
  work_.add(3 * entries, 2 * entries);
}

/// A contact's rows over all slots, transposed and padded.
void ContactNewtonInverse::setRows(int contact, const Eigen::Matrix3d& share,
                                   double* rows) const noexcept {
  for (int slot = 0; slot < active_; ++slot)
    Block(rows + 3 * slot, Eigen::OuterStride<>(stride_)) =
        entry(contact, contactOf_[slot], share).transpose();
  for (int j = 0; j < 3; ++j)
    std::fill(rows + j * stride_ + 3 * active_, rows + j * stride_ + padded(3 * active_), 0);
  work_.add(kEntry * active_, kBlock * active_);
}

/// to = from * by, three columns over all slots, padded.
void ContactNewtonInverse::scaleColumns(const double* from, const Eigen::Matrix3d& by,
                                        double* to) const noexcept {
  for (int j = 0; j < 3; ++j) {
    double* target = to + j * stride_;
    for (int k = 0; k < 3 * active_; ++k)
      target[k] =
          from[k] * by(0, j) + from[stride_ + k] * by(1, j) + from[2 * stride_ + k] * by(2, j);
    std::fill(target + 3 * active_, target + padded(3 * active_), 0);
  }
  work_.add(kBlock * 3 * active_, 0);
}

void ContactNewtonInverse::update(int contact, const Eigen::Matrix3d& share) noexcept {
  ++updates_;
  const bool had = slotOf_[contact] >= 0, has = !share.isZero(0);
  if (had && has)
    replace(contact, share);
  else if (had)
    erase(contact);
  else if (has)
    insert(contact, share);
}

/// With border columns b, rows c and block d: S = d - c H b, H += H b S^-1 c H, and so on.
void ContactNewtonInverse::insert(int contact, const Eigen::Matrix3d& share) noexcept {
  double *b = left_.data(), *c = right_.data(), *hb = x_.data(), *hc = y_.data();
  for (int slot = 0; slot < active_; ++slot) {
    const int row = contactOf_[slot];
    Block(b + 3 * slot, Eigen::OuterStride<>(stride_)) = entry(row, contact, share_[row]);
  }
  for (int j = 0; j < 3; ++j)
    std::fill(b + j * stride_ + 3 * active_, b + j * stride_ + padded(3 * active_), 0);
  setRows(contact, share, c);
  multiplyBoth(b, c, hb, hc);
  Eigen::Matrix3d schur = entry(contact, contact, share);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3 * active_; ++k) schur(i, j) -= c[i * stride_ + k] * hb[j * stride_ + k];
  const Eigen::Matrix3d corner = schur.inverse();
  if (!corner.allFinite()) return;
  scaleColumns(hb, corner, b);
  for (int j = 0; j < 3; ++j)
    std::fill(hc + j * stride_ + 3 * active_, hc + j * stride_ + padded(3 * active_), 0);
  addProduct(b, hc);
  const int slot = active_++;
  for (int j = 0; j < 3; ++j) {
    std::fill_n(column(3 * slot + j), stride_, 0);
    for (int k = 0; k < 3 * slot; ++k) {
      column(3 * slot + j)[k] = -b[j * stride_ + k];
      column(k)[3 * slot + j] = -(corner(j, 0) * hc[k] + corner(j, 1) * hc[stride_ + k] +
                                  corner(j, 2) * hc[2 * stride_ + k]);
    }
  }
  block(slot, slot) = corner;
  slotOf_[contact] = slot;
  contactOf_[slot] = contact;
  share_[contact] = share;
  // The border, its product with H, and the new rows.
  work_.add((kEntry + 2 * 3 * kBlock) * slot, (kBlock + 2 * kBlock) * slot);
}

/// H -= (its columns of the contact) corner^-1 (its rows), over what remains.
void ContactNewtonInverse::erase(int contact) noexcept {
  const int slot = slotOf_[contact], last = active_ - 1;
  if (slot != last) {
    for (int j = 0; j < 3; ++j)
      std::swap_ranges(column(3 * slot + j), column(3 * slot + j) + 3 * active_,
                       column(3 * last + j));
    for (int k = 0; k < 3 * active_; ++k)
      std::swap_ranges(column(k) + 3 * slot, column(k) + 3 * slot + 3, column(k) + 3 * last);
    contactOf_[slot] = contactOf_[last];
    slotOf_[contactOf_[slot]] = slot;
  }
  const Eigen::Matrix3d cornerInverse = block(last, last).inverse();
  active_ = last;
  slotOf_[contact] = -1;
  share_[contact].setZero();
  for (int j = 0; j < 3; ++j) {
    double* row = y_.data() + j * stride_;
    for (int k = 0; k < 3 * active_; ++k) row[k] = column(k)[3 * last + j];
    std::fill(row + 3 * active_, row + padded(3 * active_), 0);
  }
  for (int k = 0; k < 3 * active_; ++k) std::fill_n(column(k) + 3 * last, 3, 0);
  if (!cornerInverse.allFinite()) return clear();
  scaleColumns(column(3 * last), -cornerInverse, x_.data());
  addProduct(x_.data(), y_.data());
}

/// With new rows R: H -= H_i (R H)_ii^-1 (R H - E_i^T), after which R H = E_i^T whatever H was.
void ContactNewtonInverse::replace(int contact, const Eigen::Matrix3d& share) noexcept {
  const int slot = slotOf_[contact];
  double *rows = left_.data(), *product = y_.data();
  setRows(contact, share, rows);
  multiplyRows(rows, product);
  for (int j = 0; j < 3; ++j)
    std::fill(product + j * stride_ + 3 * active_, product + j * stride_ + padded(3 * active_), 0);
  Eigen::Matrix3d pivot;
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 3; ++k) pivot(j, k) = product[j * stride_ + 3 * slot + k];
  const Eigen::Matrix3d pivotInverse = pivot.inverse();
  if (!pivotInverse.allFinite()) return erase(contact);
  for (int j = 0; j < 3; ++j) product[j * stride_ + 3 * slot + j] -= 1;
  scaleColumns(column(3 * slot), -pivotInverse, x_.data());
  addProduct(x_.data(), product);
  share_[contact] = share;
}

bool ContactNewtonInverse::factor(const std::vector<Eigen::Matrix3d>& shares) noexcept {
  int active = 0;
  for (int contact = 0; contact < compliance_->count(); ++contact)
    if (!shares[contact].isZero(0)) pivots_[active++] = contact;
  const int size = 3 * active;
  const double blocks = double(active) * active;
  // LU and the inverse from it, each of whose passes reads and writes the matrix at least once.
  work_.add(kEntry * blocks + double(size) * size * size, (1 + 2 * 3) * kBlock * blocks);
  double* lu = factor_.data();
  for (int j = 0; j < active; ++j)
    for (int i = 0; i < active; ++i)
      Block(lu + std::size_t(3 * j) * stride_ + 3 * i, Eigen::OuterStride<>(stride_)) =
          entry(pivots_[i], pivots_[j], shares[pivots_[i]]);
  std::copy_n(pivots_.begin(), active, contactOf_.begin());
  std::fill(slotOf_.begin(), slotOf_.end(), -1);
  active_ = active;
  for (int slot = 0; slot < active; ++slot) slotOf_[contactOf_[slot]] = slot;
  if (lapack::getrf(size, size, lu, stride_, pivots_.data()) != 0 ||
      lapack::getri(size, lu, stride_, pivots_.data(), x_.data(), 3 * stride_) != 0) {
    clear();
    return false;
  }
  for (int k = 0; k < size; ++k) {
    std::copy_n(lu + std::size_t(k) * stride_, size, column(k));
    std::fill(column(k) + size, column(k) + stride_, 0);
  }
  for (int contact = 0; contact < compliance_->count(); ++contact)
    share_[contact] = shares[contact];
  return true;
}

void ContactNewtonInverse::rebuild(const std::vector<Eigen::Matrix3d>& shares) noexcept {
  clear();
  for (int contact = 0; contact < compliance_->count(); ++contact) update(contact, shares[contact]);
}

void ContactNewtonInverse::apply(double* residual) const noexcept {
  double *in = x_.data(), *out = y_.data();
  const int size = 3 * active_;
  for (int slot = 0; slot < active_; ++slot)
    std::copy_n(residual + 3 * contactOf_[slot], 3, in + 3 * slot);
  std::fill_n(out, padded(size), 0);
  const double* columns[kColumnGroup];
  for (int first = 0; first < size; first += kColumnGroup) {
    const int group = std::min(kColumnGroup, size - first);
    for (int k = 0; k < group; ++k) columns[k] = column(first + k);
    addWeightedColumns(columns, in + first, group, padded(size), out);
  }
  for (int slot = 0; slot < active_; ++slot)
    std::copy_n(out + 3 * slot, 3, residual + 3 * contactOf_[slot]);
  const double entries = double(size) * padded(size);
  work_.add(entries, entries);
}

}  // namespace palpate
