// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>

class vtkRenderWindow;

namespace palpate::app {

/// Writes what a window has rendered to a PNG file, whole or not at all.
/// @throws std::runtime_error with a sentence if that cannot be done.
void writePng(vtkRenderWindow* window, const std::string& path);

}  // namespace palpate::app
