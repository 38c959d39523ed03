// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <array>
#include <Eigen/Core>

#include "contact/rigid_shape.h"
#include "haptics/haptic_device.h"

namespace palpate {

/// The 22 angles that a CyberGlove measures, in its order. rad; flexion bends towards the palm,
/// abduction spreads neighbours apart, all are zero for a flat hand whose fingers and thumb are
/// straight and parallel.
enum HandJoint {
  ThumbRotation,  ///< swings the thumb under the palm
  ThumbProximal,
  ThumbDistal,
  ThumbAbduction,  ///< from the hand's long axis
  IndexProximal,
  IndexMiddle,
  IndexDistal,
  MiddleProximal,
  MiddleMiddle,
  MiddleDistal,
  MiddleIndexAbduction,
  RingProximal,
  RingMiddle,
  RingDistal,
  RingMiddleAbduction,
  LittleProximal,
  LittleMiddle,
  LittleDistal,
  LittleRingAbduction,
  PalmArch,  ///< bends the little finger's metacarpal to the palm, the ring finger's half as far
  WristFlexion,
  WristAbduction,  ///< towards the thumb
  HandJointCount
};

/// All points within a radius of a segment.
struct Capsule {
  Eigen::Vector3d begin, end;
  double radius;
};

/// Bones of the hand from the wrist outwards: thumb (metacarpal, proximal, distal), index, middle,
/// ring, little finger (proximal, middle, distal), then the metacarpals of the four fingers.
constexpr int kHandCapsuleCount = 19;
using HandCapsules = std::array<Capsule, kHandCapsuleCount>;

/// Bones whose forces are felt as one.
struct HandFinger {
  const char* name;
  int firstBone, boneCount;
};
constexpr HandFinger kHandFingers[] = {{"thumb", 0, 3}, {"index", 3, 3},   {"middle", 6, 3},
                                       {"ring", 9, 3},  {"little", 12, 3}, {"palm", 15, 4}};

/// Where the bones are: each begins at its own origin and runs along -z, and turns with its joints.
using HandBonePoses = std::array<RigidPose, kHandCapsuleCount>;

enum class HandSide { Left, Right };

/// Forward kinematics of a hand. Its frame is the forearm's at the wrist: fingers along -z, the
/// back of the flat hand towards y; the thumb of a right hand lies towards -x.
class HandModel {
 public:
  /// @param length  wrist to tip of the middle finger, m.
  /// @throws std::invalid_argument unless it is positive.
  explicit HandModel(double length = 0.19, HandSide side = HandSide::Right);

  /// @param pose  of the forearm at the wrist, with the angles as its first joints; in any frame
  ///              whose lengths are metres.
  /// @return the bones in that frame. Allocates nothing.
  HandCapsules capsules(const ToolPose& pose) const noexcept;

  /// The same as motions of the bones, whose lengths and radii are those of the flat hand.
  HandBonePoses bonePoses(const ToolPose& pose) const noexcept;

  double length() const noexcept { return length_; }
  HandSide side() const noexcept { return side_; }

 private:
  double length_;
  HandSide side_;
};

}  // namespace palpate
