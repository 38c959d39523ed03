// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/page_parts.h"

#include <cmath>

#include "report/html.h"
#include "report/temporary_picture.h"
#include "terminal.h"

namespace palpate::app {

std::string cell(double value) {
  return std::isnan(value) ? "–" : number(value, 3);
}

std::string drawn(const Picture& picture, const std::string& description) {
  const TemporaryPicture file;
  drawPicture(picture, file.path());
  return html::picture(file.path(), description);
}

std::string figure(const std::string& content, const std::string& caption) {
  return "<figure>" + content + "<figcaption>" + caption + "</figcaption></figure>\n";
}

}  // namespace palpate::app
