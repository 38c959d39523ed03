// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

#include "mesh/surface_mesh.h"
#include "model/boundary_conditions.h"

namespace palpate {

/// How much of a vertex's traction its triangles bear: on each the traction is the sum over its
/// corners of hat times share times the vertex's traction. Those round a free vertex bear it as it
/// is, share 1. The reaction of a fixed vertex is borne by those of its smooth patches alone that
/// have a wholly fixed triangle there, or by all where none has: there the share is its area over
/// the patches' part of it, so that the force stays area times traction.
/// @param smoothPatches  #F.
/// @return 3 by #F, a share a corner.
Eigen::Matrix3Xd supportShares(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                               const Eigen::VectorXi& smoothPatches);

}  // namespace palpate
