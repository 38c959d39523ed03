// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <atomic>
#include <limits>
#include <memory>
#include <vector>

#include "greens/greens_functions.h"
#include "greens/probe_rows.h"
#include "haptics/touch_model.h"

namespace palpate {

/// From where on a probe inside the body is reported, as where it would tear or linear theory ends.
struct ProbeLimits {
  double vonMises = std::numeric_limits<double>::infinity();  ///< Pa
  double gradient = std::numeric_limits<double>::infinity();  ///< displacement gradient's norm
};

/// A contact whose stress is looked at inside the first body, in every tick: what a snapshot holds
/// of probes includes the largest values so far, and the tick at which a limit was first exceeded,
/// however short that was. Loads other than contacts, as weight, do not count.
class ProbedTouch final : public TouchModel {
 public:
  /// @param greens  of the first body.
  /// @param rows    of as many nodes as that.
  /// @param limits  a point each.
  /// @throws std::invalid_argument if sizes differ.
  ProbedTouch(std::shared_ptr<TouchModel> contact, std::shared_ptr<const GreensFunctions> greens,
              ProbeRows rows, std::vector<ProbeLimits> limits);

  int toolCount() const override { return contact_->toolCount(); }
  ContactCertificate step(const ToolPose* poses, Wrench* wrenches) noexcept override;
  /// Largest values stay.
  void reset() noexcept override { contact_->reset(); }
  ContactSnapshot makeSnapshot() const override;
  void fill(ContactSnapshot& snapshot) const noexcept override;

  /// Tells by what the contact scales its forces from now on: they deform without it. From any
  /// thread.
  void setStiffnessScale(double scale) noexcept {
    stiffnessScale_.store(scale, std::memory_order_relaxed);
  }

 private:
  void read(int point) noexcept;

  std::shared_ptr<TouchModel> contact_;
  std::shared_ptr<const GreensFunctions> greens_;
  ProbeRows rows_;
  std::vector<ProbeLimits> limits_;
  std::vector<ProbeReading> readings_;
  ContactSnapshot state_;
  std::atomic<double> stiffnessScale_{1};
  std::int64_t ticks_ = 0;
};

}  // namespace palpate
