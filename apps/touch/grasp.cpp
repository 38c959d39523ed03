// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <model_arrays.h>
#include <read_files.h>
#include <vtkCamera.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <memory>
#include <stdexcept>
#include <utility>

#include "haptics/device_recording.h"
#include "haptics/glove_device.h"
#include "haptics/hand_tool.h"
#include "haptics/snapshot_deformation.h"
#include "haptics/tool_touch.h"
#include "picture/picture.h"
#include "picture/virtual_display.h"
#include "touch/grasp_motion.h"
#include "touch/grasp_tally.h"
#include "touch/touch_window.h"
#include "touch/window.h"
#include "touch_view.h"

namespace palpate::app {
namespace {

constexpr double kFrameSeconds = 0.032;  ///< of the hand's motion
constexpr double kUnstatedRate = 1000;  ///< moments a second, of a recording that does not state it
constexpr int kDefaultFrames = 120;     ///< of the hand that closes by itself
constexpr double kHandOverModel = 1.65;  ///< length of the hand, over the extent along its fingers
constexpr double kFarther = 0.78;        ///< than a picture of the body alone: the hand is larger

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A glove's trace and how much of it passes from frame to frame.
struct Replay {
  DeviceRecording trace;
  int momentsAFrame, frames;
};

/// @throws std::invalid_argument for a moment that places the hand nowhere.
DeviceRecording finiteRecording(const std::string& path) {
  DeviceRecording recording = readDeviceRecording(path);
  if (std::none_of(recording.moments.begin(), recording.moments.end(),
                   [](const DeviceMoment& moment) { return moment.isThere; }))
    throw std::invalid_argument("in '" + path + "' the glove is never there");
  for (std::size_t i = 0; i < recording.moments.size(); ++i) {
    const auto& [isThere, state] = recording.moments[i];
    const ToolPose& pose = state.pose;
    const bool isPlaced = pose.position.allFinite() &&
                          std::abs(pose.orientation.norm() - 1) < 1e-3 &&
                          std::all_of(pose.joints.begin(), pose.joints.begin() + pose.jointCount,
                                      [](double angle) { return std::isfinite(angle); });
    if (isThere && !isPlaced)
      throw std::invalid_argument("moment " + std::to_string(i) + " of '" + path +
                                  "' holds numbers that are not finite, or no rotation");
  }
  return recording;
}

Replay replayOf(const TouchOptions& options, const SceneBody& body, const GraspApproach& approach,
                const HandModel& hand) {
  Replay replay;
  double rate = kMomentsASecond;
  if (options.device == "mouse") {
    replay.trace = graspMotion(body, approach, hand);
  } else if (options.device.rfind("scripted:", 0) == 0) {
    replay.trace = finiteRecording(options.device.substr(9));
    rate = replay.trace.rate > 0 ? replay.trace.rate : kUnstatedRate;
    if (rate * kFrameSeconds < 1)
      throw std::invalid_argument(
          "the recording has fewer moments a second than the grasp has frames, 31");
  } else {
    throw std::invalid_argument("a grasp needs a glove's recording: --device scripted:FILE");
  }
  replay.momentsAFrame = static_cast<int>(kFrameSeconds * rate);
  const auto whole = static_cast<int>(replay.trace.moments.size()) / replay.momentsAFrame + 1;
  replay.frames = options.device == "mouse" ? kDefaultFrames : whole;
  if (options.frames > 0) replay.frames = options.frames;
  return replay;
}

void lookAt(Window& window, const GraspApproach& approach, const SurfaceMesh& mesh) {
  const Eigen::Vector3d low = mesh.points().rowwise().minCoeff();
  const Eigen::Vector3d high = mesh.points().rowwise().maxCoeff();
  const double bounds[6] = {low.x(), high.x(), low.y(), high.y(), low.z(), high.z()};
  // Onto the fingertips and the thumb's side.
  window.lookFrom(
      0.7 * approach.from + 0.7 * approach.fingers + 0.55 * approach.from.cross(approach.fingers),
      bounds);
  window.renderer()->GetActiveCamera()->Zoom(kFarther);
  window.renderer()->ResetCameraClippingRange();
}

}  // namespace

void runGrasp(const TouchOptions& options) {
  const auto surface = readSurface(options.model);
  warnOfUnits(surface);
  const convert::ServedModel served = convert::servedModelOf(surface);
  const SceneBody body{served.greens, served.mesh};
  requireTouchable(body);
  const GraspApproach approach =
      approachTo(body, Eigen::Vector3d(directionOntoFreeSurface(surface).data()));
  const double length =
      options.handLength > 0 ? options.handLength : kHandOverModel * approach.extent;
  if (length < 1e-3 * approach.extent || length > 1e3 * approach.extent)
    throw std::invalid_argument("--hand-length does not fit the model: are both in metres?");
  const HandModel hand(length);
  Replay replay = replayOf(options, body, approach, hand);
  GloveDevice glove(std::move(replay.trace), hand);
  UnilateralContactSettings settings;
  settings.capacity = 400;
  settings.solver.largestUpdates = 200;  // a frame's deadline is not a servo loop's
  settings.solver.largestWork = 2e9;
  ToolTouch touch(body.greens, body.mesh, {std::make_shared<HandTool>(hand)},
                  options.friction >= 0 ? options.friction : 0.5, settings);
  SnapshotDeformation deformation(body.greens);

  const VirtualDisplay display;
  Window window(true);
  TouchView view;
  view.AddBody(body.mesh, {});
  view.AddTool(lookOf(hand));
  view.SetRenderer(window.renderer());
  lookAt(window, approach, *body.mesh);

  ServoSnapshot snapshot;
  snapshot.contact = touch.makeSnapshot();
  DeviceState state;
  Wrench wrench;
  GraspTally tally;
  const auto move = [&] {
    for (int tick = 0; tick < replay.momentsAFrame; ++tick) {
      const auto begin = Clock::now();
      if (!glove.read(state)) continue;  // while it is away the hand stays as it was
      const ContactCertificate certificate = touch.step(&state.pose, &wrench);
      tally.addStep(certificate, secondsSince(begin));
      glove.write(wrench);
    }
  };
  const auto start = Clock::now();
  auto moved = std::async(std::launch::async, move);
  while (true) {
    requireUninterrupted(options);
    moved.get();
    touch.fill(snapshot.contact);
    tally.addFrame(touch);
    const bool isLast = tally.frames() == replay.frames;
    // The hand goes on while this frame is drawn.
    if (!isLast) moved = std::async(std::launch::async, move);
    deformation.computeAll(snapshot.contact);
    view.Deform(0, deformation.displacement());
    view.Show(snapshot);
    window.render();
    if (isLast) break;
  }
  tally.print(touch, body.mesh->vertexCount(), secondsSince(start), kFrameSeconds);
  if (options.image.empty()) return;
  view.Explain(snapshot);
  window.write(options.image);
}

}  // namespace palpate::app
