// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

namespace palpate {

/// The largest stiffness a device can serve without putting out energy: K <= b / (T/2 + T d)
/// (Colgate & Schenkel 1994 with no virtual damping, b > K T/2; d ticks of delay add K T d).
/// @param damping  b of the device, N s/m.
/// @param period   T of the loop, s.
/// @param delay    d, ticks from the force's computation to its effect.
/// @return N/m.
/// @throws std::invalid_argument if one is not finite, damping or delay negative, period not
///         positive.
double servedStiffness(double damping, double period, int delay);

/// Counts the energy between a hand and the loop from positions and forces alone (Hannaford & Ryu
/// 2002, eq. 6). A force is held from one tick to the next, so each term -f (x' - x) is exact
/// (Stramigioli et al. 2005), up to the position's quantisation and the delay of the force.
class PassivityObserver {
 public:
  /// Ends the time over which the last force was held.
  /// @param position  now, m.
  void advance(const Eigen::Vector3d& position) noexcept;

  /// @param force  on the hand from now on, N. No force ends a contact.
  void hold(const Eigen::Vector3d& force) noexcept;

  /// Forgets place and force, as when the device has not reported for a while; keeps the energies.
  void interrupt() noexcept { hasPosition_ = false; }

  /// What the hand has put in since the start less what it got back, J. Below zero, the loop has
  /// made energy.
  double energy() const noexcept { return energy_; }
  /// The same since the force was last zero, J.
  double contactEnergy() const noexcept { return contactEnergy_; }

 private:
  bool hasPosition_ = false;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero(), force_ = Eigen::Vector3d::Zero();
  double energy_ = 0, contactEnergy_ = 0;
};

/// Coefficient of the damping that takes back, over the next tick, the energy that a contact has
/// made: -E / (T |v|^2) (Hannaford & Ryu 2002, eq. 10).
/// @param energy   contactEnergy, J.
/// @param velocity of the hand, m/s.
/// @param period   s.
/// @param largest  N s/m; beyond mass / period a sampled damper is itself unstable.
/// @return 0 to `largest`, N s/m; 0 while energy is not negative or the hand is at rest.
double passivityDamping(double energy, const Eigen::Vector3d& velocity, double period,
                        double largest) noexcept;

}  // namespace palpate
