// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_read_files_h
#define palpate_read_files_h

#include "vtkSmartPointer.h"

#include <string>

class vtkObject;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace palpate
{
/// Keeps an object from printing its errors: what goes wrong is thrown.
void silence(vtkObject* object);

/// @throws std::runtime_error with vtkElasticSurfaceReader's sentence.
vtkSmartPointer<vtkPolyData> readSurface(const std::string& path);

/// @throws std::runtime_error with vtkElasticVolumeReader's sentence.
vtkSmartPointer<vtkUnstructuredGrid> readVolume(const std::string& path);

/// A table of measurements in the field data of a file.
/// @throws std::runtime_error with vtkMeasurementTableReader's sentence.
vtkSmartPointer<vtkPolyData> readTable(const std::string& path);
} // namespace palpate

#endif
