// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "touch/grasp_motion.h"

#include <algorithm>
#include <cmath>

#include "haptics/hand_grip.h"

namespace palpate::app {
namespace {

// Parts of the body's extent along the fingers: 6 mm of a kidney, which is a newton or two a finger
// at 8 kPa.
constexpr double kFingerDepth = 0.055, kPalmDepth = 0.05;
constexpr double kRubbing = 0.02;  ///< to either side
constexpr double kHover = 0.5;     ///< lengths of the hand, from where it comes

// Seconds.
constexpr double kReached = 0.6, kClosing = 0.5, kClosed = 0.75;
constexpr double kRegrasp = 0.9, kPeriod = 0.32, kOpening = 0.06, kClosesAgain = 0.08;
constexpr int kRegrasps = 5;
constexpr double kRub = 2.7, kRubbed = 3.6, kRubPeriod = 0.45, kEnd = 4;
// How far it lets go: part of the way that the joints closed, lengths of the hand.
constexpr double kOpened = 0.4, kLifted = 0.06;

double smooth(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// A hand about to grasp: fingers a little bent, the thumb aside.
ToolPose openHand() {
  ToolPose pose;
  pose.jointCount = HandJointCount;
  const auto set = [&](int joint, double angle) {
    pose.joints[static_cast<std::size_t>(joint)] = angle;
  };
  for (int finger : {IndexProximal, MiddleProximal, RingProximal, LittleProximal})
    set(finger + 1, 0.2);
  for (int spread : {MiddleIndexAbduction, RingMiddleAbduction, LittleRingAbduction})
    set(spread, 0.05);
  set(ThumbRotation, 0.2);
  set(ThumbAbduction, 0.7);
  return pose;
}

struct Gesture {
  double height;  ///< above the grasp, lengths of the hand
  double closed;  ///< part of the way that joints bend
  double aside;   ///< parts of the body's extent
};

/// What the hand does at a time, s.
Gesture gestureAt(double time) {
  Gesture gesture{kHover * (1 - smooth(time / kReached)),
                  smooth((time - kClosing) / (kClosed - kClosing)), 0};
  const double regrasp = time - kRegrasp;
  if (regrasp > 0 && regrasp < kRegrasps * kPeriod) {
    const double phase = std::fmod(regrasp, kPeriod);
    const double open = smooth(phase / kOpening) - smooth((phase - kPeriod / 2) / kClosesAgain);
    gesture.height = kLifted * open;
    gesture.closed = 1 - kOpened * open;
  }
  if (time > kRub && time < kRubbed)
    gesture.aside = kRubbing * std::sin(2 * EIGEN_PI * (time - kRub) / kRubPeriod);
  return gesture;
}

}  // namespace

GraspApproach approachTo(const SceneBody& body, const Eigen::Vector3d& freeSide) {
  const Eigen::Vector3d extent =
      body.mesh->points().rowwise().maxCoeff() - body.mesh->points().rowwise().minCoeff();
  int up;
  freeSide.cwiseAbs().maxCoeff(&up);
  const int one = (up + 1) % 3, other = (up + 2) % 3;
  const int along = extent[one] >= extent[other] ? one : other;
  return {std::copysign(1.0, freeSide[up]) * Eigen::Vector3d::Unit(up),
          Eigen::Vector3d::Unit(along), extent[along]};
}

DeviceRecording graspMotion(const SceneBody& body, const GraspApproach& approach,
                            const HandModel& hand) {
  const HandGrip grip(hand, body.mesh, body.greens->info().conditions);
  const Eigen::Vector3d &from = approach.from, &fingers = approach.fingers;
  const Eigen::Vector3d middle =
      (body.mesh->points().rowwise().maxCoeff() + body.mesh->points().rowwise().minCoeff()) / 2;
  Eigen::Matrix3d frame;  // the hand's: fingers along -z, its back along y
  frame << from.cross(-fingers), from, -fingers;
  ToolPose open = openHand();
  open.orientation = Eigen::Quaterniond(frame);
  const Eigen::Vector3d knuckle =
      hand.capsules(open)[16].end;  // the middle finger's, over the middle
  open.position = middle - knuckle + knuckle.dot(from) * from + hand.length() * from;
  open = grip.lowered(open, -from, 2 * hand.length(), kPalmDepth * approach.extent);
  const ToolPose closed = grip.closed(open, kFingerDepth * approach.extent);

  DeviceRecording trace;
  trace.info.name = "grasping hand";
  for (int i = 0; i < kEnd * kMomentsASecond; ++i) {
    const Gesture gesture = gestureAt(i / kMomentsASecond);
    DeviceState state;
    state.sequence = static_cast<std::uint64_t>(i) + 1;
    state.pose = open;
    state.pose.position += gesture.height * hand.length() * from +
                           gesture.aside * approach.extent * from.cross(fingers);
    for (std::size_t j = 0; j < HandJointCount; ++j)
      state.pose.joints[j] += gesture.closed * (closed.joints[j] - open.joints[j]);
    trace.moments.push_back({true, state});
  }
  return trace;
}

}  // namespace palpate::app
