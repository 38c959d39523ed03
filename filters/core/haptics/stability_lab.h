// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vector>

#include "haptics/simulated_device.h"
#include "haptics/touch_model.h"
#include "progress.h"

namespace palpate {

/// How a model is pressed to find out what stiffness a device can render.
struct LabSettings {
  /// Its hand holds it at `place`; path and push are the lab's.
  SimulatedDeviceSettings device;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< on the model's surface, m
  Eigen::Vector3d direction{0, 0, -1};              ///< into it, of any length
  double depth = 1e-3;                              ///< pressed at rest, m
  double tolerance = 0.005;                         ///< relative, of a largest stable stiffness
  bool passivityControl = false;                    ///< passivityDamping, up to mass / period
};

/// What happened to a device pressed into a model and kicked.
struct LabRun {
  bool stable = false;
  double residual = 0;     ///< m, half the range of its motion at the end
  double leastEnergy = 0;  ///< J, PassivityObserver: below zero at any time, the model made energy
  long dampedTicks = 0;    ///< in which the passivity controller acted
};

struct ZWidthPoint {
  double rate;           ///< 1/T, Hz
  double damping;        ///< b of the device, N s/m
  int delay;             ///< d, ticks
  double largestStable;  ///< N/m, StabilityLab::stiffness by simulation
  double passive;        ///< N/m, servedStiffness(b, T, d): the Colgate bound
};

/// A laboratory of stability without hardware. A simulated device is pressed to a depth by a
/// constant force, kicked by three tenths of the depth and a tenth of that sideways, and left
/// alone: it is stable if its motion there shrinks along every axis of the model's stiffness, or to
/// two quanta. The hand's force and the model's are scaled alike, so that every stiffness is tried
/// at the same depth.
class StabilityLab {
 public:
  /// @param model  with one tool; stepped and reset by the lab, and to outlive it.
  /// @throws std::invalid_argument if it has more tools, a setting is out of range, or the model
  ///         does not resist the press.
  StabilityLab(TouchModel& model, const LabSettings& settings);

  /// The model's own at `depth`, N/m: the spectral norm |K| of its matrix there, by differences
  /// of a hundredth of the depth. Each eigenvalue of K is that of a spring to the sampled device,
  /// whose damping is the same along every axis: the Colgate bound is on the largest.
  double stiffness() const noexcept { return stiffness_; }
  /// The force against the press over the depth, N/m: of one direction, and not more.
  double pressStiffness() const noexcept { return pressStiffness_; }

  /// By how much the model's stiffness matrix differs, |K' - K| / |K|, where the kick takes the
  /// device at most. Beyond a few per cent the model is not the spring that the Colgate bound is
  /// of: the contact slips over to faces of another stiffness, as on a mesh of very few vertices.
  double variation() const noexcept { return variation_; }

  /// @param stiffness  that the model's own is scaled to, N/m.
  /// @param progress   reported to now and then; how far it comes is not known beforehand.
  /// @throws std::invalid_argument if it is not positive; Aborted if `progress` asks for it.
  LabRun run(double stiffness, const Progress& progress = {}) const;

  /// The largest stable stiffness by bisection, to the tolerance; N/m. 0 without damping or where
  /// nothing is stable; infinite if a million times the Colgate bound still is.
  /// @throws Aborted if `progress` asks for it.
  double largestStable(const Progress& progress = {}) const;

 private:
  TouchModel* model_;
  LabSettings settings_;
  Eigen::Vector3d direction_;
  Eigen::Vector3d resistance_ = Eigen::Vector3d::Zero();  ///< to the press at rest, on the model, N
  Eigen::Matrix3d modes_;  ///< axes of the model's stiffness at rest, the columns
  double pressStiffness_, stiffness_, variation_ = 0;
};

/// Z-width of a model (Colgate & Brown 1994): a point for each rate, damping and delay, the delay
/// running fastest.
/// @param rates    Hz, from 10 to 100000.
/// @param dampings of the device, N s/m.
/// @param delays   ticks.
/// @throws std::invalid_argument as StabilityLab; Aborted if `progress` asks for it.
std::vector<ZWidthPoint> zWidth(TouchModel& model, const LabSettings& settings,
                                const std::vector<double>& rates,
                                const std::vector<double>& dampings, const std::vector<int>& delays,
                                const Progress& progress = {});

}  // namespace palpate
