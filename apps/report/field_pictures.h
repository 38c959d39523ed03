// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>

class vtkPolyData;
class vtkUnstructuredGrid;

namespace palpate::app {

/// Slices through a field of stiffness and through its deviation, and where the data see least, as
/// HTML.
/// @param expected  standard deviation of ln E before anything was measured.
std::string fieldText(vtkPolyData* model, vtkUnstructuredGrid* field, double expected);

}  // namespace palpate::app
