// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/point_touch.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {

PointTouch::PointTouch(std::shared_ptr<const SurfaceStiffness> stiffness, int toolCount,
                       double friction) {
  if (toolCount < 1)
    throw std::invalid_argument("there must be at least 1 tool, not " + std::to_string(toolCount));
  setFriction(friction);
  const auto surface = std::make_shared<const TouchedSurface>(stiffness->sharedMesh());
  tools_.assign(toolCount, SlidingContact(stiffness, surface));
  poses_.resize(toolCount);
  slotOfNode_.assign(stiffness->mesh().vertexCount(), -1);
  versions_.push_back(std::make_unique<const Version>(Version{std::move(stiffness), 0}));
  current_ = versions_.back().get();
  wanted_ = current_;
}

PointTouch::~PointTouch() = default;

void PointTouch::setFriction(double mu) {
  if (!(mu >= 0) || !std::isfinite(mu))
    throw std::invalid_argument("the coefficient of friction must be at least 0 and finite, not " +
                                std::to_string(mu));
  friction_.store(mu, std::memory_order_relaxed);
}

void PointTouch::setStiffness(std::shared_ptr<const SurfaceStiffness> stiffness) {
  const std::lock_guard<std::mutex> lock(changing_);
  const Version& last = *versions_.back();
  if (stiffness->sharedMesh() != last.stiffness->sharedMesh())
    throw std::invalid_argument("the stiffness is that of another mesh than the one being touched");
  // What is older than the oldest in use will not be looked at again: the servo thread only ever
  // goes on to newer versions.
  const long oldest = oldestInUse_.load(std::memory_order_acquire);
  while (versions_.front()->number < oldest) versions_.pop_front();
  versions_.push_back(
      std::make_unique<const Version>(Version{std::move(stiffness), last.number + 1}));
  wanted_.store(versions_.back().get(), std::memory_order_release);
}

std::shared_ptr<const SurfaceStiffness> PointTouch::stiffness() const {
  const std::lock_guard<std::mutex> lock(changing_);
  return versions_.back()->stiffness;
}

/// Goes on to the newest version once the change to the current one is complete. The contacts' own
/// pointers never are the last ones to a stiffness: versions_ keeps it.
void PointTouch::takeOver() noexcept {
  if (tools_.front().isChanging()) return;
  const Version* wanted = wanted_.load(std::memory_order_acquire);
  if (wanted == current_) return;
  for (SlidingContact& tool : tools_) tool.setStiffness(wanted->stiffness);
  oldestInUse_.store(current_->number, std::memory_order_release);
  current_ = wanted;
}

ContactCertificate PointTouch::step(const ToolPose* poses, Wrench* wrenches) noexcept {
  takeOver();
  certificate_ = {};
  const double mu = friction();
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    SlidingContact& tool = tools_[i];
    poses_[i] = poses[i];
    tool.setFriction(mu);
    tool.setAdhesion((poses[i].buttons & kAdheres) != 0);
    wrenches[i] = {-tool.advance(poses[i].position), Eigen::Vector3d::Zero()};
    certificate_.iterations = std::max(certificate_.iterations, tool.slideCount());
    certificate_.contactCount += tool.isTouching();
    certificate_.budgetCut |= tool.wasHeldBack();
    certificate_.failed |= tool.isUnserved();
    if (tool.isTouching())
      certificate_.coneViolation = std::max(certificate_.coneViolation, tool.coneExcess());
  }
  return certificate_;
}

void PointTouch::reset() noexcept {
  for (SlidingContact& tool : tools_) tool.reset();
}

ContactSnapshot PointTouch::makeSnapshot() const {
  ContactSnapshot snapshot;
  snapshot.tools.resize(tools_.size());
  snapshot.loadedBodies.resize(slotOfNode_.size(), 0);
  snapshot.loadedNodes.resize(slotOfNode_.size());
  snapshot.loadedParts.resize(slotOfNode_.size(), -1);
  snapshot.loads.resize(slotOfNode_.size());
  return snapshot;
}

/// Adds a contact's force to its nodes: the barycentric share of each free corner, spread by its
/// mask (eq. 35).
void PointTouch::load(const SlidingContact& contact, ContactSnapshot& snapshot) const noexcept {
  const SurfaceStiffness& stiffness = contact.stiffness();
  const SurfacePoint& point = contact.point();
  for (int k = 0; k < 3; ++k) {
    if (point.barycentric[k] == 0) continue;
    const VertexMask& mask = stiffness.mask(stiffness.mesh().triangles()(k, point.triangle));
    for (std::size_t j = 0; j < mask.nodes.size(); ++j) {
      const int node = mask.nodes[j];
      int& slot = slotOfNode_[node];
      if (slot < 0) {
        slot = snapshot.loadedCount++;
        snapshot.loadedNodes[slot] = node;
        snapshot.loads[slot].setZero();
      }
      const double share = stiffness.mesh().vertexAreas()[node] * mask.density[j];
      snapshot.loads[slot] += point.barycentric[k] * share * contact.force();
    }
  }
}

void PointTouch::fill(ContactSnapshot& snapshot) const noexcept {
  snapshot.certificate = certificate_;
  snapshot.loadedCount = 0;
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    const SlidingContact& contact = tools_[i];
    ToolContact& tool = snapshot.tools[i];
    tool.touching = contact.isTouching();
    tool.pose = poses_[i];
    tool.wrench = {-contact.force(), Eigen::Vector3d::Zero()};
    tool.triangle = contact.point().triangle;
    tool.barycentric = contact.point().barycentric;
    tool.staticPoint = contact.staticPoint();
    tool.hapticPoint = poses_[i].position;
    tool.sliding = contact.isSliding();
    if (!contact.force().isZero(0)) load(contact, snapshot);
  }
  for (int slot = 0; slot < snapshot.loadedCount; ++slot)
    slotOfNode_[snapshot.loadedNodes[slot]] = -1;
}

}  // namespace palpate
