// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "read_surface.h"

#include "vtkCallbackCommand.h"
#include "vtkElasticSurfaceReader.h"
#include "vtkExecutive.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <stdexcept>

namespace palpate
{
void silence(vtkObject* object)
{
  vtkNew<vtkCallbackCommand> nothing;
  nothing->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  object->AddObserver(vtkCommand::ErrorEvent, nothing);
}

vtkSmartPointer<vtkPolyData> readSurface(const std::string& path)
{
  vtkNew<vtkElasticSurfaceReader> reader;
  reader->SetFileName(path.c_str());
  silence(reader);
  silence(reader->GetExecutive());
  reader->Update();
  if (*reader->GetFailureMessage())
  {
    throw std::runtime_error(reader->GetFailureMessage());
  }
  return reader->GetOutput();
}
} // namespace palpate
