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

/// A value, and how much of all it is.
struct Share {
  double value, weight;
};

/// The value that has so much of the weight below it.
/// @param shares  at least one.
double weightedQuantile(std::vector<Share> shares, double below);

}  // namespace palpate
