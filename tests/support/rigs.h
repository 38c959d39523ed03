// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>
#include <vector>

#include "contact/point_load.h"
#include "identification/material_identification.h"
#include "identification/rig_simulation.h"
#include "support/problems.h"

namespace palpate::test {

/// How forces are spread on a model, by linear masks.
inline SpreadForce loadOn(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                          const SurfacePoint& point, double radius) {
  return pointLoad(PressureMasks(mesh, conditions, MaskShape::Linear, radius), mesh, conditions,
                   point);
}

/// A body on a rig.
inline Measurements measuredOn(const std::shared_ptr<const GreensFunctions>& greens,
                               const SurfaceMesh& mesh, const RigSettings& settings) {
  return simulateMeasurements(
      *greens, mesh,
      [&](const SurfacePoint& point, double radius) {
        return loadOn(mesh, greens->info().conditions, point, radius);
      },
      settings);
}

/// All nodes' columns: of fixed ones, too.
inline std::vector<int> allNodes(const ElasticModel& model) {
  std::vector<int> nodes(model.mesh().vertexCount());
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = static_cast<int>(i);
  return nodes;
}

/// What measurements are looked at with on a model.
struct RigSetup {
  MeasuredSetup setup;
  std::vector<Eigen::Vector3d> normals;
};

inline RigSetup setupOn(const ElasticModel& model, const Measurements& measurements) {
  const SurfaceMesh& mesh = model.mesh();
  const MeasuredPlaces places =
      placesOn(mesh, model.conditions(), measurements, 0.05 * mesh.diagonal());
  RigSetup result;
  std::vector<SpreadForce> loads;
  for (std::size_t p = 0; p < places.contacts.size(); ++p) {
    loads.push_back(
        loadOn(mesh, model.conditions(), places.contacts[p], measurements.probes[p].radius));
    result.normals.push_back(mesh.triangleNormals().col(places.contacts[p].triangle));
  }
  result.setup = measuredSetup(mesh, measurements, places, std::move(loads));
  return result;
}

/// Identification by boundary elements on a model; its material is not looked at.
inline MaterialIdentifier identifierOn(const ElasticModel& model, const Measurements& measurements,
                                       const IdentificationOptions& options = {}) {
  const RigSetup rig = setupOn(model, measurements);
  const auto responseOf = [&](const std::vector<Material>& materials, const Progress&) {
    const ElasticModel here(model.sharedMesh(), materials.front(), model.conditions(),
                            model.smoothPatches());
    BoundaryElementOptions how;
    if (options.unknowns.support) how.columns = allNodes(model);
    const auto greens = computeBoundaryElementGreensFunctions(here, how).take();
    return MeasuredResponse(*greens, rig.setup, options.unknowns.support);
  };
  return MaterialIdentifier(responseOf, rig.setup, model.mesh().diagonal(), rig.normals, options);
}

}  // namespace palpate::test
