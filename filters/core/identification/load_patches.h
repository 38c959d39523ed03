// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/surface_mesh.h"

namespace palpate {

/// Where a contact may push: a vertex, as part of one smooth patch of the surface.
struct LoadSite {
  int vertex, patch;
  Eigen::Vector3d axis;  ///< into the body, of length 1: against the patch's normal there
  double area;           ///< of the vertex on the patch
};

/// The sites of vertices, vertex after vertex: several where smooth patches meet.
/// @param patches  #F, as the model's.
std::vector<LoadSite> loadSites(const SurfaceMesh& mesh, const Eigen::VectorXi& patches,
                                const std::vector<int>& vertices);

/// How a force at a site is spread over the sites around it.
struct LoadPatch {
  std::vector<int> sites;      ///< the first is its own
  std::vector<double> shares;  ///< of the force; their sum is 1
};

/// A patch around each site: shares go with areas and like 1 - (r / radius)^2, over sites of the
/// same smooth patch that edges within the radius join to the first and whose axes are within 60
/// degrees of its own. What is behind an edge, a gap or a thin wall is left out.
/// @param radius  m; up to an edge's length it leaves the site alone.
std::vector<LoadPatch> loadPatches(const SurfaceMesh& mesh, const Eigen::VectorXi& patches,
                                   const std::vector<LoadSite>& sites, double radius);

}  // namespace palpate
