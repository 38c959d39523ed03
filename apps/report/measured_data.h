// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

class vtkPolyData;

namespace palpate::app {

/// A place on the surface of a model.
struct PlaceOnSurface {
  Eigen::Vector3d place, normal;  ///< m; out of the body
};

/// What a marker showed under a probe.
struct Reading {
  int probe, row;
  PlaceOnSurface at;
  Eigen::Vector3d measured, residual;  ///< m; NaN where not measured
  Eigen::Vector3d deviation;           ///< standard, of the residual, m
  bool isOutlier;
};

/// A probe and how it fits.
struct ProbeReading {
  std::string name;
  PlaceOnSurface at;
  Eigen::Vector3d force;  ///< on the body, N
  double radius;          ///< m
  int markers, outliers;
  double residual, relative;  ///< root mean square of a component, m; over the displacements
};

/// A table of measurements and how a model fits it.
struct MeasuredData {
  std::vector<Reading> readings;
  std::vector<ProbeReading> probes;  ///< none where contacts are unknown
  double diagonal;                   ///< of the surface, m
};

/// By the arrays of vtkGreensFunctionIdentification, vtkComplianceCorrection.
MeasuredData measuredDataOf(vtkPolyData* model);

/// The same by those of vtkContactRecovery.
MeasuredData observedDataOf(vtkPolyData* model);

/// Where on the surface of a model a place or a vertex is.
class SurfacePlaces {
 public:
  explicit SurfacePlaces(vtkPolyData* model);
  ~SurfacePlaces();
  PlaceOnSurface at(const Eigen::Vector3d& place) const;
  PlaceOnSurface atVertex(int vertex) const;
  double diagonal() const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

/// A unit in which lengths up to some size are handy.
struct LengthUnit {
  double perMetre;
  std::string name;
};
LengthUnit unitFor(double largest);

}  // namespace palpate::app
