// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <algorithm>
#include <Eigen/Core>

namespace palpate {

/// Speeds up a fixed-point iteration x = G(x) by what its last steps tell of G (D. G. Anderson, J.
/// ACM 12 (1965)): where G is affine with as many eigenvalues apart as steps are kept, it ends
/// after one step more than these. Nothing but construction allocates or throws.
class AndersonMixing {
 public:
  /// @param size   of x.
  /// @param depth  steps kept, at least 1.
  AndersonMixing(int size, int depth)
      : residuals_(size, depth), values_(size, depth), residual_(size), value_(size) {}

  /// Forgets all steps.
  void restart() noexcept {
    count_ = 0;
    hasLast_ = false;
  }

  /// @param x      set to what is to be tried next.
  /// @param value  G(x).
  void next(Eigen::VectorXd& x, const Eigen::VectorXd& value) noexcept {
    if (hasLast_) keep(x, value);
    residual_ = value - x;
    value_ = value;
    hasLast_ = true;
    x = value;
    for (int k = 0; k < count_; ++k) x -= residuals_.col(k).dot(residual_) * values_.col(k);
  }

 private:
  /// Differences from the last step, orthogonal to those before; the oldest goes.
  void keep(const Eigen::VectorXd& x, const Eigen::VectorXd& value) noexcept {
    constexpr double dependent = 1e-8;
    const int depth = static_cast<int>(residuals_.cols());
    if (count_ == depth) {
      for (int k = 1; k < depth; ++k) {
        residuals_.col(k - 1) = residuals_.col(k);
        values_.col(k - 1) = values_.col(k);
      }
      --count_;
    }
    auto residual = residuals_.col(count_), change = values_.col(count_);
    residual = value - x - residual_;
    change = value - value_;
    const double size = residual.norm();
    for (int k = 0; k < count_; ++k) {
      const double share = residuals_.col(k).dot(residual);
      residual -= share * residuals_.col(k);
      change -= share * values_.col(k);
    }
    const double left = residual.norm();
    if (!(left > dependent * size)) return;
    residual /= left;
    change /= left;
    ++count_;
  }

  Eigen::MatrixXd residuals_, values_;  ///< orthonormal changes of G(x) - x, those of G(x) to them
  Eigen::VectorXd residual_, value_;    ///< of the last step
  int count_ = 0;
  bool hasLast_ = false;
};

}  // namespace palpate
