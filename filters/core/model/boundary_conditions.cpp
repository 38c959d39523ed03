// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/boundary_conditions.h"

#include <stdexcept>
#include <string>

namespace palpate {

BoundaryConditions::BoundaryConditions(std::vector<unsigned char> types)
    : types_(std::move(types)) {
  for (std::size_t node = 0; node < types_.size(); ++node)
    if (types_[node] > 1)
      throw std::invalid_argument("the boundary type of node " + std::to_string(node) +
                                  " must be 0 (free) or 1 (fixed), not " +
                                  std::to_string(int(types_[node])));
}

std::vector<int> BoundaryConditions::nodesOf(BoundaryType type) const {
  std::vector<int> nodes;
  for (int node = 0; node < nodeCount(); ++node)
    if (types_[node] == static_cast<unsigned char>(type)) nodes.push_back(node);
  return nodes;
}

}  // namespace palpate
