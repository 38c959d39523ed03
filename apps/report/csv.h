// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>

/// Fields of a table of comma-separated values (RFC 4180).
namespace palpate::app::csv {

/// A number in full after its comma; nothing after it for NaN.
std::string field(double value);

/// Text in quotes.
std::string quoted(const std::string& text);

}  // namespace palpate::app::csv
