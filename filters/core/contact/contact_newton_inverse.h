// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/contact_compliance.h"
#include "linear_algebra/aligned_buffer.h"

namespace palpate {

/// The explicit inverse of the Newton matrix of the contacts that bear forces: three rows a
/// contact,
///   (1 - D) + D (r W + epsilon),
/// with its compliance W, its scale r and a 3 by 3 share D: 0 of a contact that is open (it has no
/// rows here), 1 of one that sticks. Contacts enter, leave and change their share at O(s^2);
/// epsilon keeps the matrix regular where contacts depend on each other.
///
/// All memory is reserved by the constructor: nothing else allocates or throws. The compliance must
/// outlive the object, stay where it is, and tell of contacts by `append` and `remove`.
class ContactNewtonInverse {
 public:
  explicit ContactNewtonInverse(const ContactCompliance& compliance);

  /// r of a contact, N/m.
  double scale(int contact) const { return scale_[contact]; }
  /// D that the inverse is of.
  const Eigen::Matrix3d& share(int contact) const { return share_[contact]; }

  /// Takes note of the compliance's last contact, which is open.
  void append() noexcept;
  /// After the compliance has moved a contact: takes its rows out, until they are updated again.
  void moved(int contact) noexcept;
  /// Before the compliance removes a contact: takes its rows out, and gives the last its number.
  void remove(int contact) noexcept;
  void clear() noexcept;

  /// Gives a contact another share: its rows enter, leave or are replaced.
  void update(int contact, const Eigen::Matrix3d& share) noexcept;

  /// The inverse at these shares afresh (LAPACK). @return false, with no contact left in it, if the
  /// matrix is singular.
  bool factor(const std::vector<Eigen::Matrix3d>& shares) noexcept;

  /// The same by an update a contact, which LAPACK's threads have no part in: nothing allocates or
  /// locks. What would make the matrix singular stays out of it.
  void rebuild(const std::vector<Eigen::Matrix3d>& shares) noexcept;

  /// Replaces a residual (3 values a contact) by the inverse times it; of contacts without rows it
  /// stays as it is.
  void apply(double* residual) const noexcept;

  long updates() const { return updates_; }
  const ContactWork& work() const { return work_; }

  /// Flops of what may be next: an update goes over the inverse twice, with three columns, and an
  /// inverse is made of as many as contacts.
  double workOfUpdate() const { return 162.0 * (active_ + 1) * (active_ + 1); }
  static double workOfRebuild(double contacts) { return 54 * contacts * contacts * contacts; }

 private:
  using Block = Eigen::Map<Eigen::Matrix3d, 0, Eigen::OuterStride<>>;
  double* column(int k) const { return inverse_.data() + std::size_t(k) * stride_; }
  Block block(int i, int j) const {
    return Block(column(3 * j) + 3 * i, Eigen::OuterStride<>(stride_));
  }
  Eigen::Matrix3d entry(int row, int column, const Eigen::Matrix3d& share) const noexcept;
  void setRows(int contact, const Eigen::Matrix3d& share, double* rows) const noexcept;
  void insert(int contact, const Eigen::Matrix3d& share) noexcept;
  void erase(int contact) noexcept;
  void replace(int contact, const Eigen::Matrix3d& share) noexcept;
  void scaleColumns(const double* from, const Eigen::Matrix3d& by, double* to) const noexcept;
  void multiplyBoth(const double* b, const double* c, double* x, double* y) const noexcept;
  void multiplyRows(const double* c, double* y) const noexcept;
  void addProduct(const double* x, const double* y) noexcept;

  const ContactCompliance* compliance_;
  int stride_, active_ = 0;
  std::vector<Eigen::Matrix3d> share_;
  std::vector<double> scale_;
  std::vector<int> slotOf_, contactOf_;  ///< slot of a contact (-1: none), contact of a slot
  AlignedBuffer<double> inverse_, factor_;
  mutable AlignedBuffer<double> left_, right_, x_, y_;  ///< scratch, stride by 3
  std::vector<int> pivots_;
  long updates_ = 0;
  mutable ContactWork work_;
};

}  // namespace palpate
