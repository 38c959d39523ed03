// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>
#include <vector>

class vtkPolyData;

namespace palpate::app {

/// What `palpate touch` and `palpate grasp` are asked for.
struct TouchOptions {
  std::string model, scene;      ///< one of the two
  std::string device = "mouse";  ///< mouse, scripted:FILE, simulated, hid or hid:VVVV:PPPP
  bool deviceGiven = false;      ///< whether it replaces the scene's
  double toolRadius = 0;         ///< of a ball, 0 for a point
  int contacts = 0;              ///< most at a time, 0 as it is
  double friction = -1, maskRadius = -1, stiffnessLimit = -1, rate = 0;  ///< negative: as it is
  std::string maskShape;    ///< linear, uniform, gaussian, hertzian; empty: as it is
  std::string deformation;  ///< all, visible, contact, none; empty: as it is
  std::string record, forces, image;
  bool headless = false, plan = false;
  bool waitsForMouse = false;         ///< whether a tool is moved in a window alone
  double seconds = 0;                 ///< to run, 0 until the window is closed
  bool (*isInterrupted)() = nullptr;  ///< asked while it runs

  // The laboratory of stability:
  bool lab = false;
  std::vector<double> at;  ///< where to press, nearest point of the surface
  std::vector<double> rates, dampings;
  std::vector<int> delays;
  double depth = 0;  ///< m, 0 for a hundredth of the model's diagonal

  // The grasp:
  bool grasp = false;
  double handLength = 0;  ///< m, 0 to fit the model
  int frames = 0;
};

constexpr double kMostRecordedSeconds = 120;

/// Of the library that renders.
constexpr const char* kTouchLibrary = "libpalpate_touch.so";
constexpr const char* kTouchFunction = "palpate_touch";
/// @return an empty string, or what went wrong.
using TouchFunction = std::string (*)(const TouchOptions& options);

/// Says on stderr if a model is so large that its points are hardly metres.
void warnOfUnits(vtkPolyData* model);
/// @throws std::runtime_error if the run is to end, before anything is written.
void requireUninterrupted(const TouchOptions& options);

/// What the library's sources have in common: each throws with a sentence.
void runWindow(const TouchOptions& options);
void runLab(const TouchOptions& options);
void runGrasp(const TouchOptions& options);

}  // namespace palpate::app
