// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <functional>

#include "identification/measurements.h"

namespace palpate {

/// Where the frame of a sensor is: x of the surface = rotation * x of the sensor + translation.
struct Registration {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotationDeviation = Eigen::Vector3d::Zero();     ///< rad, about x, y, z
  Eigen::Vector3d translationDeviation = Eigen::Vector3d::Zero();  ///< m, of the places' centre
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the places, on the surface, m
  /// What the places leave open: a column a motion of one standard deviation, which vary
  /// independently; its turn about the centre, rad, on its shift, m.
  Eigen::Matrix<double, 6, 6> spread = Eigen::Matrix<double, 6, 6>::Zero();
  double placeDeviation = 0;  ///< standard, of places along an axis, by how far they are off, m
  double distance = 0;        ///< root mean square of the places from the surface, m
};

/// Finds the rigid motion that brings places of markers and contacts onto a surface: robust least
/// squares of their distances from it, from the pose as given on.
/// @throws std::invalid_argument for less than six places given by coordinates, and naming the
///         motion that they do not determine, as rotations of a ball or along a line of markers;
///         std::runtime_error as solveLeastSquares; Aborted.
Registration registerToSurface(const SurfaceMesh& mesh, const Measurements& measurements,
                               const std::function<bool()>& goOn = {});

/// The measurements in the frame of the surface: places, forces and displacements. What is at a
/// vertex stays there. Standard deviations that differ between axes are turned to their mean.
Measurements registered(const Measurements& measurements, const Registration& registration);

}  // namespace palpate
