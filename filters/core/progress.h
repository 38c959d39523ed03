// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <functional>
#include <stdexcept>
#include <utility>

namespace palpate {

/// Called from the calling thread while long work is under way.
/// @param fraction  done so far, 0..1 over the whole piece of work.
/// @param stage     what is being done, e.g. "assemble".
/// @return false to abort the work, which then throws `Aborted`.
using ProgressCallback = std::function<bool(double fraction, const char* stage)>;

/// Thrown out of work whose progress callback returned false. Nothing is left half-done.
struct Aborted : std::runtime_error {
  Aborted() : std::runtime_error("aborted on request") {}
};

/// Maps a part of the work, [begin, end] of 0..1, onto a callback; empty callbacks cost nothing.
class Progress {
 public:
  Progress() = default;
  explicit Progress(ProgressCallback callback, double begin = 0, double end = 1)
      : callback_(std::move(callback)), begin_(begin), end_(end) {}

  /// @throws Aborted if the callback asks for it.
  void report(double fraction, const char* stage) const {
    if (callback_ && !callback_(begin_ + (end_ - begin_) * fraction, stage)) throw Aborted();
  }

  /// What work of its own kind is given, to report within this range.
  ProgressCallback callback() const {
    return [*this](double fraction, const char* stage) {
      report(fraction, stage);
      return true;
    };
  }

  /// The sub-range [begin, end] of this range.
  Progress part(double begin, double end) const {
    const double width = end_ - begin_;
    return Progress(callback_, begin_ + width * begin, begin_ + width * end);
  }

 private:
  ProgressCallback callback_;
  double begin_ = 0, end_ = 1;
};

}  // namespace palpate
