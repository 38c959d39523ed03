// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_haptic_style_touch_h
#define palpate_haptic_style_touch_h

#include "haptic_touch.h"
#include "touch_view.h"
#include "vtkInteractorStyleHaptic.h"

#include <exception>

/// What touches, what draws it, and what the mouse is doing.
struct vtkInteractorStyleHaptic::Touch
{
  palpate::HapticTouch Session;
  palpate::TouchView View;
  bool Shown = false; ///< whether the view has this session's bodies
  bool ShowsStiffness = false;
  int Timer = -1;
  bool Dragging = false;
  Eigen::Vector3d Anchor; ///< on the surface, where the drag began
  Eigen::Vector3d Offset; ///< of the tool's position, from its place that is nearest to the surface
  double Depth = 0;       ///< along the view
  std::vector<char> Touched;
  std::vector<char> Exceeded; ///< a probe's limit
  std::vector<std::string> Faults;
  std::vector<std::string> Warnings; ///< told
};

/// Runs what may throw; false and a sentence if it did.
template <class Action>
bool vtkInteractorStyleHaptic::Try(const Action& action)
{
  this->FailureMessage.clear();
  try
  {
    action();
    return true;
  }
  catch (const std::exception& failure)
  {
    this->FailureMessage = failure.what();
    vtkErrorMacro(<< this->FailureMessage);
    return false;
  }
}

#endif
