// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>
#include <Eigen/Core>

namespace palpate {

/// A hand's velocity from its device's last two reports and the time between them. Between reports
/// a position stands still and then jumps: differences from tick to tick would be zeros and spikes.
class ReportVelocity {
 public:
  /// A device's first report, or its first one after it was away: at rest.
  void restart() noexcept { *this = {}; }

  /// A tick.
  /// @param sequence  DeviceState::sequence; another than the last one is a new report.
  /// @param elapsed   s, since the last tick.
  void advance(std::uint64_t sequence, const Eigen::Vector3d& position, double elapsed) noexcept {
    since_ += elapsed;
    if (hasReport_ && sequence == sequence_) return;
    if (hasReport_) velocity_ = (position - position_) / since_;
    interval_ = since_;
    since_ = 0;
    sequence_ = sequence;
    position_ = position;
    hasReport_ = true;
  }

  /// m/s; less where the next report is late, as the hand may have stopped.
  Eigen::Vector3d value() const noexcept {
    return since_ > interval_ ? (interval_ / since_ * velocity_).eval() : velocity_;
  }

 private:
  bool hasReport_ = false;
  std::uint64_t sequence_ = 0;
  double since_ = 0, interval_ = 0;  ///< s, since the last report; between the last two
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero(), velocity_ = Eigen::Vector3d::Zero();
};

}  // namespace palpate
