// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <array>

namespace palpate {

/// How much time passes between two reports of a device, against which its silence is counted: the
/// longest between its last eight reports, no less than it states itself, and from a tick of the
/// servo loop to a longest interval. Until it has reported twice, that one.
class ReportInterval {
 public:
  /// @param stated   s, by the device; 0 if it does not say.
  /// @param period   s, of a tick.
  /// @param longest  s.
  ReportInterval(double stated, double period, double longest) noexcept;

  /// A device's first report, or its first one after it was away.
  void restart() noexcept { count_ = 0; }
  /// @param gap  s, since the report before this one.
  void add(double gap) noexcept;

  double seconds() const noexcept;

  /// Whether none of its last reports came within the longest interval of the one before.
  bool isTooLong() const noexcept;

 private:
  static constexpr int kRemembered = 8;

  double stated_, period_, longest_;
  std::array<double, kRemembered> gaps_{};  ///< ring of the last ones
  long count_ = 0;                          ///< gaps so far
};

}  // namespace palpate
