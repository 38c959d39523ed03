// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>
#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "contact/contact_certificate.h"
#include "contact/wrench.h"
#include "haptics/haptic_device.h"

namespace palpate {

/// What one tool touches, for those who draw it: [JP01] fig. 8.
struct ToolContact {
  bool touching = false;
  ToolPose pose;
  /// On the tool, about its position.
  Wrench wrench = kNoWrench;
  int triangle = -1;  ///< of a contact at a point
  Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();
  Eigen::Vector3d staticPoint = Eigen::Vector3d::Zero();  ///< x^C
  Eigen::Vector3d hapticPoint = Eigen::Vector3d::Zero();  ///< x^H
  bool sliding = false;
};

/// What a probe inside the first body reads.
struct ProbeReading {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< m
  double vonMises = 0;                                     ///< Pa
  double gradient = 0;                              ///< spectral norm of the displacement gradient
  double largestVonMises = 0, largestGradient = 0;  ///< so far
  std::int64_t exceededTick = -1;  ///< at which a limit was first exceeded; -1 for never
};

/// A state of contact from which the whole deformation follows, for a slower thread: tools and the
/// forces on nodes (a node may occur more than once). Its vectors have their final size from
/// `TouchModel::makeSnapshot` on, so that filling one allocates nothing.
struct ContactSnapshot {
  std::uint64_t tick = 0;
  std::vector<ToolContact> tools;
  ContactCertificate certificate;
  int loadedCount = 0;            ///< of the entries below that hold
  std::vector<int> loadedBodies;  ///< which elastic body: 0, or another that meets the first
  std::vector<int> loadedNodes;   ///< its node
  /// What presses there: a part of a tool, numbered through all tools; -1: a point, another body.
  std::vector<int> loadedParts;
  std::vector<Eigen::Vector3d> loads;  ///< on the body, N
  std::vector<ProbeReading> probes;    ///< inside the first body, in the scene's order
};

/// What the servo loop evaluates in every tick: poses of the tools in, wrenches on them out.
class TouchModel {
 public:
  virtual ~TouchModel() = default;

  virtual int toolCount() const = 0;

  /// Advances the contact to new poses. Neither allocates, locks nor throws.
  /// @param poses    toolCount() of them, finite, in the scene's frame. A tool that is not there
  ///                 touches nothing; when it comes, a reset comes before.
  /// @param wrenches toolCount(), set to what the surface does to each tool, torque about its
  ///                 position. N, N m.
  virtual ContactCertificate step(const ToolPose* poses, Wrench* wrenches) noexcept = 0;

  /// Forgets all contact, as after a fault.
  virtual void reset() noexcept = 0;

  /// A snapshot with room for all this model will ever fill in.
  virtual ContactSnapshot makeSnapshot() const = 0;

  /// Fills in the state after the last step; all but `tick`. Allocates nothing.
  virtual void fill(ContactSnapshot& snapshot) const noexcept = 0;
};

}  // namespace palpate
