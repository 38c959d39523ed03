// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkElasticSurfaceWriter.h"

#include "file_checks.h"
#include "whole_file.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataWriter.h"
#include "vtksys/SystemTools.hxx"

#include <stdexcept>

vtkStandardNewMacro(vtkElasticSurfaceWriter);

void vtkElasticSurfaceWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FailureMessage: " << this->FailureMessage << "\n";
}

namespace
{
void writeTo(vtkPolyData* surface, const std::string& path)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(surface);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
  const vtkTypeBool display = vtkObject::GetGlobalWarningDisplay();
  vtkObject::SetGlobalWarningDisplay(0);
  const int written = writer->Write();
  vtkObject::SetGlobalWarningDisplay(display);
  if (!written || writer->GetErrorCode() != 0)
  {
    throw std::runtime_error("the file cannot be written: is the folder there and writable, is the "
                             "disk full?");
  }
}

void writeFile(vtkPolyData* surface, const std::string& path)
{
  const std::string extension = vtksys::SystemTools::LowerCase(
    vtksys::SystemTools::GetFilenameLastExtension(path));
  if (extension != ".vtp")
  {
    throw std::runtime_error("models are written as .vtp: choose a name that ends so");
  }
  palpate::replaceFile(path,
    [surface](const std::string& partial)
    {
      writeTo(surface, partial);
      palpate::io::sealXml(partial);
    });
}
} // namespace

bool vtkElasticSurfaceWriter::Write(vtkPolyData* surface, const char* path)
{
  this->FailureMessage.clear();
  try
  {
    if (!surface || !path)
    {
      throw std::runtime_error("there is nothing to write, or no place");
    }
    writeFile(surface, path);
    return true;
  }
  catch (const std::exception& failure)
  {
    this->FailureMessage = std::string(path ? path : "") + ": " + failure.what();
  }
  vtkErrorMacro(<< this->FailureMessage);
  return false;
}
