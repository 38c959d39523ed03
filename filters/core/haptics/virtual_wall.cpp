// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/virtual_wall.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {

VirtualWall::VirtualWall(double stiffness, const Eigen::Vector3d& point,
                         const Eigen::Vector3d& normal, int toolCount)
    : stiffness_(stiffness), point_(point), normal_(normal.stableNormalized()) {
  if (!(stiffness >= 0) || !std::isfinite(stiffness))
    throw std::invalid_argument("a wall's stiffness must not be negative: " +
                                std::to_string(stiffness));
  if (!point.allFinite()) throw std::invalid_argument("the wall's point is not a finite number");
  if (!normal_.allFinite() || normal_.isZero())
    throw std::invalid_argument("the wall's normal has no direction");
  if (toolCount < 1)
    throw std::invalid_argument("a wall is touched by one tool or more, not by " +
                                std::to_string(toolCount));
  contacts_.resize(toolCount);
}

ContactCertificate VirtualWall::step(const ToolPose* poses, Wrench* wrenches) noexcept {
  certificate_ = ContactCertificate();
  for (int t = 0; t < toolCount(); ++t) {
    ToolContact& contact = contacts_[t];
    const double depth =
        poses[t].isThere ? std::max(0.0, (point_ - poses[t].position).dot(normal_)) : 0;
    contact.touching = depth > 0;
    contact.pose = poses[t];
    contact.hapticPoint = poses[t].position;
    contact.staticPoint = poses[t].position + depth * normal_;
    contact.wrench = {stiffness_ * depth * normal_, Eigen::Vector3d::Zero()};
    wrenches[t] = contact.wrench;
    certificate_.contactCount += contact.touching;
  }
  return certificate_;
}

void VirtualWall::reset() noexcept {
  std::fill(contacts_.begin(), contacts_.end(), ToolContact());
  certificate_ = ContactCertificate();
}

ContactSnapshot VirtualWall::makeSnapshot() const {
  ContactSnapshot snapshot;
  snapshot.tools.resize(contacts_.size());
  return snapshot;
}

void VirtualWall::fill(ContactSnapshot& snapshot) const noexcept {
  std::copy(contacts_.begin(), contacts_.end(), snapshot.tools.begin());
  snapshot.certificate = certificate_;
}

}  // namespace palpate
