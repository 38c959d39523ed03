// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkElastostaticAlgorithm.h"

#include "progress.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"

#include <new>

void vtkElastostaticAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FailureMessage: " << this->FailureMessage << "\n";
}

bool vtkElastostaticAlgorithm::ReportProgress(double fraction, const char* stage)
{
  this->SetProgressText(stage);
  this->UpdateProgress(fraction);
  return !this->GetAbortExecute();
}

void vtkElastostaticAlgorithm::SetName(std::string& member, const char* name)
{
  const std::string value = name ? name : "";
  if (value != member)
  {
    member = value;
    this->Modified();
  }
}

int vtkElastostaticAlgorithm::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  this->FailureMessage.clear();
  try
  {
    if (input)
    {
      output->ShallowCopy(input);
    }
    this->Compute(input, output, inputs);
    return 1;
  }
  catch (const palpate::Aborted&)
  {
    output->Initialize();
    return 1;
  }
  catch (const std::bad_alloc&)
  {
    this->FailureMessage = "there is not enough memory for this surface's matrices";
  }
  catch (const std::exception& failure)
  {
    this->FailureMessage = failure.what();
  }
  output->Initialize();
  vtkErrorMacro(<< this->FailureMessage);
  return 0;
}
