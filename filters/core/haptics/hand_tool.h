// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "haptics/hand_model.h"
#include "haptics/touch_tool.h"

namespace palpate {

/// A hand that touches with all its bones, each a capsule that moves with the glove's joints. What
/// sticks to a bone turns with it.
class HandTool final : public TouchTool {
 public:
  explicit HandTool(const HandModel& hand);
  int partCount() const noexcept override { return kHandCapsuleCount; }
  std::shared_ptr<const RigidShape> shape(int part) const override { return shapes_[part]; }
  /// @param pose  as HandModel's.
  void place(const ToolPose& pose, RigidPose* poses) const noexcept override;

  const HandModel& hand() const noexcept { return hand_; }

 private:
  HandModel hand_;
  std::array<std::shared_ptr<const RigidShape>, kHandCapsuleCount> shapes_;
};

}  // namespace palpate
