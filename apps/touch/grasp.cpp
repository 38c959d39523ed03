// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <model_arrays.h>
#include <read_surface.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <Eigen/Geometry>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>

#include "haptics/device_recording.h"
#include "haptics/glove_device.h"
#include "haptics/hand_tool.h"
#include "haptics/snapshot_deformation.h"
#include "haptics/tool_touch.h"
#include "haptics/touch_session.h"
#include "picture/picture.h"
#include "picture/virtual_display.h"
#include "touch/touch_window.h"
#include "touch/window.h"
#include "touch_view.h"

namespace palpate::app {
namespace {

constexpr int kTicksPerFrame = 16;  ///< a servo loop of a thousand ticks a second, 60 frames
constexpr int kDefaultFrames = 120;
constexpr double kHandOverModel = 2.9;  ///< length of the hand, over the extent that it grasps

/// Angles of a grip around something round, as it closes from flat (0) to held (1).
void setGrip(double fraction, ToolPose& pose) {
  const auto set = [&](int joint, double angle) {
    pose.joints[static_cast<std::size_t>(joint)] = angle;
  };
  // Longer fingers bend more to reach as far.
  constexpr std::pair<int, double> reach[] = {
      {IndexProximal, 1.28}, {MiddleProximal, 1.17}, {RingProximal, 1.07}, {LittleProximal, 1.05}};
  pose.jointCount = HandJointCount;
  for (const auto& [finger, more] : reach) {
    set(finger, 1.3 * more * fraction);
    set(finger + 1, 0.5 * more * fraction);
    set(finger + 2, 0.3 * more * fraction);
  }
  set(ThumbAbduction, 1.3);
  set(ThumbRotation, 0.3 + 1.3 * fraction);
  set(ThumbProximal, 0.1 * fraction);
  set(ThumbDistal, 0.2 * fraction);
}

/// The horizontal axis along which a body is the narrowest, seen from a direction.
Eigen::Vector3d narrowAxis(const Eigen::Vector3d& extent, const Eigen::Vector3d& from) {
  int narrow = 0;
  double least = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double across = extent[axis] / std::max(1e-3, 1 - std::abs(from[axis]));
    if (axis > 0 && across >= least) continue;
    narrow = axis;
    least = across;
  }
  return Eigen::Vector3d::Unit(narrow);
}

/// A hand that comes down on the free side of a body and closes around it.
/// @param from  the way that the back of the hand looks, an axis.
DeviceRecording handAround(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from,
                           double length, int moments) {
  const Eigen::Vector3d fingers = narrowAxis(box.sizes(), from);
  Eigen::Matrix3d frame;  // the hand's: fingers along -z, its back along y
  frame << from.cross(-fingers), from, -fingers;
  const double height = box.sizes().dot(from.cwiseAbs()) / 2;
  const double width = box.sizes().dot(fingers.cwiseAbs());
  DeviceRecording trace;
  trace.info.name = "grasping hand";
  for (int i = 0; i < moments; ++i) {
    const double time = static_cast<double>(i) / moments;
    const double approach = std::max(0.0, 1 - 4 * time);  // a quarter of the time
    const double closed = std::clamp((time - 0.2) / 0.6, 0.0, 1.0);
    DeviceState state;
    state.sequence = static_cast<std::uint64_t>(i) + 1;
    state.pose.orientation = Eigen::Quaterniond(frame);
    state.pose.position = box.center() + (width / 2 - 0.44 * length) * fingers +
                          (height + (0.05 + 0.4 * approach) * length) * from;
    setGrip(closed * closed * (3 - 2 * closed), state.pose);
    trace.moments.push_back({true, state});
  }
  return trace;
}

/// What a finger feels: its bones' forces.
struct Finger {
  const char* name;
  int first, count;
};
constexpr Finger kFingers[] = {{"thumb", 0, 3}, {"index", 3, 3},   {"middle", 6, 3},
                               {"ring", 9, 3},  {"little", 12, 3}, {"palm", 15, 4}};

Eigen::Vector3d forceOf(const ToolTouch& touch, const Finger& finger) {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (int part = finger.first; part < finger.first + finger.count; ++part)
    force += touch.partWrench(0, part).force;
  return force;
}

/// Constraints, three a node under a force, that came or went since the last frame.
int changesSince(std::set<int>& before, const ToolTouch& touch) {
  std::set<int> now;
  for (int i = 0; i < touch.contact().watchedCount(); ++i)
    if (touch.contact().watched(i).status != ContactStatus::Open)
      now.insert(touch.contact().watched(i).vertex);
  int changed = 0;
  for (int node : now) changed += 1 - static_cast<int>(before.count(node));
  for (int node : before) changed += 1 - static_cast<int>(now.count(node));
  before = std::move(now);
  return 3 * changed;
}

struct Tally {
  double seconds = 0, contactSeconds = 0, worstResidual = 0;
  int largestChange = 0, largestDof = 0, frames = 0, cut = 0;
};

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void print(const ToolTouch& touch, const Tally& tally, int nodes) {
  std::printf("model                 %d degrees of freedom\n", 3 * nodes);
  std::printf("constraints           up to %d, up to %d change in a frame\n", tally.largestDof,
              tally.largestChange);
  std::printf("frames                %d, %.1f a second, of which contact %.1f ms each\n",
              tally.frames, tally.frames / tally.seconds,
              1e3 * tally.contactSeconds / tally.frames);
  std::printf("worst residual        %.2g, %d ticks over budget\n", tally.worstResidual, tally.cut);
  for (const Finger& finger : kFingers) {
    const Eigen::Vector3d force = forceOf(touch, finger);
    std::printf("%-8s force, N     %.5g   (%.4g %.4g %.4g)\n", finger.name, force.norm(), force.x(),
                force.y(), force.z());
  }
  std::fflush(stdout);
}

}  // namespace

void runGrasp(const TouchOptions& options) {
  const auto surface = readSurface(options.model);
  const convert::ServedModel served = convert::servedModelOf(surface);
  const SceneBody body{served.greens, served.mesh};
  const Eigen::Vector3d free(directionOntoFreeSurface(surface).data());
  int axis;
  free.cwiseAbs().maxCoeff(&axis);
  const Eigen::Vector3d from = std::copysign(1.0, free[axis]) * Eigen::Vector3d::Unit(axis);
  const Eigen::AlignedBox3d box(body.mesh->points().rowwise().minCoeff(),
                                body.mesh->points().rowwise().maxCoeff());
  const Eigen::Vector3d fingers = narrowAxis(box.sizes(), from);
  const double width = box.sizes().dot(fingers.cwiseAbs());
  const double length = options.handLength > 0 ? options.handLength : kHandOverModel * width;
  const HandModel hand(length);
  const int frames = options.frames > 0 ? options.frames : kDefaultFrames;
  DeviceRecording trace;
  if (options.device == "mouse")
    trace = handAround(box, from, length, frames * kTicksPerFrame);
  else if (options.device.rfind("scripted:", 0) == 0)
    trace = readDeviceRecording(options.device.substr(9));
  else
    throw std::invalid_argument("a grasp needs a glove's recording: --device scripted:FILE");
  GloveDevice glove(std::move(trace), hand);
  UnilateralContactSettings settings;
  settings.capacity = 400;
  settings.solver.largestUpdates = 40;
  ToolTouch touch(body.greens, body.mesh, {std::make_shared<HandTool>(hand)},
                  options.friction >= 0 ? options.friction : 0.5, settings);
  SnapshotDeformation deformation(body.greens);

  const VirtualDisplay display;
  Window window(true);
  TouchView view;
  view.AddBody(body.mesh, {});
  view.AddTool(lookOf(hand));
  view.SetRenderer(window.renderer());
  const Eigen::AlignedBox3d seen(box.min() - 0.2 * box.sizes(), box.max() + 0.2 * box.sizes());
  const double bounds[6] = {seen.min().x(), seen.max().x(), seen.min().y(),
                            seen.max().y(), seen.min().z(), seen.max().z()};
  window.lookFrom(0.45 * from - 0.5 * fingers + 0.9 * from.cross(fingers), bounds);

  ServoSnapshot snapshot;
  snapshot.contact = touch.makeSnapshot();
  snapshot.tools.resize(1);
  DeviceState state;
  Wrench wrench;
  Tally tally;
  std::set<int> held;
  const auto start = std::chrono::steady_clock::now();
  for (; tally.frames < frames; ++tally.frames) {
    const auto begin = std::chrono::steady_clock::now();
    for (int tick = 0; tick < kTicksPerFrame; ++tick) {
      glove.read(state);
      const ContactCertificate certificate = touch.step(&state.pose, &wrench);
      tally.worstResidual = std::max(tally.worstResidual, certificate.residual);
      tally.cut += certificate.budgetCut;
      glove.write(wrench);
    }
    tally.contactSeconds += secondsSince(begin);
    tally.largestChange = std::max(tally.largestChange, changesSince(held, touch));
    tally.largestDof = std::max(tally.largestDof, 3 * static_cast<int>(held.size()));
    touch.fill(snapshot.contact);
    deformation.computeAll(snapshot.contact);
    view.Deform(0, deformation.displacement());
    view.Show(snapshot, std::max(1e-9, wrench.force.norm()));
    window.render();
  }
  tally.seconds = secondsSince(start);
  if (!options.image.empty()) window.write(options.image);
  print(touch, tally, body.mesh->vertexCount());
}

}  // namespace palpate::app
