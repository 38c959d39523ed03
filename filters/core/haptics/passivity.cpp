// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/passivity.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {

double servedStiffness(double damping, double period, int delay) {
  if (!(damping >= 0) || !std::isfinite(damping))
    throw std::invalid_argument("a device's damping must not be negative: " +
                                std::to_string(damping));
  if (!(period > 0) || !std::isfinite(period))
    throw std::invalid_argument("a loop's period must be positive: " + std::to_string(period));
  if (delay < 0)
    throw std::invalid_argument("a delay must not be negative: " + std::to_string(delay));
  return damping / (period / 2 + period * delay);
}

void PassivityObserver::advance(const Eigen::Vector3d& position) noexcept {
  if (hasPosition_) {
    const double work = -force_.dot(position - position_);
    energy_ += work;
    contactEnergy_ += work;
  }
  position_ = position;
  hasPosition_ = true;
}

void PassivityObserver::hold(const Eigen::Vector3d& force) noexcept {
  force_ = force;
  if (force.isZero(0)) contactEnergy_ = 0;
}

double passivityDamping(double energy, const Eigen::Vector3d& velocity, double period,
                        double largest) noexcept {
  const double rate = velocity.squaredNorm() * period;
  if (!(energy < 0) || !(rate > 0)) return 0;
  return std::min(largest, -energy / rate);
}

}  // namespace palpate
