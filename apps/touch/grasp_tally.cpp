// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "touch/grasp_tally.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace palpate::app {
namespace {

constexpr int kMany = 100;  ///< [JP01] fig. 3: "often updating over 100 dof per frame"

Eigen::Vector3d forceOf(const ToolTouch& touch, const HandFinger& finger) {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (int part = finger.firstBone; part < finger.firstBone + finger.boneCount; ++part)
    force += touch.partWrench(0, part).force;
  return force;
}

int median(std::vector<int> numbers) {
  if (numbers.empty()) return 0;
  std::nth_element(numbers.begin(), numbers.begin() + numbers.size() / 2, numbers.end());
  return numbers[numbers.size() / 2];
}

int largest(const std::vector<int>& numbers) {
  return numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end());
}

}  // namespace

void GraspTally::addStep(const ContactCertificate& certificate, double seconds) {
  residual_ = std::max(residual_, certificate.residual);
  cut_ += certificate.budgetCut;
  truncated_ += certificate.truncated;
  contactSeconds_ += seconds;
}

void GraspTally::addFrame(const ToolTouch& touch) {
  ++frames_;
  for (std::size_t i = 0; i < largest_.size(); ++i)
    largest_[i] = std::max(largest_[i], forceOf(touch, kHandFingers[i]).norm());
  std::set<int> now;
  for (int i = 0; i < touch.contact().watchedCount(); ++i) {
    const ContactSite& site = touch.contact().site(i);
    if (touch.contact().watched(i).status == ContactStatus::Open) continue;
    for (int p = 0; p < site.count; ++p) now.insert(site.parts[p].node);
  }
  int changed = 0;
  for (int node : now) changed += 1 - static_cast<int>(held_.count(node));
  for (int node : held_) changed += 1 - static_cast<int>(now.count(node));
  if (!now.empty() || !held_.empty()) {
    dof_.push_back(3 * static_cast<int>(now.size()));
    changed_.push_back(3 * changed);
  }
  held_ = std::move(now);
}

void GraspTally::print(const ToolTouch& touch, int nodes, double seconds,
                       double frameSeconds) const {
  const auto many =
      std::count_if(changed_.begin(), changed_.end(), [](int changed) { return changed > kMany; });
  std::printf("model                 %d degrees of freedom\n", 3 * nodes);
  std::printf("constraint dof        median %d, up to %d in the %zu frames that touch\n",
              median(dof_), largest(dof_), dof_.size());
  std::printf("  changed since the last frame: median %d, up to %d; over %d in %d frames\n",
              median(changed_), largest(changed_), kMany, static_cast<int>(many));
  std::printf("frames                %d, a step of %.0f ms each, %.1f a second, contact %.1f ms\n",
              frames_, 1e3 * frameSeconds, frames_ / seconds, 1e3 * contactSeconds_ / frames_);
  std::printf(
      "worst residual        %.2g, %d ticks that did not settle, %d with contacts left out\n",
      residual_, cut_, truncated_);
  for (std::size_t i = 0; i < largest_.size(); ++i) {
    const Eigen::Vector3d force = forceOf(touch, kHandFingers[i]);
    std::printf("%-8s force, N     %-8.3g (%.3g %.3g %.3g), at most %.3g\n", kHandFingers[i].name,
                force.norm(), force.x(), force.y(), force.z(), largest_[i]);
  }
  std::fflush(stdout);
}

}  // namespace palpate::app
