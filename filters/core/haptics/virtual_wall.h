// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "haptics/touch_model.h"

namespace palpate {

/// The simplest thing to touch, of known stiffness: a half-space that pushes back along its normal
/// with K times the depth, f = K max(0, (x0 - x) . n) n.
class VirtualWall : public TouchModel {
 public:
  /// @param stiffness  K, N/m.
  /// @param point      x0, on the wall, m.
  /// @param normal     n, out of the wall; of any length.
  /// @throws std::invalid_argument if one is not finite, the stiffness negative, the normal zero or
  ///         the number of tools not positive.
  VirtualWall(double stiffness, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
              int toolCount = 1);

  int toolCount() const override { return static_cast<int>(contacts_.size()); }
  ContactCertificate step(const ToolPose* poses, Wrench* wrenches) noexcept override;
  void reset() noexcept override;
  ContactSnapshot makeSnapshot() const override;
  void fill(ContactSnapshot& snapshot) const noexcept override;

 private:
  double stiffness_;
  Eigen::Vector3d point_, normal_;
  ContactCertificate certificate_;
  std::vector<ToolContact> contacts_;
};

}  // namespace palpate
