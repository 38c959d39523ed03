// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkElasticSurfaceWriter
 * @brief writes a surface with its arrays to a .vtp file, whole or not at all
 *
 * XML with appended raw data, uncompressed, so that every number comes back bit by bit, and a checksum
 * behind it, by which vtkElasticSurfaceReader knows damage. Any VTK reads it. The file is written under
 * another name beside its place and moved there when it is complete.
 */

#ifndef vtkElasticSurfaceWriter_h
#define vtkElasticSurfaceWriter_h

#include "PalpateIOModule.h" // for the export macro
#include "vtkObject.h"

#include <string> // for the message

class vtkPolyData;

class PALPATEIO_EXPORT vtkElasticSurfaceWriter : public vtkObject
{
public:
  static vtkElasticSurfaceWriter* New();
  vtkTypeMacro(vtkElasticSurfaceWriter, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Writes the surface to a path that ends in .vtp. Returns false, with a FailureMessage and an error
   * event, if that cannot be done; an older file then stays as it was.
   */
  bool Write(vtkPolyData* surface, const char* path);

  /**
   * The sentence of the last failure, empty after success.
   */
  const char* GetFailureMessage() const { return this->FailureMessage.c_str(); }

protected:
  vtkElasticSurfaceWriter() = default;
  ~vtkElasticSurfaceWriter() override = default;

private:
  vtkElasticSurfaceWriter(const vtkElasticSurfaceWriter&) = delete;
  void operator=(const vtkElasticSurfaceWriter&) = delete;

  std::string FailureMessage;
};

#endif
