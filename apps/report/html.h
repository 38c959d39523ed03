// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>
#include <vector>

/// Pieces of a page that needs no other file.
namespace palpate::app::html {

/// Text as it stands, for elements and attributes.
std::string escaped(const std::string& text);

/// A picture within the page.
/// @param path  of a PNG file.
/// @throws std::runtime_error if it cannot be read.
std::string picture(const std::string& path, const std::string& description);

/// A table; the cells are HTML.
std::string table(const std::vector<std::string>& head,
                  const std::vector<std::vector<std::string>>& rows);

/// The whole page.
std::string page(const std::string& title, const std::string& body);

}  // namespace palpate::app::html
