// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/point_touch.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

constexpr int kStepsKept = 6;  ///< of sweeps

int requireTools(int count) {
  if (count < 1)
    throw std::invalid_argument("there must be at least 1 tool, not " + std::to_string(count));
  return count;
}

}  // namespace

PointTouch::PointTouch(std::shared_ptr<const SurfaceStiffness> stiffness, int toolCount,
                       double friction)
    : coupling_(*stiffness, requireTools(toolCount)),
      tried_(toolCount),
      forces_(Eigen::VectorXd::Zero(3 * toolCount)),
      guess_(forces_),
      mixing_(3 * toolCount, kStepsKept) {
  setFriction(friction);
  const auto surface = std::make_shared<const TouchedSurface>(stiffness->sharedMesh());
  tools_.assign(toolCount, SlidingContact(stiffness, surface));
  poses_.resize(toolCount);
  slotOfNode_.assign(stiffness->mesh().vertexCount(), -1);
  isPartial_ = stiffness->greens().missingCount() > 0;
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
  coupling_.setStiffness(*wanted->stiffness);
  oldestInUse_.store(current_->number, std::memory_order_release);
  current_ = wanted;
}

/// Moves each probe under the forces that the others have so far.
/// @return the largest change of a force over the largest force.
double PointTouch::sweep(bool isFirst) noexcept {
  double change = 0, largest = 0;
  guess_ = forces_;
  for (int i = 0; i < toolCount(); ++i) {
    if (!poses_[i].isThere) continue;
    SlidingContact& tool = tools_[i];
    Tried& tried = tried_[i];
    const Eigen::Vector3d shift =
        tried.isShifted ? coupling_.shift(i, forces_) : Eigen::Vector3d::Zero();
    if (isFirst || shift != tried.shift) {
      if (!isFirst) tool.recall(tried.before);
      tool.advance(poses_[i].position, shift);
      tried.shift = shift;
      tried.isShifted = tried.isShifted || tool.isTouching();
      if (tool.isTouching()) coupling_.place(i, tool.point(), tool.servedStiffness());
    }
    forces_.segment<3>(3 * i) = tool.force();
    change = std::max(change, (tool.force() - guess_.segment<3>(3 * i)).norm());
    largest = std::max(largest, tool.force().norm());
  }
  return change > 0 ? change / std::max(change, largest) : 0;
}

void PointTouch::advanceTogether() noexcept {
  coupling_.setShare(tools_.front().changed());
  for (int i = 0; i < toolCount(); ++i) {
    const SlidingContact& tool = tools_[i];
    tried_[i] = {tool.state(), Eigen::Vector3d::Zero(), tool.isTouching()};
    forces_.segment<3>(3 * i) = tool.force();
    if (tool.isTouching() || !tool.force().isZero(0))
      coupling_.place(i, tool.point(), tool.servedStiffness());
    else
      coupling_.remove(i);
  }
  double change = sweep(true), last = change;
  int placed = 0;
  for (int i = 0; i < toolCount(); ++i) placed += coupling_.isPlaced(i);
  if (placed < 2) return;
  coupling_.limit();
  mixing_.restart();
  for (certificate_.iterations = 1; change > kTolerance && certificate_.iterations < kMostSweeps;
       ++certificate_.iterations) {
    if (change > last) mixing_.restart();
    last = change;
    mixing_.next(guess_, forces_);
    forces_.swap(guess_);
    change = sweep(false);
  }
  certificate_.residual = change;
  certificate_.budgetCut = change > kTolerance;
}

ContactCertificate PointTouch::step(const ToolPose* poses, Wrench* wrenches) noexcept {
  takeOver();
  certificate_ = {};
  const double mu = friction();
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    poses_[i] = poses[i];
    tools_[i].setFriction(mu);
    tools_[i].setAdhesion((poses[i].buttons & kAdheres) != 0);
  }
  if (tools_.size() > 1)
    advanceTogether();
  else if (poses_.front().isThere)
    tools_.front().advance(poses_.front().position);
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    const SlidingContact& tool = tools_[i];
    wrenches[i] = {-tool.force(), Eigen::Vector3d::Zero()};
    certificate_.iterations = std::max(certificate_.iterations, tool.slideCount());
    certificate_.contactCount += tool.isTouching();
    certificate_.heldBack |= tool.isStuck();
    certificate_.startedInside |= tool.startedInside();
    certificate_.failed |= tool.isUnserved();
    certificate_.uncomputed |= isPartial_ && tool.isUnserved();
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
