// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <model_arrays.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <set>
#include <stdexcept>

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
constexpr double kHandOverModel = 2.0;  ///< length of the hand, over the body's mean extent

/// A hand that comes to the free side of a body and closes around it.
DeviceRecording handAround(const SceneBody& body, const Eigen::Vector3d& towards, double length,
                           int moments) {
  const Eigen::AlignedBox3d box(body.mesh->points().rowwise().minCoeff(),
                                body.mesh->points().rowwise().maxCoeff());
  // The palm (-y of the hand) looks from the free side onto the middle, the fingers (-z) across the
  // narrowest extent that is left.
  const Eigen::Vector3d back = towards.normalized();
  int narrow;
  (box.sizes().array() + 1e3 * box.sizes().maxCoeff() * back.array().abs().square())
      .minCoeff(&narrow);
  Eigen::Vector3d fingers = Eigen::Vector3d::Unit(narrow);
  fingers = (fingers - fingers.dot(back) * back).normalized();
  Eigen::Matrix3d frame;
  frame << back.cross(-fingers), back, -fingers;
  ToolPose pose;
  pose.orientation = Eigen::Quaterniond(frame);
  const double height = box.sizes().cwiseProduct(back.cwiseAbs()).sum() / 2;
  DeviceRecording recording = closingHand(moments, pose);
  for (std::size_t i = 0; i < recording.moments.size(); ++i) {
    const double approach = std::max(0.0, 1 - 4.0 * i / moments);  // a quarter of the time
    recording.moments[i].state.pose.position =
        box.center() - 0.58 * length * fingers + (height + (0.06 + 0.4 * approach) * length) * back;
  }
  return recording;
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
  const auto surface = readModel(options.model);
  const convert::ServedModel served = convert::servedModelOf(surface);
  const SceneBody body{served.greens, served.mesh};
  const Eigen::Vector3d towards(directionOntoFreeSurface(surface).data());
  const double extent =
      (body.mesh->points().rowwise().maxCoeff() - body.mesh->points().rowwise().minCoeff()).mean();
  const double length = options.handLength > 0 ? options.handLength : kHandOverModel * extent;
  const HandModel hand(length);
  const int frames = options.frames > 0 ? options.frames : kDefaultFrames;
  DeviceRecording trace;
  if (options.device == "mouse")
    trace = handAround(body, towards, length, frames * kTicksPerFrame);
  else if (options.device.rfind("scripted:", 0) == 0)
    trace = readDeviceRecording(options.device.substr(9));
  else
    throw std::invalid_argument("a grasp needs a glove's recording: --device scripted:FILE");
  GloveDevice glove(std::move(trace), hand);
  UnilateralContactSettings settings;
  settings.capacity = 400;
  ToolTouch touch(body.greens, body.mesh, {std::make_shared<HandTool>(hand)},
                  options.friction >= 0 ? options.friction : 0.5, settings);
  SnapshotDeformation deformation(body.greens);

  const VirtualDisplay display;
  Window window(true);
  TouchView view;
  view.AddBody(body.mesh, {});
  view.AddTool(lookOf(hand));
  view.SetRenderer(window.renderer());
  window.lookFrom(towards + Eigen::Vector3d(0.9, -0.9, 0.2) * towards.norm(), surface->GetBounds());

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
