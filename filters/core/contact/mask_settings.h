// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>

#include "contact/pressure_mask.h"

namespace palpate {

/// All kinds of mask: the radial functionals of MaskShape, in its order, and the variational ones.
enum class MaskKind { Linear, Uniform, Gaussian, Hertzian, Gradient, Biharmonic };

/// A mask as somebody describes it who has no surface yet.
struct MaskSettings {
  MaskKind kind = MaskKind::Linear;
  double radius = 0;  ///< in the mesh's unit; of variational masks see lengthForRadius
  MaskDistance distance = MaskDistance::Euclidean;  ///< of radial functionals
};

/// @param mesh, conditions  must outlive the masks.
/// @throws as PressureMasks and VariationalMasks; std::invalid_argument for a variational mask
///         without radius.
std::unique_ptr<const VertexMasks> makeMasks(const SurfaceMesh& mesh,
                                             const BoundaryConditions& conditions,
                                             const MaskSettings& settings);

}  // namespace palpate
