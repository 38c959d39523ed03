// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vector>

namespace palpate {

/// Median and quartiles of a sample, linear between its members.
struct Quartiles {
  double lower = 0, median = 0, upper = 0;
};

/// @throws std::invalid_argument for an empty sample.
Quartiles quartilesOf(std::vector<double> sample);

}  // namespace palpate
