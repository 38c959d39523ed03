// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <array>
#include <iterator>
#include <set>
#include <vector>

#include "haptics/hand_model.h"
#include "haptics/tool_touch.h"

namespace palpate::app {

/// What a grasp's frames were like.
class GraspTally {
 public:
  /// After a step of the contact.
  void addStep(const ContactCertificate& certificate, double seconds);
  /// After the steps of a frame.
  void addFrame(const ToolTouch& touch);
  int frames() const { return frames_; }

  /// @param seconds        that all frames took.
  /// @param frameSeconds   of the motion, a frame.
  void print(const ToolTouch& touch, int nodes, double seconds, double frameSeconds) const;

 private:
  std::set<int> held_;              ///< nodes under a force in the last frame
  std::vector<int> dof_, changed_;  ///< of frames that touch, or touched before
  std::array<double, std::size(kHandFingers)> largest_{};  ///< N, in a frame
  double contactSeconds_ = 0, residual_ = 0;
  int frames_ = 0, cut_ = 0, truncated_ = 0;
};

}  // namespace palpate::app
