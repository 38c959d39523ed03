// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

namespace palpate {

/// Whether any material has such a Young's modulus, from the softest gels to diamond, Pa. One that
/// none has tells of units that were mistaken.
constexpr bool isPlausibleModulus(double modulus) {
  return modulus >= 1 && modulus <= 1e13;
}

}  // namespace palpate
