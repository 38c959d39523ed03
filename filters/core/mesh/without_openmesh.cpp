// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What remains of this room's OpenMesh source when the library is built without it.

#include <stdexcept>

#include "mesh/coarsening.h"
#include "mesh/loop_subdivision.h"

namespace palpate {

SubdivisionLevel subdivideLoop(const SurfaceMesh&) {
  throw std::runtime_error(
      "refinement needs OpenMesh, which this build of Palpate was made without");
}

CoarsenedSurface coarsen(const Eigen::Matrix3Xd&, const Eigen::Matrix3Xi&,
                         const std::vector<unsigned char>&, const Eigen::VectorXi&, int) {
  throw std::runtime_error(
      "coarsening needs OpenMesh, which this build of Palpate was made without");
}

}  // namespace palpate
