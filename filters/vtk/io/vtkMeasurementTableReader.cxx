// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkMeasurementTableReader.h"

#include "checked_read.h"
#include "file_checks.h"

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLUnstructuredGridReader.h"
#include "vtksys/SystemTools.hxx"

#include <stdexcept>
#include <string>

vtkStandardNewMacro(vtkMeasurementTableReader);

namespace
{
template <class Reader, class Data>
void readFields(const std::string& path, vtkPolyData* output)
{
  vtkNew<Data> carrier;
  palpate::io::readXml<Reader>(path, carrier.Get());
  output->GetFieldData()->ShallowCopy(carrier->GetFieldData());
}

} // namespace

void vtkMeasurementTableReader::Read(const std::string& path, vtkPolyData* output)
{
  palpate::io::requireReadable(path);
  const std::string extension =
    vtksys::SystemTools::LowerCase(vtksys::SystemTools::GetFilenameLastExtension(path));
  if (extension == ".vtp")
  {
    readFields<vtkXMLPolyDataReader, vtkPolyData>(path, output);
  }
  else if (extension == ".vtu")
  {
    readFields<vtkXMLUnstructuredGridReader, vtkUnstructuredGrid>(path, output);
  }
  else
  {
    throw std::runtime_error("tables of this kind are not read as arrays: choose .vtp or .vtu");
  }
}
