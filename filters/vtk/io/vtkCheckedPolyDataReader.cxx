// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkCheckedPolyDataReader.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"

#include <stdexcept>

vtkCheckedPolyDataReader::vtkCheckedPolyDataReader()
{
  this->SetNumberOfInputPorts(0);
}

void vtkCheckedPolyDataReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "FailureMessage: " << this->FailureMessage << "\n";
}

void vtkCheckedPolyDataReader::SetFileName(const char* path)
{
  const std::string value = path ? path : "";
  if (value != this->FileName)
  {
    this->FileName = value;
    this->Modified();
  }
}

int vtkCheckedPolyDataReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  this->FailureMessage.clear();
  try
  {
    this->Read(this->FileName, output);
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
