// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/robust_statistics.h"

#include <algorithm>
#include <cmath>

namespace palpate {

double chiSquaredOf(double probability) {
  const auto beyond = [](double x) {
    return std::erfc(std::sqrt(x / 2)) + std::sqrt(2 * x / M_PI) * std::exp(-x / 2);
  };
  double low = 0, high = 1000;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (beyond(middle) > probability ? low : high) = middle;
  }
  return high;
}

double medianDeviation(std::vector<double> sizes) {
  constexpr double kNormal = 1.482602218505602;  // 1 over the quantile of 3/4
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return kNormal * *middle;
}

double weightedQuantile(std::vector<Share> shares, double below) {
  std::sort(shares.begin(), shares.end(), [](auto& a, auto& b) { return a.value < b.value; });
  double left = 0;
  for (const Share& share : shares) left += below * share.weight;
  for (const Share& share : shares)
    if ((left -= share.weight) <= 0) return share.value;
  return shares.back().value;
}

}  // namespace palpate
