// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>
#include <vector>

#include "contact/rigid_shape.h"
#include "haptics/haptic_device.h"

namespace palpate {

/// What a device moves through the scene: one rigid shape, or several that move with its joints.
class TouchTool {
 public:
  virtual ~TouchTool() = default;
  /// The same number for its whole life.
  virtual int partCount() const noexcept = 0;
  virtual std::shared_ptr<const RigidShape> shape(int part) const = 0;
  /// Neither allocates nor throws.
  /// @param poses  partCount(), in the scene's frame.
  virtual void place(const ToolPose& pose, RigidPose* poses) const noexcept = 0;
};

/// One shape in the device's own frame.
class RigidTouchTool final : public TouchTool {
 public:
  /// @throws std::invalid_argument without a shape.
  explicit RigidTouchTool(std::shared_ptr<const RigidShape> shape);
  int partCount() const noexcept override { return 1; }
  std::shared_ptr<const RigidShape> shape(int) const override { return shape_; }
  void place(const ToolPose& pose, RigidPose* poses) const noexcept override {
    poses[0] = {pose.position, pose.orientation};
  }

 private:
  std::shared_ptr<const RigidShape> shape_;
};

}  // namespace palpate
