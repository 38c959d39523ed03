// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <string>

namespace palpate::app {

/// For options: a finite number, which CLI11's own ranges do not ask for.
inline CLI::Validator isFinite() {
  return CLI::Validator(
      [](const std::string& text) {
        return std::isfinite(std::strtod(text.c_str(), nullptr)) ? ""
                                                                 : "not a finite number: " + text;
      },
      "");
}

}  // namespace palpate::app
