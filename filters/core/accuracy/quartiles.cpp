// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/quartiles.h"

#include <algorithm>
#include <stdexcept>

namespace palpate {

Quartiles quartilesOf(std::vector<double> sample) {
  if (sample.empty()) throw std::invalid_argument("an empty sample has no quartiles");
  std::sort(sample.begin(), sample.end());
  const auto at = [&](double share) {
    const double place = share * static_cast<double>(sample.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sample.size() - 1);
    return sample[below] + (place - static_cast<double>(below)) * (sample[above] - sample[below]);
  };
  return {at(0.25), at(0.5), at(0.75)};
}

}  // namespace palpate
