// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vector>

namespace palpate {

/// Which of several ways nothing beats: no other is as good in one respect and better in the other.
/// @param costs, errors  one each a way, the less the better. A way with a NaN is never of the
/// front.
/// @return one flag a way; equal ways are all of the front, or none.
/// @throws std::invalid_argument if there is not one of each.
std::vector<bool> paretoFront(const std::vector<double>& costs, const std::vector<double>& errors);

}  // namespace palpate
