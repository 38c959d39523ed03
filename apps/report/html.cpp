// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/html.h"

#include <vtksys/Base64.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace palpate::app::html {
namespace {

constexpr const char* kStyle = R"(
body { font: 16px/1.5 system-ui, sans-serif; color: #22222a; background: #fff; margin: 2rem auto;
       max-width: 76rem; padding: 0 1rem; }
h1 { font-size: 1.7rem; margin-bottom: .2rem; } h2 { font-size: 1.25rem; margin-top: 2.5rem; }
p, li { max-width: 52rem; } .lead { font-size: 1.1rem; }
figure { margin: 1rem 0 2rem; } figcaption { color: #55555e; font-size: .92rem; max-width: 52rem; }
img { max-width: 100%; height: auto; display: block; } .row { display: flex; align-items: flex-start; }
.row > div { min-width: 0; }
.wide { overflow-x: auto; } table { border-collapse: collapse; font-size: .9rem; margin: .8rem 0; }
th { text-align: right; font-weight: 600; border-bottom: 2px solid #22222a; vertical-align: bottom; }
td { text-align: right; border-bottom: 1px solid #d9d9e0; font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .7rem; } th:first-child, td:first-child { text-align: left; }
.pairs thead { display: none; } .pairs td { text-align: left; }
@media print { body { max-width: none; } figure, table { break-inside: avoid; } }
)";

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string picture(const std::string& path, const std::string& description) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file || bytes.empty()) throw std::runtime_error("a picture could not be read again");
  std::string text(4 * ((bytes.size() + 2) / 3), '\0');
  text.resize(vtksysBase64_Encode(reinterpret_cast<const unsigned char*>(bytes.data()),
                                  bytes.size(), reinterpret_cast<unsigned char*>(text.data()), 0));
  return "<img alt=\"" + escaped(description) + "\" src=\"data:image/png;base64," + text + "\">";
}

std::string table(const std::vector<std::string>& head,
                  const std::vector<std::vector<std::string>>& rows) {
  std::string result = "<div class=\"wide\"><table><thead><tr>";
  for (const std::string& cell : head) result += "<th>" + cell + "</th>";
  result += "</tr></thead><tbody>\n";
  for (const auto& row : rows) {
    result += "<tr>";
    for (const std::string& cell : row) result += "<td>" + cell + "</td>";
    result += "</tr>\n";
  }
  return result + "</tbody></table></div>\n";
}

std::string page(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         escaped(title) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n" + body +
         "</body>\n</html>\n";
}

}  // namespace palpate::app::html
