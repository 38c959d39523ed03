// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/stability_lab.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "haptics/passivity.h"

namespace palpate {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kKick = 0.3;          // amplitude over depth: the device stays inside
constexpr double kLargestSwing = 0.5;  // root mean square over depth: it leaves, or soon will
constexpr int kWindows = 16;

void require(bool good, const char* name, double value) {
  if (!good)
    throw std::invalid_argument("the lab's " + std::string(name) +
                                " is out of range: " + std::to_string(value));
}

/// Mean and spread of a motion over a window.
struct Window {
  void add(const Eigen::Vector3d& x) noexcept {
    ++count;
    sum += x;
    squares += x.squaredNorm();
    least = least.cwiseMin(x);
    most = most.cwiseMax(x);
  }
  Eigen::Vector3d mean() const noexcept { return sum / count; }
  double swing() const noexcept {
    return std::sqrt(std::max(0.0, squares / count - mean().squaredNorm()));
  }
  double halfRange() const noexcept { return (most - least).maxCoeff() / 2; }

  long count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares = 0;
  Eigen::Vector3d least = Eigen::Vector3d::Constant(HUGE_VAL), most = -least;
};

}  // namespace

StabilityLab::StabilityLab(TouchModel& model, const LabSettings& settings)
    : model_(&model), settings_(settings), direction_(settings.direction.stableNormalized()) {
  require(model.toolCount() == 1, "number of tools", model.toolCount());
  require(settings.place.allFinite(), "place", settings.place.sum());
  require(direction_.allFinite() && !direction_.isZero(), "direction", settings.direction.norm());
  require(settings.depth > 0 && std::isfinite(settings.depth), "depth", settings.depth);
  require(settings.tolerance > 0 && settings.tolerance < 1, "tolerance", settings.tolerance);
  SimulatedDevice tried(settings.device);

  ToolPose pose;
  pose.position = settings.place;
  Wrench wrench;
  model_->reset();
  model_->step(&pose, &wrench);
  pose.position += settings.depth * direction_;
  model_->step(&pose, &wrench);
  stiffness_ = -wrench.force.dot(direction_) / settings.depth;
  if (!(stiffness_ > 0) || !std::isfinite(stiffness_))
    throw std::invalid_argument(
        "the model does not resist the press: place and direction must lead into its surface");
}

LabRun StabilityLab::run(double stiffness) const {
  const double mass = settings_.device.mass, period = settings_.device.period;
  const double damping = settings_.device.damping + settings_.device.hand.damping;
  // At a relative distance e from the bound, swings shrink like exp(-e b t / 2m): long enough to
  // see a tolerance as a tenth, and some swings.
  const double swingSeconds = 2 * kPi * std::sqrt(mass / stiffness);
  const double pressSeconds = std::max(20 * swingSeconds, 0.1);
  const double seconds =
      std::max(0.1 * 2 * mass / (settings_.tolerance * damping), kWindows * 4 * swingSeconds);
  const long press = std::lround(pressSeconds / period), watched = std::lround(seconds / period);

  SimulatedDeviceSettings settings = settings_.device;
  const Eigen::Vector3d push = (stiffness + settings.hand.stiffness) * settings_.depth * direction_;
  settings.hand.path = nullptr;
  settings.hand.push = [&](double t) -> Eigen::Vector3d {
    return t < pressSeconds ? 0.5 * (1 - std::cos(kPi * t / pressSeconds)) * push : push;
  };
  SimulatedDevice device(settings);

  LabRun result;
  PassivityObserver observer;
  model_->reset();
  ToolPose pose;
  Wrench wrench;
  DeviceState state;
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  double firstSwing = 0;
  Window window;
  for (long tick = 0; tick < press + watched; ++tick) {
    device.read(state);
    pose.position = settings_.place + state.pose.position;
    const ContactCertificate certificate = model_->step(&pose, &wrench);
    wrench.force *= stiffness / stiffness_;
    wrench.torque.setZero();
    observer.advance(state.pose.position);
    if (settings_.passivityControl) {
      const Eigen::Vector3d velocity = (state.pose.position - last) / period;
      const double served =
          passivityDamping(observer.contactEnergy(), velocity, period, mass / period);
      if (!wrench.force.isZero(0) && served > 0) {
        wrench.force -= served * velocity;
        ++result.dampedTicks;
      }
    }
    last = state.pose.position;
    observer.hold(wrench.force);
    device.write(wrench);
    result.leastEnergy = std::min(result.leastEnergy, observer.energy());
    if (!device.position().allFinite() || certificate.failed) {
      result.residual = HUGE_VAL;
      return result;
    }

    if (tick == press)
      device.place(
          device.position(),
          device.velocity() + kKick * settings_.depth * std::sqrt(stiffness / mass) * direction_);
    if (tick < press) continue;
    window.add(device.position());
    const long number = (tick - press) * kWindows / watched;
    if ((tick + 1 - press) * kWindows / watched == number) continue;
    result.residual = window.halfRange();
    const double swing = window.swing();
    if (swing > kLargestSwing * window.mean().dot(direction_)) return result;
    if (number == 0) firstSwing = swing;
    if (number == kWindows - 1)
      result.stable = swing < firstSwing || window.halfRange() <= 2 * settings.quantum;
    window = Window();
  }
  return result;
}

double StabilityLab::largestStable() const {
  const SimulatedDeviceSettings& device = settings_.device;
  double stable =
      servedStiffness(device.damping + device.hand.damping, device.period, device.delay);
  if (stable == 0) return 0;
  // The bound is a matter of factors of two for any delay: bracket, then bisect.
  double unstable = stable;
  const double least = std::ldexp(stable, -20), most = std::ldexp(stable, 20);
  while (!run(stable).stable) {
    unstable = stable;
    stable /= 2;
    if (stable < least) return 0;
  }
  if (unstable == stable) do {
      stable = unstable;
      unstable *= 2;
      if (unstable > most) return HUGE_VAL;
    } while (run(unstable).stable);
  while (unstable > (1 + settings_.tolerance) * stable) {
    const double middle = std::sqrt(stable * unstable);
    (run(middle).stable ? stable : unstable) = middle;
  }
  return std::sqrt(stable * unstable);
}

std::vector<ZWidthPoint> zWidth(TouchModel& model, const LabSettings& settings,
                                const std::vector<double>& rates,
                                const std::vector<double>& dampings, const std::vector<int>& delays,
                                const Progress& progress) {
  std::vector<ZWidthPoint> points;
  const double count = static_cast<double>(rates.size() * dampings.size() * delays.size());
  for (double rate : rates)
    for (double damping : dampings)
      for (int delay : delays) {
        progress.report(points.size() / count, "press");
        LabSettings here = settings;
        require(rate > 0 && std::isfinite(rate), "rate", rate);
        here.device.period = 1 / rate;
        here.device.damping = damping;
        here.device.delay = delay;
        points.push_back({rate, damping, delay, StabilityLab(model, here).largestStable(),
                          servedStiffness(damping, 1 / rate, delay)});
      }
  return points;
}

}  // namespace palpate
