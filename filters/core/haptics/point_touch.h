// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

#include "contact/point_coupling.h"
#include "contact/sliding_contact.h"
#include "haptics/touch_model.h"
#include "linear_algebra/anderson_mixing.h"

namespace palpate {

/// Tips of probes that touch one elastic body, each as a SlidingContact. Button 0 makes a probe
/// that touches adhere, so that it pulls.
///
/// Probes that touch feel each other ([JP01] section 5.3): the forces of the others displace the
/// surface by d_i = sum over j of C_ij f_j at a probe's contact (PointCoupling), and its own force
/// is K^H (x^H - d - x^C). A tick sweeps over the probes (Gauss-Seidel), each from where the tick
/// before left it, until no force changes by more than kTolerance of the largest, or kMostSweeps
/// times; the next tick goes on from there. (Slips are settled to 1e-6 of a force, which can keep
/// sweeps from the tolerance: the certificate tells.) Where only one touches there is nothing to
/// sweep.
///
/// Continuity. SlidingContact's bound holds for each, with its own step and that of d_i: for two,
/// with b_i = |K_i| (|step of x^H_i| + relaxation) + |K_i| |change of C_ij| |f_j| and q the product
/// |K_1| |K_2| |C_12|^2, once the sweeps have converged and if q < 1,
///     |change of f_1| <= (b_1 + |K_1| |C_12| b_2) / (1 - q), and likewise for the other.
///
/// Energy. On a closed path of all probes two give back at most what each would alone, by x^H - d,
/// and besides that
///     sum over ticks of |f_1(t)^T dC f_2(t+1) + f_1(t+1)^T dC f_2(t)| / 2:
/// nothing where both stick, and otherwise what the coupling varies by along the way.
///
/// The servo thread calls what TouchModel declares. Friction and stiffness may be changed by any
/// other thread meanwhile, without a recomputation of Green's functions: the servo thread takes
/// them over between two ticks and spreads a change of stiffness over SlidingContact::kBlendTicks.
class PointTouch final : public TouchModel {
 public:
  static constexpr std::uint32_t kAdheres = 1;  ///< the button's bit
  static constexpr double kTolerance = 1e-9;
  static constexpr int kMostSweeps = 24;

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
  /// Points feel no torque. The certificate's residual is the last sweep's change of a force over
  /// the largest, its iterations are sweeps, or slips of one contact if these are more.
  ContactCertificate step(const ToolPose* poses, Wrench* wrenches) noexcept override;
  void reset() noexcept override;
  /// With room for a force on every node.
  ContactSnapshot makeSnapshot() const override;
  /// Each node that bears a force is listed once.
  void fill(ContactSnapshot& snapshot) const noexcept override;

  /// A tool's contact, for the servo thread.
  const SlidingContact& contact(int tool) const { return tools_[tool]; }
  /// d: what the other tools' forces displaced the surface by there in the last step, m.
  const Eigen::Vector3d& shift(int tool) const { return tried_[tool].shift; }

 private:
  struct Version {
    std::shared_ptr<const SurfaceStiffness> stiffness;
    long number;
  };
  /// A contact while a tick sweeps.
  struct Tried {
    SlidingState before;
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
    bool isShifted = false;  ///< whether it has a place in this tick at which others are felt
  };
  void takeOver() noexcept;
  void advanceTogether() noexcept;
  double sweep(bool isFirst) noexcept;
  void load(const SlidingContact& contact, ContactSnapshot& snapshot) const noexcept;

  // The servo thread's:
  std::vector<SlidingContact> tools_;
  std::vector<ToolPose> poses_;
  PointCoupling coupling_;
  std::vector<Tried> tried_;
  Eigen::VectorXd forces_, guess_;  ///< of the last sweep; what it began with
  AndersonMixing mixing_;
  ContactCertificate certificate_;
  bool isPartial_;  ///< whether free nodes lack Green's functions
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
