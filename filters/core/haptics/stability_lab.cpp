// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/stability_lab.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <stdexcept>
#include <string>

#include "haptics/passivity.h"

namespace palpate {

namespace {

constexpr double kPi = 3.14159265358979323846;
// Amplitude over depth, along the press and across: the device stays inside, and in its place.
constexpr double kKick = 0.3, kSideKick = 0.03;
constexpr double kLargestSwing =
    0.5;  // root mean square over depth: it leaves the surface, or soon will
constexpr int kWindows = 16;
constexpr double kMostSeconds = 60;  // watched, for a device that is hardly damped
constexpr double kLeastRate = 10, kMostRate = 1e5;
constexpr double kDifference = 0.01;  ///< of the depth, by which stiffness is found
constexpr long kTicksPerReport = 1 << 14;

void require(bool good, const char* name, double value) {
  if (!good)
    throw std::invalid_argument("the lab's " + std::string(name) +
                                " is out of range: " + std::to_string(value));
}

/// Mean and spread of a motion over a window, axis by axis.
struct Window {
  void add(const Eigen::Vector3d& x) noexcept {
    ++count;
    sum += x;
    squares += x.cwiseAbs2();
    least = least.cwiseMin(x);
    most = most.cwiseMax(x);
  }
  Eigen::Vector3d mean() const noexcept { return sum / count; }
  /// Root mean square about the mean.
  Eigen::Vector3d swing() const noexcept {
    return (squares / count - mean().cwiseAbs2()).cwiseMax(0).cwiseSqrt();
  }
  Eigen::Vector3d halfRange() const noexcept { return (most - least) / 2; }

  long count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = sum;
  Eigen::Vector3d least = Eigen::Vector3d::Constant(HUGE_VAL), most = -least;
};

/// A simulated device at a model whose forces are scaled.
class Bench {
 public:
  Bench(TouchModel& model, const LabSettings& settings, double scale, const Progress& progress)
      : model_(model),
        settings_(settings),
        scale_(scale),
        progress_(progress),
        device_(settings.device) {
    model_.reset();
  }

  /// @return false if the model failed or the device left all bounds.
  bool tick(LabRun& result) {
    if (++ticks_ % kTicksPerReport == 0) progress_.report(0, "press");
    device_.read(state_);
    const Eigen::Vector3d& position = state_.pose.position;
    pose_.position = settings_.place + position;
    const ContactCertificate certificate = model_.step(&pose_, &wrench_);
    wrench_ = {scale_ * wrench_.force, Eigen::Vector3d::Zero()};
    observer_.advance(position);
    if (settings_.passivityControl && !wrench_.force.isZero(0)) result.dampedTicks += damp();
    last_ = position;
    observer_.hold(wrench_.force);
    device_.write(wrench_);
    result.leastEnergy = std::min(result.leastEnergy, observer_.energy());
    if (!certificate.failed && device_.position().allFinite()) return true;
    result.residual = HUGE_VAL;
    return false;
  }

  void kick(const Eigen::Vector3d& velocity) {
    device_.place(device_.position(), device_.velocity() + velocity);
  }

  const Eigen::Vector3d& position() const { return device_.position(); }

 private:
  bool damp() {
    const double period = settings_.device.period;
    const Eigen::Vector3d velocity = (state_.pose.position - last_) / period;
    const double damping = passivityDamping(observer_.contactEnergy(), velocity, period,
                                            settings_.device.mass / period);
    wrench_.force -= damping * velocity;
    return damping > 0;
  }

  TouchModel& model_;
  const LabSettings& settings_;
  double scale_;
  const Progress& progress_;
  long ticks_ = 0;
  SimulatedDevice device_;
  PassivityObserver observer_;
  DeviceState state_;
  ToolPose pose_;
  Wrench wrench_;
  Eigen::Vector3d last_ = Eigen::Vector3d::Zero();
};

/// Along the press, and a little along each axis of the stiffness that lies across.
/// @param press  its direction, by those axes.
Eigen::Vector3d kickOf(const Eigen::Vector3d& press) {
  Eigen::Vector3d kick = kKick * press;
  for (double& part : kick)
    if (std::abs(part) < kSideKick) part = kSideKick;
  return kick;
}

/// The model's stiffness matrix at a place that a tool has come to, by central differences.
Eigen::Matrix3d stiffnessAt(TouchModel& model, const ToolPose& pose, double difference) {
  Eigen::Matrix3d stiffness;
  for (int axis = 0; axis < 3; ++axis) {
    Wrench forces[2], back;
    for (int side : {0, 1}) {
      ToolPose moved = pose;
      moved.position[axis] += side == 0 ? -difference : difference;
      model.step(&moved, &forces[side]);
      model.step(&pose, &back);
    }
    stiffness.col(axis) = (forces[0].force - forces[1].force) / (2 * difference);
  }
  return stiffness;
}

/// The same where the tool comes to from there, pressed anew.
Eigen::Matrix3d stiffnessFrom(const ToolPose& pressed, const ToolPose& moved, TouchModel& model,
                              const Eigen::Vector3d& place, double difference) {
  ToolPose pose = pressed;
  Wrench wrench;
  model.reset();
  for (const Eigen::Vector3d& next : {place, pressed.position, moved.position}) {
    pose.position = next;
    model.step(&pose, &wrench);
  }
  return stiffnessAt(model, moved, difference);
}

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
  resistance_ = -wrench.force;
  pressStiffness_ = resistance_.dot(direction_) / settings.depth;
  const Eigen::Matrix3d stiffness = stiffnessAt(*model_, pose, kDifference * settings.depth);
  stiffness_ = stiffness.allFinite() ? stiffness.operatorNorm() : HUGE_VAL;
  if (!(pressStiffness_ > 0) || !(stiffness_ > 0) || !std::isfinite(stiffness_))
    throw std::invalid_argument(
        "the model does not resist the press: place and direction must lead into its surface");
  const Eigen::Matrix3d symmetric = (stiffness + stiffness.transpose()) / 2;
  modes_ = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(symmetric).eigenvectors();
  for (int axis = 0; axis < 3; ++axis)
    for (double way : {-kKick, kKick}) {
      ToolPose moved = pose;
      moved.position += way * settings.depth * modes_.col(axis);
      const Eigen::Matrix3d change =
          stiffnessFrom(pose, moved, *model_, settings.place, kDifference * settings.depth) -
          stiffness;
      variation_ = std::max(variation_, change.operatorNorm() / stiffness_);
    }
}

LabRun StabilityLab::run(double stiffness, const Progress& progress) const {
  require(stiffness > 0 && std::isfinite(stiffness), "stiffness", stiffness);
  const double mass = settings_.device.mass, period = settings_.device.period;
  const double damping = settings_.device.damping + settings_.device.hand.damping;
  const double scale = stiffness / stiffness_, along = scale * pressStiffness_;
  // At a relative distance e from the bound, swings shrink like exp(-e b t / 2m): long enough to
  // see a tolerance as a tenth, and some swings.
  const double swingSeconds = 2 * kPi * std::sqrt(mass / along);
  const double pressSeconds = std::max(20 * swingSeconds, 0.1);
  const double seconds =
      std::max(std::min(0.1 * 2 * mass / (settings_.tolerance * damping), kMostSeconds),
               kWindows * 4 * swingSeconds);
  const long press = std::lround(pressSeconds / period), watched = std::lround(seconds / period);

  LabSettings settings = settings_;
  const Eigen::Vector3d push =
      scale * resistance_ + settings.device.hand.stiffness * settings.depth * direction_;
  settings.device.hand.path = nullptr;
  settings.device.hand.push = [&](double t) -> Eigen::Vector3d {
    return t < pressSeconds ? 0.5 * (1 - std::cos(kPi * t / pressSeconds)) * push : push;
  };
  const Eigen::Vector3d kick =
      modes_ * kickOf(modes_.transpose() * direction_) * settings.depth * std::sqrt(along / mass);

  LabRun result;
  Bench bench(*model_, settings, scale, progress);
  for (long tick = 0; tick < press; ++tick)
    if (!bench.tick(result)) return result;
  bench.kick(kick);
  Eigen::Vector3d firstSwing = Eigen::Vector3d::Zero();
  for (int number = 0; number < kWindows; ++number) {
    Window window, pressed;
    for (long tick = number * watched / kWindows; tick < (number + 1) * watched / kWindows;
         ++tick) {
      if (!bench.tick(result)) return result;
      window.add(modes_.transpose() * bench.position());
      pressed.add(direction_.dot(bench.position()) * Eigen::Vector3d::UnitZ());
    }
    result.residual = window.halfRange().maxCoeff();
    const Eigen::Vector3d swing = window.swing();
    if (pressed.swing().z() > kLargestSwing * pressed.mean().z()) return result;
    if (number == 0) firstSwing = swing;
    result.stable = number == kWindows - 1 && ((swing.array() < firstSwing.array()).all() ||
                                               result.residual <= 2 * settings.device.quantum);
  }
  return result;
}

double StabilityLab::largestStable(const Progress& progress) const {
  const SimulatedDeviceSettings& device = settings_.device;
  double stable =
      servedStiffness(device.damping + device.hand.damping, device.period, device.delay);
  if (stable == 0) return 0;
  // The bound is a matter of factors of two for any delay: bracket, then bisect.
  double unstable = stable;
  const double least = std::ldexp(stable, -20), most = std::ldexp(stable, 20);
  while (!run(stable, progress).stable) {
    unstable = stable;
    stable /= 2;
    if (stable < least) return 0;
  }
  if (unstable == stable) do {
      stable = unstable;
      unstable *= 2;
      if (unstable > most) return HUGE_VAL;
    } while (run(unstable, progress).stable);
  while (unstable > (1 + settings_.tolerance) * stable) {
    const double middle = std::sqrt(stable * unstable);
    (run(middle, progress).stable ? stable : unstable) = middle;
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
        const Progress part = progress.part(points.size() / count, 1);
        part.report(0, "press");
        LabSettings here = settings;
        if (!(rate >= kLeastRate && rate <= kMostRate))
          throw std::invalid_argument("the lab's rates must be from 10 to 100000 Hz, not " +
                                      std::to_string(rate));
        here.device.period = 1 / rate;
        here.device.damping = damping;
        here.device.delay = delay;
        points.push_back({rate, damping, delay, StabilityLab(model, here).largestStable(part),
                          servedStiffness(damping, 1 / rate, delay)});
      }
  return points;
}

}  // namespace palpate
