// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace palpate {

/// An integer of HID's byte order, least significant byte first.
template <class Integer>
Integer readLittleEndian(const std::uint8_t* bytes) noexcept {
  std::make_unsigned_t<Integer> value = 0;
  for (std::size_t i = 0; i < sizeof(Integer); ++i)
    value |= static_cast<std::make_unsigned_t<Integer>>(std::uint64_t{bytes[i]} << (8 * i));
  return static_cast<Integer>(value);
}

template <class Integer>
void writeLittleEndian(Integer value, std::uint8_t* bytes) noexcept {
  for (std::size_t i = 0; i < sizeof(Integer); ++i)
    bytes[i] =
        static_cast<std::uint8_t>(static_cast<std::make_unsigned_t<Integer>>(value) >> (8 * i));
}

/// The integer nearest to a number; the type's end beyond it, 0 for what is no number.
template <class Integer>
Integer saturated(double value) noexcept {
  static_assert(sizeof(Integer) <= 4, "a double holds all values");
  if (std::isnan(value)) return 0;
  constexpr double least = std::numeric_limits<Integer>::min();
  constexpr double most = std::numeric_limits<Integer>::max();
  return static_cast<Integer>(std::nearbyint(value < least ? least : value > most ? most : value));
}

}  // namespace palpate
