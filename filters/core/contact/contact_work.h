// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

namespace palpate {

/// What a contact solver has computed so far: counted where it computes, but a loop at a time, so
/// that counting costs a few additions a loop.
struct ContactWork {
  double multiplications = 0;  ///< each with its addition; padding included
  double bytes = 0;            ///< of the solver's matrices, read and written

  void add(double products, double numbers) noexcept {
    multiplications += products;
    bytes += 8 * numbers;
  }
  ContactWork& operator+=(const ContactWork& other) noexcept {
    multiplications += other.multiplications;
    bytes += other.bytes;
    return *this;
  }
};

}  // namespace palpate
