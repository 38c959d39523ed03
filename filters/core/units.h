// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>

namespace palpate {

/// A unit of length in metres: "m", "cm", "mm", "um", "in", "ft".
/// @throws std::invalid_argument naming those that are known.
double lengthUnitNamed(const std::string& name);

/// A unit of force in newtons: "N", "mN", "kN", "MN", "lbf", "kgf".
/// @throws std::invalid_argument naming those that are known.
double forceUnitNamed(const std::string& name);

}  // namespace palpate
