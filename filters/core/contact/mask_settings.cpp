// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/mask_settings.h"

#include <stdexcept>
#include <string>

#include "contact/variational_mask.h"

namespace palpate {

std::unique_ptr<const VertexMasks> makeMasks(const SurfaceMesh& mesh,
                                             const BoundaryConditions& conditions,
                                             const MaskSettings& settings) {
  if (settings.kind < MaskKind::Gradient)
    return std::make_unique<PressureMasks>(mesh, conditions, static_cast<MaskShape>(settings.kind),
                                           settings.radius, settings.distance);
  if (!(settings.radius > 0))
    throw std::invalid_argument("a variational mask needs a radius above 0, not " +
                                std::to_string(settings.radius));
  const MaskPenalty penalty =
      settings.kind == MaskKind::Gradient ? MaskPenalty::Gradient : MaskPenalty::Biharmonic;
  return std::make_unique<VariationalMasks>(
      mesh, conditions, penalty, VariationalMasks::lengthForRadius(penalty, settings.radius));
}

}  // namespace palpate
