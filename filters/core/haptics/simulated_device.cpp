// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/simulated_device.h"

#include <cmath>
#include <stdexcept>
#include <unsupported/Eigen/MatrixFunctions>

namespace palpate {

static void require(bool good, const char* name, double value) {
  if (!good)
    throw std::invalid_argument("the simulated device's " + std::string(name) +
                                " is out of range: " + std::to_string(value));
}

static bool isNotNegative(double value) {
  return value >= 0 && std::isfinite(value);
}

SimulatedDevice::SimulatedDevice(const SimulatedDeviceSettings& settings) : settings_(settings) {
  const SimulatedDeviceSettings& s = settings_;
  require(s.mass > 0 && std::isfinite(s.mass), "mass", s.mass);
  require(isNotNegative(s.damping), "damping", s.damping);
  require(s.period > 0 && std::isfinite(s.period), "period", s.period);
  require(s.delay >= 0, "delay", s.delay);
  require(isNotNegative(s.quantum), "quantum", s.quantum);
  require(isNotNegative(s.largestForce), "largestForce", s.largestForce);
  require(isNotNegative(s.hand.stiffness), "hand's stiffness", s.hand.stiffness);
  require(isNotNegative(s.hand.damping), "hand's damping", s.hand.damping);
  info_.name = "simulated device";
  info_.largestForce = s.largestForce > 0 ? s.largestForce : HUGE_VAL;
  info_.reportRate = 1 / s.period;
  forces_.assign(s.delay + 1, Eigen::Vector3d::Zero());

  // Distance, velocity and a constant force, in one exponential (Van Loan 1978).
  Eigen::Matrix3d rates = Eigen::Matrix3d::Zero();
  rates(0, 1) = 1;
  rates.row(1) << -s.hand.stiffness, -(s.damping + s.hand.damping), 1;
  rates.row(1) /= s.mass;
  const Eigen::Matrix3d over = (s.period * rates).exp();
  transition_ = over.topLeftCorner<2, 2>();
  response_ = over.topRightCorner<2, 1>();
}

void SimulatedDevice::place(const Eigen::Vector3d& position,
                            const Eigen::Vector3d& velocity) noexcept {
  position_ = position;
  velocity_ = velocity;
}

/// From read tick_ - 1 to the next one.
void SimulatedDevice::advance() noexcept {
  const SimulatedHand& hand = settings_.hand;
  const double now = time(), next = now + settings_.period;
  const Eigen::Vector3d from = hand.path ? hand.path(now) : Eigen::Vector3d(0, 0, 0);
  const Eigen::Vector3d to = hand.path ? hand.path(next) : Eigen::Vector3d(0, 0, 0);
  const Eigen::Vector3d speed = (to - from) / settings_.period;
  // The force of the tick `delay` ago. In y = x - x_h, m y'' = f - b x_h' - k_h y - (b + b_h) y'.
  Eigen::Vector3d force = forces_[tick_ % forces_.size()] - settings_.damping * speed;
  if (hand.push) force += hand.push(now);
  const Eigen::Vector3d distance = position_ - from, drift = velocity_ - speed;
  position_ = to + transition_(0, 0) * distance + transition_(0, 1) * drift + response_[0] * force;
  velocity_ =
      speed + transition_(1, 0) * distance + transition_(1, 1) * drift + response_[1] * force;
}

bool SimulatedDevice::read(DeviceState& state) noexcept {
  if (tick_ > 0) advance();
  ++tick_;
  // Until something is written the last force goes on.
  const std::size_t size = forces_.size();
  forces_[(tick_ + size - 1) % size] = forces_[(tick_ + 2 * size - 2) % size];
  state.sequence = tick_;
  state.pose = ToolPose();
  state.pose.position = position_;
  if (settings_.quantum > 0)
    state.pose.position =
        settings_.quantum * (position_ / settings_.quantum).array().round().matrix();
  return true;
}

bool SimulatedDevice::write(const Wrench& wrench) noexcept {
  const double length = wrench.force.norm(), largest = info_.largestForce;
  const std::size_t size = forces_.size();
  forces_[(tick_ + size - 1) % size] =
      length > largest ? Eigen::Vector3d(largest / length * wrench.force) : wrench.force;
  return true;
}

}  // namespace palpate
