// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_measurement_arrays_h
#define palpate_measurement_arrays_h

#include "identification/measurements.h"

#include <string>
#include <vector>

class vtkPolyData;

/// Tables of measurements as field data (see array_names.h). Not for wrapping. All functions throw
/// std::invalid_argument with a sentence for data that cannot be used.
namespace palpate::convert
{
/// A table, sound (palpate::requireSound).
/// @param length, force  units of the table, m and N.
Measurements measurementsOf(vtkPolyData* table, double length = 1, double force = 1);

/// The same of what moves under unknown contacts: without arrays of probes but their names, and of one
/// where MeasurementProbe is missing.
Measurements observationsOf(vtkPolyData* table, double length = 1);

/// The same from an input or a file, one of the two, in units by name.
/// @param table  null for none.
/// @param file   empty for none.
Measurements measurementsFrom(vtkPolyData* table, const std::string& file,
  const std::string& lengthUnit, const std::string& forceUnit);
Measurements observationsFrom(
  vtkPolyData* table, const std::string& file, const std::string& lengthUnit);

/// Adds a table, in place of one that is there.
void setMeasurements(vtkPolyData* table, const Measurements& measurements);

/// Field vectors, a tuple a column; unlike setFieldVectors' with NaN for what was not measured.
void setVectorsWithGaps(vtkPolyData* table, const char* name, const Eigen::Matrix3Xd& values);
void setColumn(vtkPolyData* table, const char* name, const std::vector<double>& values);
} // namespace palpate::convert

#endif
