// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vtkSmartPointer.h>

#include <string>

class vtkObject;
class vtkPolyData;

namespace palpate::app {

/// Keeps an object from printing its errors: what goes wrong is thrown.
void silence(vtkObject* object);

/// @throws std::runtime_error with the reader's sentence.
vtkSmartPointer<vtkPolyData> readSurface(const std::string& path);

}  // namespace palpate::app
