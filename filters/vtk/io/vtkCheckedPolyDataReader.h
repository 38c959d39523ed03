// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkCheckedPolyDataReader
 * @brief what readers of files into polydata have in common
 *
 * A file that cannot be read gives one error event with one sentence, also kept as FailureMessage, and an
 * empty output.
 */

#ifndef vtkCheckedPolyDataReader_h
#define vtkCheckedPolyDataReader_h

#include "PalpateIOModule.h" // for the export macro
#include "vtkPolyDataAlgorithm.h"

#include <string> // for the path

class PALPATEIO_EXPORT vtkCheckedPolyDataReader : public vtkPolyDataAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkCheckedPolyDataReader, vtkPolyDataAlgorithm);
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
  vtkCheckedPolyDataReader();
  ~vtkCheckedPolyDataReader() override = default;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

  /**
   * Throws std::exception with what is wrong with the file, without its name.
   */
  virtual void Read(const std::string& path, vtkPolyData* output) = 0;

private:
  vtkCheckedPolyDataReader(const vtkCheckedPolyDataReader&) = delete;
  void operator=(const vtkCheckedPolyDataReader&) = delete;

  std::string FileName, FailureMessage;
};

#endif
