// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

class vtkPolyData;

namespace palpate::app {

/// Something small on a surface or beside it.
struct Glyph {
  enum class Kind { Ball, Ring, Arrow };
  Kind kind;
  std::array<double, 3> place;       ///< its middle; an arrow's foot, m
  std::array<double, 3> arrow = {};  ///< from foot to tip, m
  std::optional<double> value = {};  ///< coloured by; without, rings are red and arrows dark
  std::string label = {};            ///< at its foot, if there is room
};

/// What one view of a picture shows.
struct View {
  vtkPolyData* surface;
  std::string title;
  std::string
      colourBy;  ///< point or cell array; vectors by their length. Empty: fixed or free vertices
  std::string barTitle;
  bool deformed = false;                       ///< moved by the array Displacement
  std::optional<std::array<double, 2>> range;  ///< of the colours; the array's by default
  bool logarithmic = false;                    ///< equal ratios as equal steps of colour
  bool hasEdges = true;
  std::vector<Glyph> glyphs = {};  ///< their values are coloured over the range
  double glyphRadius = 0;          ///< of balls, m
  std::optional<std::array<double, 3>> towardsViewer = {};  ///< of this view alone
};

/// Views side by side, to one scale.
struct Picture {
  std::vector<View> views;
  std::array<double, 3> towardsViewer = {};  ///< direction from the object to the eye
  int width = 1200, height = 600;
  bool sharesBar = false;  ///< one colour bar, of the first view, beside them all
};

/// Draws a picture to a PNG file, whole or not at all. Loads the drawing library on first use.
/// @throws std::runtime_error with a sentence if that cannot be done.
void drawPicture(const Picture& picture, const std::string& path);

/// Name of the function in the drawing library.
constexpr const char* kDrawFunction = "palpate_draw_picture";
/// @return an empty string, or what went wrong.
using DrawFunction = std::string (*)(const Picture& picture, const std::string& path);

/// A direction from which most of the free surface is seen.
std::array<double, 3> directionOntoFreeSurface(vtkPolyData* surface);

}  // namespace palpate::app
