// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/loop_subdivision.h"

namespace palpate {

std::vector<unsigned char> refineBoundaryTypes(const LoopLevel& level,
                                               const std::vector<unsigned char>& types) {
  std::vector<unsigned char> fine;
  for (Eigen::Index v = 0; v < level.parents.cols(); ++v)
    fine.push_back(types[level.parents(0, v)] && types[level.parents(1, v)]);
  return fine;
}

}  // namespace palpate
