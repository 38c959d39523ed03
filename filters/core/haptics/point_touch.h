// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

#include "contact/sliding_contact.h"
#include "haptics/touch_model.h"

namespace palpate {

/// Tips of probes that touch one elastic body, each as a SlidingContact. Button 0 makes a probe
/// that touches adhere, so that it pulls.
///
/// Several probes do not feel each other: the force of each is that of the body which it alone
/// deforms. Their deformations add in what is drawn.
///
/// The servo thread calls what TouchModel declares. Friction and stiffness may be changed by any
/// other thread meanwhile, without a recomputation of Green's functions: the servo thread takes
/// them over between two ticks and spreads a change of stiffness over SlidingContact::kBlendTicks.
class PointTouch final : public TouchModel {
 public:
  static constexpr std::uint32_t kAdheres = 1;  ///< the button's bit

  /// @param friction  Coulomb's mu.
  /// @throws std::invalid_argument for a tool count below 1, and as setFriction.
  PointTouch(std::shared_ptr<const SurfaceStiffness> stiffness, int toolCount, double friction);
  ~PointTouch() override;

  /// @throws std::invalid_argument unless mu is at least 0 and finite.
  void setFriction(double mu);
  double friction() const noexcept { return friction_.load(std::memory_order_relaxed); }

  /// Touches another stiffness of the same mesh from now on: one made with another mask from the
  /// same Green's functions, or this one's withRigidStiffness or withYoungsModulus. Frees what the
  /// servo thread has done with.
  /// @throws std::invalid_argument for another mesh.
  void setStiffness(std::shared_ptr<const SurfaceStiffness> stiffness);
  /// The one set last.
  std::shared_ptr<const SurfaceStiffness> stiffness() const;

  int toolCount() const override { return static_cast<int>(tools_.size()); }
  ContactCertificate step(const ToolPose* poses, Wrench* wrenches) noexcept override;
  void reset() noexcept override;
  /// With room for a force on every node.
  ContactSnapshot makeSnapshot() const override;
  /// Each node that bears a force is listed once.
  void fill(ContactSnapshot& snapshot) const noexcept override;

  /// A tool's contact, for the servo thread.
  const SlidingContact& contact(int tool) const { return tools_[tool]; }

 private:
  struct Version {
    std::shared_ptr<const SurfaceStiffness> stiffness;
    long number;
  };
  void takeOver() noexcept;
  void load(const SlidingContact& contact, ContactSnapshot& snapshot) const noexcept;

  // The servo thread's:
  std::vector<SlidingContact> tools_;
  std::vector<ToolPose> poses_;
  ContactCertificate certificate_;
  const Version* current_;
  mutable std::vector<int> slotOfNode_;  ///< of a node in the snapshot being filled, or -1

  // Handed over:
  std::atomic<double> friction_{0};
  std::atomic<const Version*> wanted_;
  std::atomic<long> oldestInUse_{0};

  // The other threads':
  mutable std::mutex changing_;
  std::deque<std::unique_ptr<const Version>> versions_;
};

}  // namespace palpate
