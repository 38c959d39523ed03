// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkMeasurementTableReader.h"

#include "checked_read.h"
#include "file_checks.h"

#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
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

vtkMeasurementTableReader::vtkMeasurementTableReader()
{
  this->SetNumberOfInputPorts(0);
}

void vtkMeasurementTableReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "FailureMessage: " << this->FailureMessage << "\n";
}

void vtkMeasurementTableReader::SetFileName(const char* path)
{
  const std::string value = path ? path : "";
  if (value != this->FileName)
  {
    this->FileName = value;
    this->Modified();
  }
}

namespace
{
template <class Reader, class Data>
void readFields(const std::string& path, vtkPolyData* output)
{
  vtkNew<Data> carrier;
  if (palpate::io::requireWholeXml(path))
  {
    palpate::io::readWith<Reader>(path, carrier.Get());
  }
  else
  {
    palpate::io::readWarily<Reader>(path, carrier.Get());
  }
  output->GetFieldData()->ShallowCopy(carrier->GetFieldData());
}

void readFile(const std::string& path, vtkPolyData* output)
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
} // namespace

int vtkMeasurementTableReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  this->FailureMessage.clear();
  try
  {
    readFile(this->FileName, output);
    return 1;
  }
  catch (const std::exception& failure)
  {
    this->FailureMessage = this->FileName + ": " + failure.what();
  }
  output->Initialize();
  vtkErrorMacro(<< this->FailureMessage);
  return 0;
}
