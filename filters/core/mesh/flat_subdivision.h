// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "mesh/loop_subdivision.h"
#include "mesh/surface_point.h"

namespace palpate {

/// Every triangle cut in four by the middles of its edges: the same body on a finer mesh, with its
/// sharp edges, where Loop's scheme rounds them.
/// @throws as subdivideLoop.
LoopLevel subdivideFlat(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles);

/// The point of the coarse triangles that a point of the level descends from.
/// @param coarse  3 by #F, what the level was made of.
SurfacePoint parentPoint(const LoopLevel& level, const Eigen::Matrix3Xi& coarse,
                         const SurfacePoint& point);

}  // namespace palpate
