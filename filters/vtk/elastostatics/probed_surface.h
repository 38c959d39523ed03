// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_probed_surface_h
#define palpate_probed_surface_h

#include "identification/measured_response.h"
#include "identification/measurements.h"
#include "model/elastic_model.h"

#include <vector>

/// Measurements on a surface. Not for wrapping.
namespace palpate::convert
{
/// Where a surface is pressed and looked at.
struct ProbedSurface
{
  MeasuredSetup setup;
  std::vector<Eigen::Vector3d> normals; // of the contacts
};

/// Forces spread like cones over their radius.
/// @param tolerance  farthest that a place may be from the surface, m.
/// @throws as placesOn.
ProbedSurface probedSurface(
  const ElasticModel& model, const Measurements& measurements, double tolerance);
} // namespace palpate::convert

#endif
