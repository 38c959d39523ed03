// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>

#include "picture/picture.h"

/// What the pages of studies and identifications share.
namespace palpate::app {

/// A number of a table: three digits, a dash for NaN.
std::string cell(double value);

/// A picture, drawn and within the page.
/// @throws as drawPicture.
std::string drawn(const Picture& picture, const std::string& description);

/// @param content, caption  HTML.
std::string figure(const std::string& content, const std::string& caption);

}  // namespace palpate::app
