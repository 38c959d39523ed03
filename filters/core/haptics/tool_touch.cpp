// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/tool_touch.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "contact/mesh_shape.h"

namespace palpate {
namespace {

std::vector<Obstacle> obstaclesOf(const std::vector<std::shared_ptr<const TouchTool>>& tools,
                                  double friction, const std::vector<ElasticPartner>& partners) {
  std::vector<Obstacle> obstacles;
  for (std::size_t t = 0; t < tools.size(); ++t) {
    if (!tools[t]) throw std::invalid_argument("a device holds no tool");
    for (int part = 0; part < tools[t]->partCount(); ++part)
      obstacles.push_back({tools[t]->shape(part), friction, nullptr, nullptr, static_cast<int>(t)});
  }
  for (const ElasticPartner& partner : partners) {
    if (!partner.mesh || !partner.greens)
      throw std::invalid_argument("an elastic body in the scene has no surface or no response");
    obstacles.push_back({std::make_shared<MeshShape>(partner.mesh), partner.friction,
                         partner.greens, partner.mesh});
  }
  return obstacles;
}

/// Far from all bodies, whatever the shape: a plane's material is below it.
RigidPose nowhere() {
  RigidPose pose;
  pose.position.z() = -1e6;
  return pose;
}

}  // namespace

RigidTouchTool::RigidTouchTool(std::shared_ptr<const RigidShape> shape) : shape_(std::move(shape)) {
  if (!shape_) throw std::invalid_argument("a tool has no shape");
}

ToolTouch::ToolTouch(std::shared_ptr<const GreensFunctions> greens,
                     std::shared_ptr<const SurfaceMesh> mesh,
                     std::vector<std::shared_ptr<const TouchTool>> tools, double friction,
                     const UnilateralContactSettings& settings,
                     const std::vector<ElasticPartner>& partners)
    : contact_(std::move(greens), std::move(mesh), obstaclesOf(tools, friction, partners),
               settings),
      friction_(friction),
      wantedFriction_(friction),
      wantedRigid_(settings.rigidStiffness) {
  if (tools.empty()) throw std::invalid_argument("there is no tool to touch the surface with");
  for (const auto& tool : tools) {
    tools_.push_back({tool, static_cast<int>(poses_.size()), {}, kNoWrench});
    poses_.resize(poses_.size() + tool->partCount());
  }
  for (const ElasticPartner& partner : partners) poses_.push_back(partner.pose);
}

/// What was set since the last step; it has been found to be in range.
void ToolTouch::takeOver() noexcept {
  const double friction = wantedFriction_.load(std::memory_order_relaxed);
  for (std::size_t t = 0; friction != friction_ && t < tools_.size(); ++t)
    for (int part = 0; part < tools_[t].tool->partCount(); ++part)
      contact_.setFriction(tools_[t].firstPart + part, friction);
  friction_ = friction;
  const double scale = wantedScale_.load(std::memory_order_relaxed);
  if (scale != contact_.stiffnessScale()) contact_.setStiffnessScale(scale);
  const double rigid = wantedRigid_.load(std::memory_order_relaxed);
  if (rigid != contact_.rigidStiffness()) contact_.setRigidStiffness(rigid);
}

ContactCertificate ToolTouch::step(const ToolPose* poses, Wrench* wrenches) noexcept {
  takeOver();
  for (int t = 0; t < toolCount(); ++t) {
    tools_[t].pose = poses[t];
    RigidPose* const parts = poses_.data() + tools_[t].firstPart;
    tools_[t].tool->place(poses[t], parts);
    if (!poses[t].isThere) std::fill_n(parts, tools_[t].tool->partCount(), nowhere());
    const bool holds = holds_ && (poses[t].buttons & kHolds) != 0;
    for (int part = 0; part < tools_[t].tool->partCount(); ++part)
      contact_.setHeld(tools_[t].firstPart + part, holds);
  }
  certificate_ = contact_.step(poses_.data());
  if (certificate_.uncomputed) {
    for (int t = 0; t < toolCount(); ++t) wrenches[t] = tools_[t].wrench = kNoWrench;
    return certificate_;
  }
  for (int t = 0; t < toolCount(); ++t) {
    Wrench& sum = tools_[t].wrench = kNoWrench;
    for (int part = 0; part < tools_[t].tool->partCount(); ++part) {
      if (!torques_) {
        sum.force += contact_.force(tools_[t].firstPart + part);
        continue;
      }
      const Wrench wrench = partWrench(t, part);
      const Eigen::Vector3d lever = poses_[tools_[t].firstPart + part].position - poses[t].position;
      sum.force += wrench.force;
      sum.torque += wrench.torque + lever.cross(wrench.force);
    }
    wrenches[t] = sum;
  }
  return certificate_;
}

Wrench ToolTouch::partWrench(int tool, int part) const noexcept {
  return contact_.wrench(tools_[tool].firstPart + part);
}

void ToolTouch::reset() noexcept {
  contact_.reset();
  certificate_ = {};
  for (Held& held : tools_) held.wrench = kNoWrench;
}

void ToolTouch::setFriction(double friction) {
  if (!(friction >= 0) || !std::isfinite(friction))
    throw std::invalid_argument("the coefficient of friction must be at least 0 and finite, not " +
                                std::to_string(friction));
  wantedFriction_.store(friction, std::memory_order_relaxed);
}

void ToolTouch::setStiffnessScale(double scale) {
  if (!(scale > 0) || !std::isfinite(scale))
    throw std::invalid_argument("a stiffness scale must be positive and finite, not " +
                                std::to_string(scale));
  wantedScale_.store(scale, std::memory_order_relaxed);
}

void ToolTouch::setRigidStiffness(double stiffness) {
  if (!(stiffness >= 0) || !std::isfinite(stiffness))
    throw std::invalid_argument("the rigid stiffness must be at least 0 and finite, not " +
                                std::to_string(stiffness));
  wantedRigid_.store(stiffness, std::memory_order_relaxed);
}

ContactSnapshot ToolTouch::makeSnapshot() const {
  ContactSnapshot snapshot;
  snapshot.tools.resize(tools_.size());
  const std::size_t loads = 4 * std::size_t(contact_.capacity());
  snapshot.loadedBodies.resize(loads);
  snapshot.loadedNodes.resize(loads);
  snapshot.loadedParts.resize(loads);
  snapshot.loads.resize(loads, Eigen::Vector3d::Zero());
  return snapshot;
}

void ToolTouch::fill(ContactSnapshot& snapshot) const noexcept {
  snapshot.certificate = certificate_;
  for (int t = 0; t < toolCount(); ++t) {
    ToolContact& seen = snapshot.tools[t] = {};
    seen.pose = tools_[t].pose;
    seen.hapticPoint = tools_[t].pose.position;
    seen.wrench = tools_[t].wrench;
  }
  snapshot.loadedCount = 0;
  if (certificate_.uncomputed) return;
  const int parts = tools_.back().firstPart + tools_.back().tool->partCount();
  std::size_t loads = 0;
  for (int i = 0; i < contact_.watchedCount(); ++i) {
    const UnilateralContact::Watched watched = contact_.watched(i);
    if (watched.status == ContactStatus::Open) continue;
    const ContactSite& site = contact_.site(i);
    for (int p = 0; p < site.count; ++p, ++loads) {
      snapshot.loadedBodies[loads] = site.parts[p].body;
      snapshot.loadedNodes[loads] = site.parts[p].node;
      snapshot.loadedParts[loads] = watched.obstacle < parts ? watched.obstacle : -1;
      snapshot.loads[loads] = site.parts[p].weight * watched.force;
    }
  }
  snapshot.loadedCount = static_cast<int>(loads);
  describe(snapshot);
}

/// Whether each tool touches, and the middle of its contact, weighted with force.
void ToolTouch::describe(ContactSnapshot& snapshot) const noexcept {
  for (int t = 0; t < toolCount(); ++t) {
    ToolContact& seen = snapshot.tools[t];
    const int first = tools_[t].firstPart, last = first + tools_[t].tool->partCount();
    double weight = 0;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (int i = 0; i < contact_.watchedCount(); ++i) {
      const UnilateralContact::Watched watched = contact_.watched(i);
      if (watched.obstacle < first || watched.obstacle >= last ||
          watched.status == ContactStatus::Open)
        continue;
      const double force = watched.force.norm();
      seen.sliding = seen.sliding || watched.status == ContactStatus::Slip;
      middle += force * contact_.restPlace(i);
      weight += force;
    }
    seen.touching = weight > 0;
    if (seen.touching) seen.staticPoint = middle / weight;
  }
}

}  // namespace palpate
