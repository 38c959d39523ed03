// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "checked_read.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"

namespace palpate::io
{
QuietRead::QuietRead(vtkAlgorithm* reader)
  : DisplayBefore(vtkObject::GetGlobalWarningDisplay())
{
  vtkObject::SetGlobalWarningDisplay(0);
  vtkNew<vtkCallbackCommand> note;
  note->SetClientData(&this->Failed);
  note->SetCallback([](vtkObject*, unsigned long, void* failed, void*)
    { *static_cast<bool*>(failed) = true; });
  reader->AddObserver(vtkCommand::ErrorEvent, note);
}

QuietRead::~QuietRead()
{
  vtkObject::SetGlobalWarningDisplay(this->DisplayBefore);
}

void requireConsistentCells(vtkCellArray* cells, vtkIdType pointCount)
{
  if (!cells || cells->GetNumberOfCells() == 0)
  {
    return;
  }
  if (!cells->IsValid())
  {
    throw std::runtime_error("the file's cells are damaged");
  }
  vtkDataArray* corners = cells->GetConnectivityArray();
  for (vtkIdType i = 0; i < corners->GetNumberOfTuples(); ++i)
  {
    const double corner = corners->GetComponent(i, 0);
    if (!(corner >= 0 && corner < pointCount))
    {
      throw std::runtime_error("a cell refers to point " +
        std::to_string(static_cast<long long>(corner)) + ", but there are only " +
        std::to_string(pointCount));
    }
  }
}

void requireConsistentArrays(vtkDataSetAttributes* attributes, vtkIdType count, const char* what)
{
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = attributes->GetAbstractArray(i);
    if (array->GetNumberOfTuples() != count)
    {
      throw std::runtime_error(std::string("the array '") +
        (array->GetName() ? array->GetName() : "") + "' does not have a tuple a " + what);
    }
  }
}
} // namespace palpate::io
