// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/probed_touch.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <utility>

#include "greens/surface_fields.h"
#include "sentence.h"

namespace palpate {

ProbedTouch::ProbedTouch(std::shared_ptr<TouchModel> contact,
                         std::shared_ptr<const GreensFunctions> greens, ProbeRows rows,
                         std::vector<ProbeLimits> limits)
    : contact_(std::move(contact)),
      greens_(std::move(greens)),
      rows_(std::move(rows)),
      limits_(std::move(limits)),
      readings_(limits_.size()),
      state_(contact_->makeSnapshot()) {
  if (rows_.count() != static_cast<int>(limits_.size()) ||
      rows_.nodeCount() != greens_->nodeCount())
    refuse("there are rows of ", rows_.count(), " probes and ", rows_.nodeCount(),
           " nodes, and limits of ", limits_.size(), " for a body of ", greens_->nodeCount());
}

ContactCertificate ProbedTouch::step(const ToolPose* poses, Wrench* wrenches) noexcept {
  const ContactCertificate certificate = contact_->step(poses, wrenches);
  contact_->fill(state_);
  for (int point = 0; point < rows_.count(); ++point) read(point);
  ++ticks_;
  return certificate;
}

void ProbedTouch::read(int point) noexcept {
  ProbeValues values = ProbeValues::Zero();
  const double scale = stiffnessScale_.load(std::memory_order_relaxed);
  for (int i = 0; i < state_.loadedCount; ++i) {
    const int node = state_.loadedNodes[i];
    if (state_.loadedBodies[i] == 0 && !greens_->isFixed(node))
      rows_.accumulate(point, node, state_.loads[i] / (scale * greens_->vertexArea(node)), values);
  }
  const ProbedField field = fieldOf(values, rows_.stiffness(point));
  ProbeReading& reading = readings_[point];
  reading.displacement = field.displacement;
  reading.vonMises = vonMisesStress(field.stress);
  reading.gradient = spectralNorm(field.gradient);
  reading.largestVonMises = std::max(reading.largestVonMises, reading.vonMises);
  reading.largestGradient = std::max(reading.largestGradient, reading.gradient);
  if (reading.exceededTick < 0 &&
      (reading.vonMises > limits_[point].vonMises || reading.gradient > limits_[point].gradient))
    reading.exceededTick = ticks_;
}

ContactSnapshot ProbedTouch::makeSnapshot() const {
  ContactSnapshot snapshot = contact_->makeSnapshot();
  snapshot.probes = readings_;
  return snapshot;
}

void ProbedTouch::fill(ContactSnapshot& snapshot) const noexcept {
  contact_->fill(snapshot);
  std::copy(readings_.begin(), readings_.end(), snapshot.probes.begin());
}

}  // namespace palpate
