// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace palpate {

/// Words and numbers one after the other.
template <class... Parts>
std::string sentence(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

/// Three digits of a number.
inline std::string shortly(double x) {
  std::ostringstream text;
  text.precision(3);
  text << x;
  return text.str();
}

/// @throws std::invalid_argument that says so.
template <class... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  throw std::invalid_argument(sentence(parts...));
}

}  // namespace palpate
