// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkElasticSurfaceReader
 * @brief reads a surface, with its Green's functions if it has them, from a file
 *
 * The format follows from the extension: .vtp, .stl, .obj, .ply or .off. What was read is checked to be
 * consistent (cells refer to points that exist, arrays have a tuple a point or cell) before it is
 * output; a file that cannot be read gives one error event with one sentence, also kept as
 * FailureMessage, and an empty output.
 */

#ifndef vtkElasticSurfaceReader_h
#define vtkElasticSurfaceReader_h

#include "PalpateIOModule.h" // for the export macro
#include "vtkCheckedPolyDataReader.h"

class PALPATEIO_EXPORT vtkElasticSurfaceReader : public vtkCheckedPolyDataReader
{
public:
  static vtkElasticSurfaceReader* New();
  vtkTypeMacro(vtkElasticSurfaceReader, vtkCheckedPolyDataReader);

protected:
  vtkElasticSurfaceReader() = default;
  ~vtkElasticSurfaceReader() override = default;
  void Read(const std::string& path, vtkPolyData* output) override;

private:
  vtkElasticSurfaceReader(const vtkElasticSurfaceReader&) = delete;
  void operator=(const vtkElasticSurfaceReader&) = delete;
};

#endif
