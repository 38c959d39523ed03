// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <array>
#include <string>
#include <vector>

namespace palpate::app {

/// Lines, marks and words on paper, of which both SVG and pictures are made. Places are counted
/// from the upper left corner, in pixels; colours are #rrggbb.
struct Drawing {
  struct Line {
    std::vector<std::array<double, 2>> points;
    std::string colour;
    double width = 1;
    bool isDashed = false;
  };
  struct Mark {
    double x, y, radius;
    std::string colour;
    bool isHollow = false;
  };
  enum class Anchor { Start, Middle, End };
  struct Label {
    double x, y;  ///< of the base line
    std::string text;
    Anchor anchor = Anchor::Start;
    double size = 13;
    bool isUpwards = false;  ///< read from below
  };

  double width = 0, height = 0;
  std::vector<Line> lines;
  std::vector<Mark> marks;  ///< over the lines
  std::vector<Label> labels;
};

/// A drawing as SVG.
/// @param description  for those who cannot see it.
/// @param isFile       a file's whole text on white, or an element of a page.
std::string svgOf(const Drawing& drawing, const std::string& description, bool isFile);

/// Writes a drawing to a PNG file, twice its size, whole or not at all. Loads the drawing library.
/// @throws std::runtime_error with a sentence if that cannot be done.
void drawDrawing(const Drawing& drawing, const std::string& path);

/// Name of the function in the drawing library.
constexpr const char* kDrawDrawingFunction = "palpate_draw_drawing";
/// @return an empty string, or what went wrong.
using DrawDrawingFunction = std::string (*)(const Drawing& drawing, const std::string& path);

}  // namespace palpate::app
