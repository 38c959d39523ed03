// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/servo_loop.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "haptics/servo_clock.h"

namespace palpate {

namespace {

// As a rotation's quaternion is written in single precision.
constexpr double kQuaternionError = 1e-6;

void requireSetting(bool good, const char* name, double value) {
  if (!good)
    throw std::invalid_argument("the servo loop's " + std::string(name) +
                                " is out of range: " + std::to_string(value));
}

void requireMapping(const WorkspaceMapping& mapping, std::size_t tool) {
  auto require = [tool](bool good, const char* what) {
    if (!good)
      throw std::invalid_argument("the workspace of tool " + std::to_string(tool) + " " + what);
  };
  require(std::abs(mapping.rotation.norm() - 1) <= kQuaternionError, "is turned by no rotation");
  require(mapping.scale > 0 && std::isfinite(mapping.scale), "has no positive scale");
  require(mapping.origin.allFinite(), "has an origin that is not a finite number");
  require(mapping.forceScale >= 0 && std::isfinite(mapping.forceScale),
          "has a negative forceScale");
}

template <class Count>
void increase(std::atomic<Count>& counter, Count by) noexcept {
  counter.store(counter.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
}

ServoSnapshot emptySnapshot(const TouchModel& model, std::size_t toolCount) {
  ServoSnapshot snapshot;
  snapshot.contact = model.makeSnapshot();
  snapshot.tools.assign(toolCount, {ToolPose(), kNoWrench, SafetyReport(), 0});
  return snapshot;
}

SafetySettings withinDevice(SafetySettings safety, const DeviceInfo& info) {
  safety.largestForce = std::min(safety.largestForce, info.largestForce);
  safety.largestTorque = std::min(safety.largestTorque, info.largestTorque);
  return safety;
}

}  // namespace

std::string ServoStatistics::table() const {
  return latencyTable({{"compute", &compute}, {"lateness", &lateness}});
}

ServoLoop::Stage::Stage(std::shared_ptr<TouchModel> touched, std::size_t toolCount)
    : model(std::move(touched)),
      poses(toolCount),
      wrenches(toolCount, kNoWrench),
      snapshots(emptySnapshot(*model, toolCount)) {}

ServoLoop::Hand::Hand(const ServoTool& held, double period)
    : tool(held),
      safety(withinDevice(held.safety, held.device->info()), period,
             held.device->info().reportRate) {}

ServoLoop::ServoLoop(std::shared_ptr<TouchModel> model, const std::vector<ServoTool>& tools,
                     const ServoSettings& settings)
    : settings_(settings), period_(1 / settings.rate) {
  requireSetting(settings.rate >= 250 && settings.rate <= 10000, "rate", settings.rate);
  requireSetting(settings.budget > 0 && std::isfinite(settings.budget), "budget", settings.budget);
  requireSetting(settings.snapshotTicks >= 1, "snapshotTicks", settings.snapshotTicks);
  requireSetting(settings.passivityDamping >= 0 && std::isfinite(settings.passivityDamping),
                 "passivityDamping", settings.passivityDamping);
  for (const ServoTool& tool : tools) {
    const std::size_t number = hands_.size();
    if (!tool.device)
      throw std::invalid_argument("tool " + std::to_string(number) + " has no device");
    requireMapping(tool.mapping, number);
    hands_.emplace_back(tool, period_);
  }
  stage_ = read_ = addStage(std::move(model));
}

ServoLoop::~ServoLoop() {
  stop();
  renderNothing();
}

ServoLoop::Stage* ServoLoop::addStage(std::shared_ptr<TouchModel> model) {
  if (!model) throw std::invalid_argument("there is no model to touch");
  if (model->toolCount() != static_cast<int>(hands_.size()))
    throw std::invalid_argument("the model is touched by " + std::to_string(model->toolCount()) +
                                " tools, and " + std::to_string(hands_.size()) + " are given");
  stages_.push_back(std::make_unique<Stage>(std::move(model), hands_.size()));
  stages_.back()->number = lastNumber_++;
  return stages_.back().get();
}

void ServoLoop::start() {
  if (isRunning()) return;
  thread_ = std::thread([this] { run(); });
}

void ServoLoop::stop() noexcept {
  if (!isRunning()) return;
  stopping_.store(true, std::memory_order_relaxed);
  thread_.join();
  stopping_.store(false, std::memory_order_relaxed);
}

void ServoLoop::runHeadless(std::int64_t ticks) {
  if (isRunning()) throw std::logic_error("the servo loop runs already: stop it first");
  for (std::int64_t t = 0; t < ticks; ++t) tick(1, false);
}

bool ServoLoop::pause(bool paused) noexcept {
  return commands_.post([paused](ServoLoop& loop) noexcept {
    if (loop.paused_ && !paused) loop.stage_->model->reset();
    loop.paused_ = paused;
  });
}

bool ServoLoop::reset() noexcept {
  return commands_.post([](ServoLoop& loop) noexcept { loop.stage_->model->reset(); });
}

bool ServoLoop::clearStatistics() noexcept {
  return commands_.post([](ServoLoop& loop) noexcept {
    ServoStatistics& s = loop.statistics_;
    for (auto* count : {&s.ticks, &s.missedTicks, &s.overruns, &s.overBudget, &s.truncated})
      count->store(0, std::memory_order_relaxed);
    s.compute.clear();
    s.lateness.clear();
  });
}

bool ServoLoop::setMapping(int tool, const WorkspaceMapping& mapping) {
  if (tool < 0 || tool >= static_cast<int>(hands_.size()))
    throw std::invalid_argument("there is no tool " + std::to_string(tool));
  requireMapping(mapping, tool);
  return commands_.post(
      [tool, mapping](ServoLoop& loop) noexcept { loop.hands_[tool].tool.mapping = mapping; });
}

void ServoLoop::setModel(std::shared_ptr<TouchModel> model) {
  Stage* const next = addStage(std::move(model));
  // One that the loop has not taken yet it never will.
  if (const Stage* skipped = pending_.exchange(next, std::memory_order_acq_rel))
    stages_.erase(std::find_if(stages_.begin(), stages_.end(),
                               [&](const auto& stage) { return stage.get() == skipped; }));
  releaseStages();
}

/// Frees what the loop has left behind, but what is being read.
void ServoLoop::releaseStages() {
  const std::uint64_t published = published_.load(std::memory_order_acquire);
  stages_.erase(std::remove_if(stages_.begin(), stages_.end(),
                               [&](const auto& stage) {
                                 return stage->number < published && stage.get() != read_;
                               }),
                stages_.end());
}

bool ServoLoop::update() {
  const std::uint64_t published = published_.load(std::memory_order_acquire);
  const auto newest = std::find_if(stages_.begin(), stages_.end(),
                                   [&](const auto& stage) { return stage->number == published; });
  if (!(*newest)->snapshots.update()) return false;
  read_ = newest->get();
  releaseStages();
  return true;
}

void ServoLoop::run() noexcept {
  renderNothing();
  if (settings_.realTime)
    statistics_.realTimeGranted.store(preferRealTime(settings_.processor),
                                      std::memory_order_relaxed);
  // Deadlines are begin + k periods, so that no rounding or delay adds up.
  const double period = 1e9 * period_;
  const std::int64_t begin = nowNanoseconds();
  auto deadline = [&](std::int64_t number) {
    return begin + std::llround(static_cast<double>(number) * period);
  };
  std::int64_t last = 0, next = 1;
  do {
    sleepUntil(deadline(next));
    const std::int64_t late = nowNanoseconds() - deadline(next);
    statistics_.lateness.record(late);
    const auto slept = static_cast<std::int64_t>(static_cast<double>(late) / period);
    next += slept;
    tick(next - last, true);
    last = next++;
    const std::int64_t behind = nowNanoseconds() - deadline(next);
    const std::int64_t overrun =
        behind < 0 ? 0 : 1 + static_cast<std::int64_t>(static_cast<double>(behind) / period);
    next += overrun;
    increase<std::int64_t>(statistics_.overruns, overrun > 0);
    increase<std::int64_t>(statistics_.missedTicks, slept + overrun);
  } while (forces_ || !stopping_.load(std::memory_order_relaxed));
  renderNothing();
}

/// @param periods  since the last tick began: 1, or more if some were missed.
/// @param timed    whether its time counts.
void ServoLoop::tick(std::int64_t periods, bool timed) noexcept {
  const std::int64_t begin = threadNanoseconds(), beginOnClock = nowNanoseconds();
  const double elapsed = static_cast<double>(periods) * period_;
  if (Stage* stage = pending_.exchange(nullptr, std::memory_order_acq_rel)) stage_ = stage;
  commands_.takeAll(*this);
  ++tick_;

  readHands(elapsed);
  ForceSafety::Request request;
  request.paused = paused_ || stopping_.load(std::memory_order_relaxed);
  if (!paused_)
    request.certificate = stage_->model->step(stage_->poses.data(), stage_->wrenches.data());
  request.late =
      timed && 1e-9 * static_cast<double>(threadNanoseconds() - begin) > settings_.budget * period_;
  if (timed) request.taken = 1e-9 * static_cast<double>(nowNanoseconds() - beginOnClock);
  writeHands(request, elapsed);
  if (tick_ % settings_.snapshotTicks == 0) publish();

  statistics_.compute.record(threadNanoseconds() - begin);
  increase<std::int64_t>(statistics_.overBudget, request.late);
  increase<std::int64_t>(statistics_.truncated, request.certificate.truncated);
  increase<std::int64_t>(statistics_.ticks, 1);
}

void ServoLoop::readHands(double elapsed) noexcept {
  bool anew = false;
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    Hand& hand = hands_[h];
    const bool present = hand.tool.device->read(hand.state);
    hand.pose = hand.safety.admit(present, hand.state, elapsed);
    if (hand.safety.startsAnew()) {
      hand.observer.interrupt();
      hand.velocity.restart();
      anew = true;
    }
    hand.velocity.advance(hand.state.sequence, hand.pose.position, elapsed);
    hand.observer.advance(hand.pose.position);
    stage_->poses[h] = hand.tool.mapping.toScene(hand.pose);
  }
  if (anew) stage_->model->reset();
}

/// @param request  for every hand; what each wants is filled in here.
void ServoLoop::writeHands(ForceSafety::Request request, double elapsed) noexcept {
  forces_ = false;
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    Hand& hand = hands_[h];
    request.wanted = hand.tool.mapping.toDevice(stage_->wrenches[h]);
    const Eigen::Vector3d velocity = hand.velocity.value();
    if (settings_.passivityDamping > 0 && !request.wanted.force.isZero(0))
      request.wanted.force -= passivityDamping(hand.observer.contactEnergy(), velocity, period_,
                                               settings_.passivityDamping) *
                              velocity;
    const Wrench& rendered = hand.safety.limit(request, elapsed);
    hand.observer.hold(rendered.force);
    hand.safety.delivered(hand.tool.device->write(rendered));
    hand.rendered = rendered;
    forces_ = forces_ || !rendered.force.isZero(0) || !rendered.torque.isZero(0);
  }
}

void ServoLoop::publish() noexcept {
  ServoSnapshot& snapshot = stage_->snapshots.writable();
  stage_->model->fill(snapshot.contact);
  snapshot.contact.tick = tick_;
  snapshot.paused = paused_;
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    const Hand& hand = hands_[h];
    snapshot.tools[h] = {hand.pose, hand.rendered, hand.safety.report(), hand.observer.energy()};
  }
  stage_->snapshots.publish();
  published_.store(stage_->number, std::memory_order_release);
}

void ServoLoop::renderNothing() noexcept {
  for (Hand& hand : hands_) hand.tool.device->write(kNoWrench);
}

}  // namespace palpate
