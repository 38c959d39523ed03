// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <functional>

namespace palpate::app {

/// Whether DISPLAY names one that lets windows be opened.
bool hasDisplay();

/// What is done before Xlib ends the process because its display has gone, while this lives. One at
/// a time.
class OnDisplayLoss {
 public:
  explicit OnDisplayLoss(std::function<void()> action);
  ~OnDisplayLoss();
  OnDisplayLoss(const OnDisplayLoss&) = delete;
  OnDisplayLoss& operator=(const OnDisplayLoss&) = delete;
};

/// An X display to draw on: the user's where there is one, else an Xvfb of our own that ends with
/// this object.
class VirtualDisplay {
 public:
  /// @throws std::runtime_error if there is neither a display nor Xvfb.
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

 private:
  int server_ = -1;  ///< process number of Xvfb
};

}  // namespace palpate::app
