// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <locale>
#include <sstream>
#include <string>

namespace palpate {

/// Whether a word is a finite number from its beginning to its end, in any locale. Readers of text
/// files take the "0.3" of "0.3x7" for a coordinate.
inline bool isNumber(const std::string& word) {
  std::istringstream text(word);
  text.imbue(std::locale::classic());
  double value = 0;
  return (text >> value) && text.peek() == std::istringstream::traits_type::eof();
}

}  // namespace palpate
