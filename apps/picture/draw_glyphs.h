// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "picture/picture.h"

class vtkRenderer;
class vtkScalarsToColors;

namespace palpate::app {

/// Adds a view's glyphs and, where they do not cover one another, their labels.
/// @param renderer  with its camera, in a window of its size.
void addGlyphs(vtkRenderer* renderer, const View& view, vtkScalarsToColors* colours);

}  // namespace palpate::app
