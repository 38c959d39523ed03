// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>

#include "report/report_option.h"

class vtkPolyData;
class vtkUnstructuredGrid;

/// Pages that need no other file, of what was found from measurements. All throw as drawPicture.
namespace palpate::app {

/// Of `identify` and `correct`.
/// @param field  the volume of a stiffness that varies inside, or null.
std::string identificationPage(vtkPolyData* model, vtkUnstructuredGrid* field,
                               const RunDescription& run);

/// Of `recover`.
std::string recoveryPage(vtkPolyData* model, const RunDescription& run);

}  // namespace palpate::app
