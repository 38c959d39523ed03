// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "fem/solid_body.h"

namespace palpate::fem {

/// A place in a tetrahedron.
struct SolidProbe {
  int cell;
  Eigen::Vector4d barycentric;
};

/// Where points are in a body; on a face between two cells in one of them.
/// @param points  3 by any, m.
/// @throws std::invalid_argument naming the first point that is not finite or in no tetrahedron.
std::vector<SolidProbe> locateProbes(const SolidBody& body, const Eigen::Matrix3Xd& points);

}  // namespace palpate::fem
