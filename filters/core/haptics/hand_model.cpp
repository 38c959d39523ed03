// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/hand_model.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "haptics/hand_proportions.h"

namespace palpate {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

const Vector3d kAlong = -Vector3d::UnitZ();

Eigen::Quaterniond turn(double angle, const Vector3d& axis) noexcept {
  return Eigen::Quaterniond(AngleAxisd(angle, axis));
}

/// Bends what points along the fingers towards the palm.
Eigen::Quaterniond flexed(double angle) noexcept {
  return turn(-angle, Vector3d::UnitX());
}

/// Turns it towards a right hand's thumb.
Eigen::Quaterniond towardsThumb(double angle) noexcept {
  return turn(angle, Vector3d::UnitY());
}

struct Bone {
  Capsule capsule;
  Eigen::Quaterniond frame;  ///< the capsule runs along its -z
};
using Bones = std::array<Bone, kHandCapsuleCount>;

/// A chain of bones that grows at its end.
struct Chain {
  Vector3d end;
  Eigen::Quaterniond frame;

  Bone grow(const Eigen::Quaterniond& joint, double length, double radius) noexcept {
    const Vector3d begin = end;
    frame = frame * joint;
    end += length * (frame * kAlong);
    return {{begin, end, radius}, frame};
  }
};

/// Right hand of unit length with the wrist at the origin.
Bones unitHand(const std::array<double, ToolPose::kMostJoints>& q) noexcept {
  Bones bones;
  const Eigen::Quaterniond wrist = towardsThumb(q[WristAbduction]) * flexed(q[WristFlexion]);

  Chain thumb{wrist * Vector3d(hand::kThumbBase[0], 0, -hand::kThumbBase[1]), wrist};
  // The thumb bends in its own plane, across the palm.
  bones[0] = thumb.grow(turn(q[ThumbRotation], Vector3d::UnitZ()) * towardsThumb(q[ThumbAbduction]),
                        hand::kThumb[0], hand::kThumbRadii[0]);
  bones[1] = thumb.grow(towardsThumb(-q[ThumbProximal]), hand::kThumb[1], hand::kThumbRadii[1]);
  bones[2] = thumb.grow(towardsThumb(-q[ThumbDistal]), hand::kThumb[2], hand::kThumbRadii[2]);

  const int proximal[] = {IndexProximal, MiddleProximal, RingProximal, LittleProximal};
  const double ringSpread = q[RingMiddleAbduction];
  const double spread[] = {q[MiddleIndexAbduction], 0, -ringSpread,
                           -ringSpread - q[LittleRingAbduction]};
  const double arch[] = {0, 0, 0.5 * q[PalmArch], q[PalmArch]};
  for (int f = 0; f < 4; ++f) {
    const double* length = hand::kFingers[f];
    const double* angle = &q[static_cast<std::size_t>(proximal[f])];
    Chain finger{Vector3d::Zero(), wrist * flexed(arch[f])};
    // The metacarpals fan out; the fingers are parallel.
    const double across = hand::kKnuckles[f];
    const Vector3d knuckle(across, 0, -std::sqrt(length[0] * length[0] - across * across));
    finger.end = finger.frame * knuckle;
    bones[15 + f] = {{Vector3d::Zero(), finger.end, hand::kFingerRadii[0]},
                     finger.frame * Eigen::Quaterniond::FromTwoVectors(kAlong, knuckle)};
    bones[3 + 3 * f] =
        finger.grow(towardsThumb(spread[f]) * flexed(angle[0]), length[1], hand::kFingerRadii[1]);
    bones[4 + 3 * f] = finger.grow(flexed(angle[1]), length[2], hand::kFingerRadii[2]);
    bones[5 + 3 * f] = finger.grow(flexed(angle[2]), length[3], hand::kFingerRadii[3]);
  }
  return bones;
}

}  // namespace

HandModel::HandModel(double length, HandSide side) : length_(length), side_(side) {
  if (!(length > 0) || !std::isfinite(length))
    throw std::invalid_argument("the length of a hand must be a positive number, not " +
                                std::to_string(length));
}

HandCapsules HandModel::capsules(const ToolPose& pose) const noexcept {
  HandCapsules capsules;
  const Bones bones = unitHand(pose.joints);
  const Vector3d size(side_ == HandSide::Right ? length_ : -length_, length_, length_);
  for (int i = 0; i < kHandCapsuleCount; ++i) {
    const Capsule& bone = bones[i].capsule;
    capsules[i] = {pose.position + pose.orientation * bone.begin.cwiseProduct(size),
                   pose.position + pose.orientation * bone.end.cwiseProduct(size),
                   bone.radius * length_};
  }
  return capsules;
}

HandBonePoses HandModel::bonePoses(const ToolPose& pose) const noexcept {
  HandBonePoses poses;
  const Bones bones = unitHand(pose.joints);
  const double mirror = side_ == HandSide::Right ? 1 : -1;  // in the plane x = 0
  for (int i = 0; i < kHandCapsuleCount; ++i) {
    const Eigen::Quaterniond& frame = bones[i].frame;
    const Vector3d begin = bones[i].capsule.begin.cwiseProduct(Vector3d(mirror, 1, 1));
    poses[i] = {pose.position + pose.orientation * (length_ * begin),
                pose.orientation * Eigen::Quaterniond(frame.w(), frame.x(), mirror * frame.y(),
                                                      mirror * frame.z())};
  }
  return poses;
}

}  // namespace palpate
