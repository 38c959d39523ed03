// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkElasticVolumeReader
 * @brief reads a volume mesh from a file
 *
 * The format follows from the extension: .vtu, or .vtk (legacy). What was read is checked to be
 * consistent (cells refer to points that exist and have as many corners as their type, arrays have a
 * tuple a point or cell) before it is output; a file that cannot be read gives one error event with one
 * sentence, also kept as FailureMessage, and an empty output.
 */

#ifndef vtkElasticVolumeReader_h
#define vtkElasticVolumeReader_h

#include "PalpateIOModule.h" // for the export macro
#include "vtkUnstructuredGridAlgorithm.h"

#include <string> // for the path

class PALPATEIO_EXPORT vtkElasticVolumeReader : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkElasticVolumeReader* New();
  vtkTypeMacro(vtkElasticVolumeReader, vtkUnstructuredGridAlgorithm);
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
  vtkElasticVolumeReader();
  ~vtkElasticVolumeReader() override = default;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

private:
  vtkElasticVolumeReader(const vtkElasticVolumeReader&) = delete;
  void operator=(const vtkElasticVolumeReader&) = delete;

  std::string FileName, FailureMessage;
};

#endif
