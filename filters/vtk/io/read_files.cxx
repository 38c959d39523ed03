// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "read_files.h"

#include "vtkCallbackCommand.h"
#include "vtkElasticSurfaceReader.h"
#include "vtkElasticVolumeReader.h"
#include "vtkExecutive.h"
#include "vtkMeasurementTableReader.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <stdexcept>

namespace palpate
{
void silence(vtkObject* object)
{
  vtkNew<vtkCallbackCommand> nothing;
  nothing->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  object->AddObserver(vtkCommand::ErrorEvent, nothing);
}

namespace
{
template <class Reader>
auto readFile(const std::string& path)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  silence(reader);
  silence(reader->GetExecutive());
  reader->Update();
  if (*reader->GetFailureMessage())
  {
    throw std::runtime_error(reader->GetFailureMessage());
  }
  return vtk::MakeSmartPointer(reader->GetOutput());
}
} // namespace

vtkSmartPointer<vtkPolyData> readSurface(const std::string& path)
{
  return readFile<vtkElasticSurfaceReader>(path);
}

vtkSmartPointer<vtkUnstructuredGrid> readVolume(const std::string& path)
{
  return readFile<vtkElasticVolumeReader>(path);
}

vtkSmartPointer<vtkPolyData> readTable(const std::string& path)
{
  return readFile<vtkMeasurementTableReader>(path);
}
} // namespace palpate
