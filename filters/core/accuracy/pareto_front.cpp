// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/pareto_front.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {

std::vector<bool> paretoFront(const std::vector<double>& costs, const std::vector<double>& errors) {
  if (costs.size() != errors.size())
    throw std::invalid_argument("there are " + std::to_string(costs.size()) + " costs and " +
                                std::to_string(errors.size()) + " errors");
  std::vector<bool> isOnFront;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    bool isBeaten = std::isnan(costs[i]) || std::isnan(errors[i]);
    for (std::size_t j = 0; j < costs.size() && !isBeaten; ++j)
      isBeaten = costs[j] <= costs[i] && errors[j] <= errors[i] &&
                 (costs[j] < costs[i] || errors[j] < errors[i]);
    isOnFront.push_back(!isBeaten);
  }
  return isOnFront;
}

}  // namespace palpate
