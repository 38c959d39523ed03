// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>

/// What files are by the endings of their names, in capitals or not.
namespace palpate::app {

/// With its dot, in small letters.
std::string endingOf(const std::string& path);
/// Whether it is a mesh of tetrahedra: .vtu or .vtk.
bool isVolumeFile(const std::string& path);
/// Whether a table is carried by VTK's data, .vtp or .vtu, not written in text.
bool isTableInArrays(const std::string& path);

}  // namespace palpate::app
