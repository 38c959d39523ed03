// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "contact/pressure_mask.h"
#include "greens/spread_force.h"
#include "mesh/surface_point.h"

namespace palpate {

/// A force anywhere on the surface through its vertices' masks (eq. 35): each free vertex of the
/// triangle carries its barycentric share, spread by its mask. The share of a fixed vertex goes
/// into the support.
/// @throws as VertexMasks::at.
SpreadForce pointLoad(const VertexMasks& masks, const SurfaceMesh& mesh,
                      const BoundaryConditions& conditions, const SurfacePoint& point);

}  // namespace palpate
