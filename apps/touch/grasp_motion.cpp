// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "touch/grasp_motion.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "haptics/hand_grip.h"

namespace palpate::app {
namespace {

// Parts of the body's extent along the fingers: 3 and 2 mm of a kidney, which is one to three
// newtons a finger at 8 kPa.
constexpr double kFingerDepth = 0.025, kPalmDepth = 0.02;
constexpr double kAlong = 0.12, kAside = 0.16;  ///< radii of the ellipse that it strokes
constexpr double kSmallest = 0.1;               ///< ellipse, over these
constexpr int kPlaces = 64;                     ///< of it, where the hand's shape is found
constexpr double kHover = 0.5;                  ///< lengths of the hand, from where it comes

// Seconds.
constexpr double kReached = 0.6, kClosing = 0.5, kClosed = 0.75;
constexpr double kStroke = 0.85, kTurn = 0.4, kEasing = 0.1;
constexpr int kTurns = 5;
constexpr double kRegrasp = 3.05, kPeriod = 0.32, kOpening = 0.06, kClosesAgain = 0.08, kEnd = 4;
constexpr int kRegrasps = 2;
// How far it lets go: part of the way that the joints closed, lengths of the hand.
constexpr double kOpened = 0.4, kLifted = 0.06;

double smooth(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// The way of what moves at a speed of one, that rises from zero at first and falls to it at last.
double eased(double t, double duration) {
  t = std::clamp(t, 0.0, duration);
  const double first = std::min(t, kEasing), last = std::max(0.0, t - (duration - kEasing));
  return t - first + (first * first - last * last) / (2 * kEasing);
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
  double turns;   ///< around the ellipse
};

/// What the hand does at a time, s.
Gesture gestureAt(double time) {
  Gesture gesture{kHover * (1 - smooth(time / kReached)),
                  smooth((time - kClosing) / (kClosed - kClosing)),
                  eased(time - kStroke, kTurns * kTurn + kEasing) / kTurn};
  const double regrasp = time - kRegrasp;
  if (regrasp > 0 && regrasp < kRegrasps * kPeriod) {
    const double phase = std::fmod(regrasp, kPeriod);
    const double open = smooth(phase / kOpening) - smooth((phase - kPeriod / 2) / kClosesAgain);
    gesture.height = kLifted * open;
    gesture.closed = 1 - kOpened * open;
  }
  return gesture;
}

/// A hand that lies open on the body at each place of the ellipse. The first is on the thumb's
/// side.
/// @param size  of the ellipse, over that which the radii tell.
std::vector<ToolPose> laidAround(const HandGrip& grip, const ToolPose& open,
                                 const GraspApproach& approach, double farthest, double size) {
  const Eigen::Vector3d along = size * kAlong * approach.extent * approach.fingers;
  const Eigen::Vector3d aside =
      size * kAside * approach.extent * approach.from.cross(approach.fingers);
  std::vector<ToolPose> laid;
  for (int k = 0; k < kPlaces; ++k) {
    const double angle = 2 * EIGEN_PI * k / kPlaces;
    ToolPose pose = open;
    pose.position += std::sin(angle) * along + std::cos(angle) * aside;
    laid.push_back(grip.lowered(pose, -approach.from, farthest, kPalmDepth * approach.extent));
  }
  return laid;
}

/// One that holds it from there; the ellipse is as large as it keeps clear of the support.
std::vector<ToolPose> heldAround(const HandGrip& grip, const ToolPose& open,
                                 const GraspApproach& approach, double farthest) {
  std::vector<ToolPose> poses = laidAround(grip, open, approach, farthest, 1);
  const auto meetsSupport = [&](const ToolPose& pose) {
    return grip.depth(pose, 0, kHandCapsuleCount, true) > 0;
  };
  for (double size = 0.5; size > kSmallest; size /= 2)
    if (std::any_of(poses.begin(), poses.end(), meetsSupport))
      poses = laidAround(grip, open, approach, farthest, size);
  for (ToolPose& pose : poses) pose = grip.closed(pose, kFingerDepth * approach.extent);
  return poses;
}

/// Between two of them.
ToolPose heldAt(const std::vector<ToolPose>& held, double turns) {
  const double place = (turns - std::floor(turns)) * kPlaces;
  const auto first = static_cast<int>(place);
  const double share = place - first;
  ToolPose pose = held[first % kPlaces];
  const ToolPose& next = held[(first + 1) % kPlaces];
  pose.position += share * (next.position - pose.position);
  for (std::size_t j = 0; j < HandJointCount; ++j)
    pose.joints[j] += share * (next.joints[j] - pose.joints[j]);
  return pose;
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
  const std::vector<ToolPose> held = heldAround(grip, open, approach, 2 * hand.length());

  DeviceRecording trace;
  trace.info.name = "grasping hand";
  for (int i = 0; i < kEnd * kMomentsASecond; ++i) {
    const Gesture gesture = gestureAt(i / kMomentsASecond);
    DeviceState state;
    state.sequence = static_cast<std::uint64_t>(i) + 1;
    state.pose = heldAt(held, gesture.turns);
    state.pose.position += gesture.height * hand.length() * from;
    for (std::size_t j = 0; j < HandJointCount; ++j)
      state.pose.joints[j] += (1 - gesture.closed) * (open.joints[j] - state.pose.joints[j]);
    trace.moments.push_back({true, state});
  }
  return trace;
}

}  // namespace palpate::app
