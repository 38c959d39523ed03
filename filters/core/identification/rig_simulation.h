// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <functional>

#include "greens/spread_force.h"
#include "identification/measurements.h"
#include "model/elastic_model.h"

namespace palpate {

/// A rig that presses on a body and looks at markers on it.
struct RigSettings {
  int probes = 5, markers = 50;  ///< as many markers under each probe
  double radius = 0;             ///< of the probes' tip: of the mask of their forces, m
  double force = 0;              ///< N; 0 so that the largest displacement is 1 % of the diagonal
  double tilt = 45;              ///< largest angle of a force from the normal, degrees
  double noise = 0.01;           ///< standard deviation over the largest displacement
  double outliers = 0;    ///< share of displacements that are wrong by as much as the largest
  double missing = 0;     ///< share of displacements that are not seen
  double placeNoise = 0;  ///< standard deviation of places as the rig tells them, each axis, m
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();     ///< of the rig's frame, degrees
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< of the rig's frame, m
  double foundationLength = 0;  ///< E / k of the support, m (MeasuredResponse)
  bool withDeviations = false;  ///< the table tells the noise
  unsigned seed = 1;
};

/// The measurements that such a rig would make of a body that these Green's functions are of. To
/// learn something from them, identify on another discretisation than theirs: markers and contacts
/// are places on the surface at rest, not vertices.
/// @param loadAt  how a unit force at a point of the surface is spread (pointLoad).
/// @throws std::invalid_argument for settings out of range, or Green's functions that lack a
/// column.
Measurements simulateMeasurements(
    const GreensFunctions& greens, const SurfaceMesh& mesh,
    const std::function<SpreadForce(const SurfacePoint&, double radius)>& loadAt,
    const RigSettings& settings);

}  // namespace palpate
