// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "haptics/command_ring.h"
#include "haptics/force_safety.h"
#include "haptics/latest_value.h"
#include "haptics/passivity.h"
#include "haptics/report_velocity.h"
#include "haptics/servo_report.h"
#include "haptics/touch_model.h"
#include "haptics/workspace_mapping.h"

namespace palpate {

/// A hand in the scene: what it holds, where that moves, and what may be done to it.
struct ServoTool {
  std::shared_ptr<HapticDevice> device;
  WorkspaceMapping mapping;
  /// In the device's own newtons; cut to what DeviceInfo says it renders.
  SafetySettings safety;
};

struct ServoSettings {
  double rate = 1000;  ///< Hz, 250 to 10000
  /// Share of a period that a tick may compute; 20 (SafetySettings::lateSolves) longer ones in a
  /// row are a fault. Judged by the thread's own computing time, and only on the real clock. By the
  /// clock itself a tick that takes 20 periods, or begins 20 after the last, is the same fault.
  double budget = 0.7;
  int snapshotTicks = 1;  ///< a snapshot is published every so many ticks
  /// N s/m in the device's frame, the most that passivityDamping may add against energy that a
  /// contact makes; 0 for none. Mass over period is a device's own limit.
  double passivityDamping = 0;
  bool realTime = true;  ///< preferRealTime
  int processor = -1;    ///< to run on, any if negative
};

/// Drives devices through a model: reads their poses, evaluates the contact itself, and writes
/// forces, in a thread of its own on absolute deadlines or, without one, on virtual time.
///
/// A tick takes no lock, allocates nothing and throws nothing, and no other thread can hold it up.
/// One other thread, which made the loop, may call its methods; statistics() is open to all.
class ServoLoop {
 public:
  /// A tool is not there for the model until its device has reported a pose that is valid.
  /// @param model  not touched by others while it is in the loop.
  /// @param tools  one for each of the model's, in its order.
  /// @throws std::invalid_argument if model or a device is missing, their numbers differ, or a
  ///         setting or mapping is out of range.
  ServoLoop(std::shared_ptr<TouchModel> model, const std::vector<ServoTool>& tools,
            const ServoSettings& settings = {});

  /// Stops it.
  ~ServoLoop();

  /// Renders zero and starts the thread; nothing if it runs.
  /// @throws std::system_error if there is no thread to be had.
  void start();

  /// Fades the forces to zero, ends the thread and renders zero; within the longest fadeSeconds and
  /// three periods, but for the system's delays.
  void stop() noexcept;

  bool isRunning() const noexcept { return thread_.joinable(); }

  /// Ticks on virtual time in the calling thread: with devices that repeat themselves, bit for bit
  /// the same each time. Forces of the last tick stay in the devices.
  /// @throws std::logic_error while the thread runs.
  void runHeadless(std::int64_t ticks);

  /// Fades the forces to zero and leaves the model alone until resumed with a ramp.
  /// @return false, as all that follow, if too many commands wait for a tick; nothing happens then.
  bool pause(bool paused) noexcept;

  /// Lets the model forget all contact.
  bool reset() noexcept;

  bool clearStatistics() noexcept;

  /// @param tool  its number.
  /// @throws std::invalid_argument if there is no such tool or the mapping is out of range.
  bool setMapping(int tool, const WorkspaceMapping& mapping);

  /// Calls command(TouchModel&), which is noexcept, small and owns nothing, between two ticks.
  template <class Command>
  bool post(const Command& command) noexcept {
    static_assert(std::is_nothrow_invocable_v<const Command&, TouchModel&>);
    return commands_.post([command](ServoLoop& loop) noexcept { command(*loop.stage_->model); });
  }

  /// Touches another model from the next tick on. The former one is released by the calling thread,
  /// in a later call of this or update().
  /// @throws std::invalid_argument if it is missing or has another number of tools.
  void setModel(std::shared_ptr<TouchModel> model);

  /// Lets latest() be the newest snapshot.
  /// @return whether there was a newer one.
  bool update();
  const ServoSnapshot& latest() const noexcept { return read_->snapshots.latest(); }

  const ServoStatistics& statistics() const noexcept { return statistics_; }
  double period() const noexcept { return period_; }  ///< s

 private:
  /// A model and all whose size depends on it.
  struct Stage {
    Stage(std::shared_ptr<TouchModel> touched, std::size_t toolCount);
    std::uint64_t number = 0;
    std::shared_ptr<TouchModel> model;
    std::vector<ToolPose> poses;
    std::vector<Wrench> wrenches;
    LatestValue<ServoSnapshot> snapshots;
  };
  struct Hand {
    Hand(const ServoTool& held, double period);
    ServoTool tool;
    ForceSafety safety;
    PassivityObserver observer;
    DeviceState state;
    ToolPose pose;  ///< the last valid one
    ReportVelocity velocity;
    Wrench rendered = kNoWrench;
  };

  Stage* addStage(std::shared_ptr<TouchModel> model);
  void releaseStages();
  void run() noexcept;
  void tick(std::int64_t periods, bool timed) noexcept;
  void readHands(double elapsed) noexcept;
  void writeHands(ForceSafety::Request request, double elapsed) noexcept;
  void publish() noexcept;
  void renderNothing() noexcept;

  // The loop's own while it runs.
  ServoSettings settings_;
  double period_;
  std::vector<Hand> hands_;
  Stage* stage_;
  bool paused_ = false, forces_ = false;  ///< forces_: whether any hand feels one
  std::uint64_t tick_ = 0;

  // Between the threads.
  CommandRing<ServoLoop> commands_;
  std::atomic<Stage*> pending_{nullptr};
  std::atomic<std::uint64_t> published_{0};  ///< number of the stage last published from
  std::atomic<bool> stopping_{false};
  ServoStatistics statistics_;

  // The caller's own.
  std::vector<std::unique_ptr<Stage>> stages_;  ///< by number, from the one read on
  Stage* read_;
  std::uint64_t lastNumber_ = 0;
  std::thread thread_;
};

}  // namespace palpate
