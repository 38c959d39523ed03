// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "contact/unilateral_contact.h"
#include "haptics/touch_model.h"
#include "haptics/touch_tool.h"

namespace palpate {

/// A second elastic body in the scene, which stays where it is but for its deformation.
struct ElasticPartner {
  std::shared_ptr<const GreensFunctions> greens;
  std::shared_ptr<const SurfaceMesh> mesh;
  RigidPose pose;
  double friction = 0;
};

/// Tools with a shape of their own that touch one elastic surface by UnilateralContact, all coupled
/// through it, with force and torque for each. If they are to hold (setHolds), button 0 makes a
/// tool hold what it touches and comes to touch, so that it grips and pulls, until it is released.
class ToolTouch final : public TouchModel {
 public:
  static constexpr std::uint32_t kHolds = 1;  ///< the button's bit

  /// @param friction  Coulomb's mu between the surface and all tools.
  /// @param partners  other bodies that the surface meets; tools do not touch them.
  ///                  With Green's functions of all their free vertices: contacts slide to any.
  /// @throws std::invalid_argument as UnilateralContact, and without a tool.
  ToolTouch(std::shared_ptr<const GreensFunctions> greens, std::shared_ptr<const SurfaceMesh> mesh,
            std::vector<std::shared_ptr<const TouchTool>> tools, double friction,
            const UnilateralContactSettings& settings = {},
            const std::vector<ElasticPartner>& partners = {});

  int toolCount() const override { return static_cast<int>(tools_.size()); }
  /// Fails, without any force, where a point that comes near a tool lacks Green's functions.
  ContactCertificate step(const ToolPose* poses, Wrench* wrenches) noexcept override;
  void reset() noexcept override;
  ContactSnapshot makeSnapshot() const override;
  void fill(ContactSnapshot& snapshot) const noexcept override;

  /// Coulomb's mu of all tools, from the next step on. Any thread may set it, as often as it likes:
  /// the one set last holds.
  /// @throws std::invalid_argument unless it is at least 0 and finite.
  void setFriction(double friction);
  /// Whether torques are computed, as they are at first; otherwise they are zero, in snapshots too.
  void setTorques(bool computed) noexcept { torques_ = computed; }
  /// Whether tools hold the surface while their buttons are pressed; at first they do not.
  void setHolds(bool hold) noexcept { holds_ = hold; }
  /// By what all forces are scaled, as setFriction.
  /// @throws std::invalid_argument unless it is positive and finite.
  void setStiffnessScale(double scale);

  /// k_Rigid, N/m, by which fixed vertices yield; 0 for UnilateralContactSettings' choice; as
  /// setFriction.
  /// @throws std::invalid_argument unless it is at least 0 and finite.
  void setRigidStiffness(double stiffness);

  const UnilateralContact& contact() const noexcept { return contact_; }
  const TouchTool& tool(int tool) const { return *tools_[tool].tool; }
  /// What the surface does to one part of a tool, about the part's position.
  Wrench partWrench(int tool, int part) const noexcept;

 private:
  void takeOver() noexcept;
  void describe(ContactSnapshot& snapshot) const noexcept;
  struct Held {
    std::shared_ptr<const TouchTool> tool;
    int firstPart;  ///< among the obstacles
    ToolPose pose;
    Wrench wrench;  ///< of the last step
  };
  std::vector<Held> tools_;
  std::vector<RigidPose> poses_;  ///< of all obstacles
  UnilateralContact contact_;
  ContactCertificate certificate_;
  bool torques_ = true, holds_ = false;
  double friction_;  ///< as the contact has it

  // Handed over:
  std::atomic<double> wantedFriction_, wantedScale_{1}, wantedRigid_;
};

}  // namespace palpate
