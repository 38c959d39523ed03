// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "probed_surface.h"

#include "contact/mask_settings.h"
#include "contact/point_load.h"

#include <utility>

namespace palpate::convert
{
ProbedSurface probedSurface(
  const ElasticModel& model, const Measurements& measurements, double tolerance)
{
  const SurfaceMesh& mesh = model.mesh();
  const BoundaryConditions& conditions = model.conditions();
  const MeasuredPlaces places =
    placesOn(mesh, conditions, measurements, tolerance);
  ProbedSurface probed;
  std::vector<SpreadForce> loads;
  for (std::size_t p = 0; p < places.contacts.size(); ++p)
  {
    const auto masks = makeMasks(
      mesh, conditions, { MaskKind::Linear, measurements.probes[p].radius });
    loads.push_back(pointLoad(*masks, mesh, conditions, places.contacts[p]));
    probed.normals.push_back(mesh.triangleNormals().col(places.contacts[p].triangle));
  }
  probed.setup = measuredSetup(mesh, measurements, places, std::move(loads));
  return probed;
}
} // namespace palpate::convert
