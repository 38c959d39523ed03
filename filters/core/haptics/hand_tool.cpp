// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/hand_tool.h"

#include <algorithm>

namespace palpate {

HandTool::HandTool(const HandModel& hand) : hand_(hand) {
  const HandCapsules flat = hand.capsules(ToolPose());
  for (int part = 0; part < kHandCapsuleCount; ++part) {
    const double length = (flat[part].end - flat[part].begin).norm();
    shapes_[part] = std::make_shared<CapsuleShape>(
        Eigen::Vector3d::Zero(), -length * Eigen::Vector3d::UnitZ(), flat[part].radius);
  }
}

void HandTool::place(const ToolPose& pose, RigidPose* poses) const noexcept {
  const HandBonePoses bones = hand_.bonePoses(pose);
  std::copy(bones.begin(), bones.end(), poses);
}

}  // namespace palpate
