// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vector>

namespace palpate {

/// The value that chi squared of three degrees of freedom exceeds with a probability.
double chiSquaredOf(double probability);

/// The standard deviation of normal values about 0 by the median of their sizes, which half of
/// them being wrong does not change much.
/// @param sizes  at least one.
double medianDeviation(std::vector<double> sizes);

}  // namespace palpate
