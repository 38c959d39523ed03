// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/csv.h"

#include <cmath>

#include "terminal.h"

namespace palpate::app::csv {

std::string field(double value) {
  return "," + (std::isnan(value) ? std::string() : number(value, 9));
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

}  // namespace palpate::app::csv
