// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mesh/surface_mesh.h"
#include "mesh/surface_point.h"
#include "model/boundary_conditions.h"

namespace palpate {

/// A place on the surface at rest: a vertex by its number, or any point by its coordinates.
struct RestPlace {
  int vertex = -1;                                  ///< -1 where the point is given
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< m
};

/// A force that pressed on the body while displacements were measured.
struct Probe {
  std::string name;  ///< for sentences: what the table calls it
  RestPlace contact;
  double radius = 0;  ///< of the mask that spreads the force, m; 0 for a single vertex
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< on the body, N
};

/// What was measured at a marker under one probe.
struct MeasuredDisplacement {
  int probe = 0;  ///< index into Measurements::probes
  RestPlace marker;
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< m; NaN where not measured
  Eigen::Vector3d deviation = Eigen::Vector3d::Zero();     ///< standard, m; 0 where not known
  int row = 0;                                             ///< of the table, for sentences
};

/// A table of displacements of a real object under known forces, as readMeasurementFile gives it.
struct Measurements {
  std::vector<Probe> probes;
  std::vector<MeasuredDisplacement> displacements;
  std::string source;            ///< for people: the file
  std::string rowWord = "line";  ///< what `row` counts
  bool hasForces = true;         ///< else probes are names of what presses, nobody knows where

  /// "data.csv, line 7".
  std::string nameOf(const MeasuredDisplacement& measured) const;
  bool hasDeviations() const {
    return !displacements.empty() && displacements.front().deviation.maxCoeff() > 0;
  }
  /// Measured components, at most three a displacement.
  int valueCount() const;
};

/// @throws std::invalid_argument naming the row: no measurement, a number that is not finite, a
///         probe without force or contact, rows that repeat or contradict each other, standard
///         deviations that some rows have and others have not.
void requireSound(const Measurements& measurements);

/// The points of a surface nearest to markers.
/// @throws as placesOn, of markers.
std::vector<SurfacePoint> markersOn(const SurfaceMesh& mesh, const Measurements& measurements,
                                    double tolerance);

/// Where probes and markers are on the surface of a model.
struct MeasuredPlaces {
  std::vector<SurfacePoint> contacts;  ///< #probes
  std::vector<SurfacePoint> markers;   ///< #displacements
};

/// The points of a surface nearest to contacts and markers.
/// @param tolerance  farthest that a place may be from the surface, m.
/// @throws std::invalid_argument naming the row: a vertex that the surface does not have, a place
///         off the surface (with the unit of length that it seems to be in), a contact on the
///         support alone, a tip or displacements larger than the body.
MeasuredPlaces placesOn(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                        const Measurements& measurements, double tolerance);

}  // namespace palpate
