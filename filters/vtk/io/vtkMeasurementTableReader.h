// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkMeasurementTableReader
 * @brief reads a table of measurements that a file of VTK's carries as field data
 *
 * The format follows from the extension: .vtp or .vtu. The output has the file's field data and nothing
 * else: whether it is on a surface, a volume mesh or without any point does not matter. What the arrays
 * are is said in array_names.h (`MeasurementProbe` and on), and checked by the filters that take them as
 * their input of measurements. A file that cannot be read gives one error event with one sentence, also
 * kept as FailureMessage, and an empty output.
 */

#ifndef vtkMeasurementTableReader_h
#define vtkMeasurementTableReader_h

#include "PalpateIOModule.h" // for the export macro
#include "vtkCheckedPolyDataReader.h"

class PALPATEIO_EXPORT vtkMeasurementTableReader : public vtkCheckedPolyDataReader
{
public:
  static vtkMeasurementTableReader* New();
  vtkTypeMacro(vtkMeasurementTableReader, vtkCheckedPolyDataReader);

protected:
  vtkMeasurementTableReader() = default;
  ~vtkMeasurementTableReader() override = default;
  void Read(const std::string& path, vtkPolyData* output) override;

private:
  vtkMeasurementTableReader(const vtkMeasurementTableReader&) = delete;
  void operator=(const vtkMeasurementTableReader&) = delete;
};

#endif
