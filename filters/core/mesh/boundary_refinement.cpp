// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/loop_subdivision.h"

#include <stdexcept>
#include <string>

namespace palpate {

std::vector<unsigned char> refineBoundaryTypes(const LoopLevel& level,
                                               const std::vector<unsigned char>& types) {
  const int controlCount = level.parents.size() ? level.parents.maxCoeff() + 1 : 0;
  if (static_cast<int>(types.size()) != controlCount)
    throw std::invalid_argument("there are " + std::to_string(types.size()) +
                                " boundary types for " + std::to_string(controlCount) +
                                " control vertices");
  std::vector<unsigned char> fine;
  for (Eigen::Index v = 0; v < level.parents.cols(); ++v)
    fine.push_back(types[level.parents(0, v)] && types[level.parents(1, v)]);
  return fine;
}

}  // namespace palpate
