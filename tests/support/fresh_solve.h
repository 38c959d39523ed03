// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vector>

#include "support/contact_bodies.h"

namespace palpate::test {

struct Nodal {
  Eigen::Matrix3Xd displacement, traction;
};

/// The exchanged system assembled and solved as a problem of its own.
/// @param exchanged  free nodes to fix and fixed nodes to release.
/// @param given      3 by #nodes: what the exchanged problem prescribes.
inline Nodal solveAfresh(const Shape& shape, const GreensFunctions& reference,
                         const std::vector<int>& exchanged, const Eigen::Matrix3Xd& given) {
  std::vector<unsigned char> types = reference.info().conditions.types();
  for (int node : exchanged) types[node] = !types[node];
  const TouchedBody fresh = touchedBody(shape, types, false, reference.info().domain);
  Nodal solution{solveReferenceProblem(*fresh.greens, given), given};
  for (int node = 0; node < given.cols(); ++node)
    if (fresh.greens->isFixed(node))
      solution.displacement.col(node).swap(solution.traction.col(node));
  return solution;
}

}  // namespace palpate::test
