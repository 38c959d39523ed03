// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/hand_grip.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

constexpr double kStep = 0.01;    ///< rad, or parts of the farthest way
constexpr double kFinest = 1e-5;  ///< parts of the farthest way
constexpr int kMostSteps = 250;   ///< of a joint
constexpr int kFirstMetacarpal = 15;

/// A joint as it bends when a hand closes.
struct Bend {
  int joint;
  double pace;  ///< rad a step; negative: the angle falls
  double last;  ///< rad, as far as it goes
};
/// A chain of three bones with the joints that move them.
struct ClosingFinger {
  int firstBone;
  Bend bends[3];
};

constexpr ClosingFinger finger(int bone, int joint) {
  return {bone,
          {{joint, kStep, 1.5}, {joint + 1, 0.6 * kStep, 1.7}, {joint + 2, 0.4 * kStep, 1.0}}};
}
constexpr ClosingFinger kClosing[] = {
    {0, {{ThumbRotation, kStep, 1.6}, {ThumbProximal, kStep, 0.5}, {ThumbDistal, kStep, 0.6}}},
    finger(3, IndexProximal),
    finger(6, MiddleProximal),
    finger(9, RingProximal),
    finger(12, LittleProximal)};

}  // namespace

HandGrip::HandGrip(const HandModel& hand, std::shared_ptr<const SurfaceMesh> mesh,
                   const BoundaryConditions& conditions)
    : tool_(hand), mesh_(std::move(mesh)) {
  if (!mesh_) throw std::invalid_argument("there is no surface to shape a hand to");
  if (conditions.nodeCount() != mesh_->vertexCount())
    throw std::invalid_argument("the boundary conditions are those of " +
                                std::to_string(conditions.nodeCount()) + " vertices, not of " +
                                std::to_string(mesh_->vertexCount()));
  for (int v = 0; v < mesh_->vertexCount(); ++v) fixed_.push_back(conditions.isFixed(v));
}

double HandGrip::depth(const ToolPose& pose, int first, int count, bool fixed) const {
  RigidPose placed[kHandCapsuleCount];
  tool_.place(pose, placed);
  double least = std::numeric_limits<double>::infinity();
  for (int v = 0; v < mesh_->vertexCount(); ++v)
    if (bool(fixed_[v]) == fixed)
      for (int bone = first; bone < first + count; ++bone) {
        const Eigen::Vector3d own = placed[bone].toOwn(mesh_->points().col(v));
        least = std::min(least, tool_.shape(bone)->proximity(own).distance);
      }
  return -least;
}

bool HandGrip::presses(const ToolPose& pose, int first, int count, double depth) const {
  RigidPose placed[kHandCapsuleCount];
  tool_.place(pose, placed);
  for (int bone = first; bone < first + count; ++bone) {
    const std::shared_ptr<const RigidShape> shape = tool_.shape(bone);
    const double reach = shape->reach();
    for (int v = 0; v < mesh_->vertexCount(); ++v) {
      const Eigen::Vector3d offset = mesh_->points().col(v) - placed[bone].position;
      if (offset.squaredNorm() > reach * reach) continue;  // outside of the bone
      const Eigen::Vector3d own = placed[bone].orientation.conjugate() * offset;
      if (-shape->proximity(own).distance > (fixed_[v] ? 0 : depth)) return true;
    }
  }
  return false;
}

ToolPose HandGrip::lowered(ToolPose pose, const Eigen::Vector3d& way, double farthest,
                           double depth) const {
  ToolPose next = pose;
  double length = kStep * farthest;
  // In even steps to the first that is too far, then in halves of them.
  for (double moved = 0; length > kFinest * farthest && moved <= farthest;) {
    next.position = pose.position + length * way;
    if (presses(next, kFirstMetacarpal, 4, depth)) {
      length /= 2;
    } else {
      pose.position = next.position;
      moved += length;
    }
  }
  return pose;
}

ToolPose HandGrip::closed(ToolPose pose, double depth) const {
  for (const ClosingFinger& finger : kClosing)
    for (int from = 0, step = 0; from < 3 && step < kMostSteps; ++step) {
      // The first joint whose bending is too much, with those before it, has found its place.
      ToolPose next = pose;
      int stopped = -1;
      for (int k = from; k < 3; ++k) {
        const Bend& bend = finger.bends[k];
        double& angle = next.joints[bend.joint];
        if (bend.pace > 0 ? angle >= bend.last : angle <= bend.last) continue;
        const double before = angle;
        angle += bend.pace;
        if (!presses(next, finger.firstBone + k, 3 - k, depth)) continue;
        angle = before;
        stopped = k;
      }
      pose = next;
      from = stopped + 1 > from ? stopped + 1 : from;
    }
  return pose;
}

}  // namespace palpate
