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
#include "vtkPolyDataAlgorithm.h"

#include <string> // for the path

class PALPATEIO_EXPORT vtkElasticSurfaceReader : public vtkPolyDataAlgorithm
{
public:
  static vtkElasticSurfaceReader* New();
  vtkTypeMacro(vtkElasticSurfaceReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Path of the file.
   */
  void SetFileName(const char* path);
  const char* GetFileName() const { return this->FileName.c_str(); }
  ///@}

  /**
   * The sentence of the last execution's failure, empty if it succeeded.
   */
  const char* GetFailureMessage() const { return this->FailureMessage.c_str(); }

protected:
  vtkElasticSurfaceReader();
  ~vtkElasticSurfaceReader() override = default;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

private:
  vtkElasticSurfaceReader(const vtkElasticSurfaceReader&) = delete;
  void operator=(const vtkElasticSurfaceReader&) = delete;

  std::string FileName, FailureMessage;
};

#endif
