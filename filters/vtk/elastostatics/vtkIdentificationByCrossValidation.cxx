// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkIdentificationByCrossValidation.h"

#include "array_names.h"
#include "conversion.h"
#include "measurement_arrays.h"
#include "progress.h"
#include "sentence.h"
#include "vtkComplianceCorrection.h"

#include "vtkCallbackCommand.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkIdentificationByCrossValidation);

namespace
{
constexpr double AsGood = 1.05; // an error over the least

/// A kind of model, and how to identify it.
struct Kind
{
  const char* Name;
  std::function<void(vtkPolyData* output)> Identify;
};

double holdOutErrorOf(vtkPolyData* model)
{
  vtkDataArray* array = model->GetFieldData()->GetArray(palpate::arrays::HoldOutError);
  const double error = array ? array->GetComponent(0, 0) : -1;
  return error >= 0 ? error : std::numeric_limits<double>::quiet_NaN();
}

std::vector<std::string> warningsOf(vtkPolyData* model)
{
  std::vector<std::string> warnings;
  auto* array = vtkStringArray::SafeDownCast(
    model->GetFieldData()->GetAbstractArray(palpate::arrays::Warnings));
  for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i)
  {
    warnings.push_back(array->GetValue(i));
  }
  return warnings;
}
} // namespace

vtkIdentificationByCrossValidation::vtkIdentificationByCrossValidation()
{
  this->Method = BOUNDARY_ELEMENTS;
}

/// The table is in the prior's own field data, in its frame and in SI units.
void vtkIdentificationByCrossValidation::Correct(vtkPolyData* prior, vtkPolyData* output)
{
  vtkNew<vtkComplianceCorrection> correction;
  correction->SetInputData(0, prior);
  correction->SetInputData(1, prior);
  correction->SetNumberOfFolds(this->NumberOfFolds);
  correction->SetPlaceTolerance(this->PlaceTolerance);
  correction->SetLeaveOutOutliers(this->Loss != NONE);
  vtkNew<vtkCallbackCommand> silence; // what fails is told by this filter
  correction->AddObserver(vtkCommand::ErrorEvent, silence);
  vtkNew<vtkCallbackCommand> progress;
  progress->SetClientData(this);
  progress->SetCallback(
    [](vtkObject* caller, unsigned long, void* client, void*)
    {
      auto* const self = static_cast<vtkIdentificationByCrossValidation*>(client);
      auto* const filter = static_cast<vtkAlgorithm*>(caller);
      filter->SetAbortExecute(!self->ReportProgress(filter->GetProgress(), "correct"));
    });
  correction->AddObserver(vtkCommand::ProgressEvent, progress);
  correction->Update();
  if (this->GetAbortExecute())
  {
    throw palpate::Aborted();
  }
  if (const std::string failure = correction->GetFailureMessage(); !failure.empty())
  {
    throw std::runtime_error(failure);
  }
  output->ShallowCopy(correction->GetOutput());
}

void vtkIdentificationByCrossValidation::Compute(
  vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs)
{
  if (this->NumberOfFolds < 2)
  {
    palpate::refuse("to choose by cross-validation takes at least two folds, not ", this->NumberOfFolds);
  }
  if (this->NumberOfNextProbes > 0)
  {
    palpate::refuse("further probes are proposed for one material: leave them out, or choose that");
  }
  vtkNew<vtkPolyData> material;
  std::vector<Kind> kinds = { { "material", [&](vtkPolyData* model)
    {
      this->vtkGreensFunctionIdentification::Compute(input, model, inputs);
      material->ShallowCopy(model);
    } } };
  if (this->Method == FINITE_ELEMENTS && !this->YieldingSupport)
  {
    kinds.push_back({ "field", [&](vtkPolyData* model)
      { this->vtkStiffnessFieldIdentification::Compute(input, model, inputs); } });
  }
  kinds.push_back({ "correction", [&](vtkPolyData* model)
    {
      if (material->GetNumberOfPoints() == 0)
      {
        throw std::runtime_error("there is no material to correct");
      }
      this->Correct(material, model);
    } });

  std::vector<vtkSmartPointer<vtkPolyData>> models;
  std::vector<std::string> names, failures;
  std::vector<double> errors;
  for (const Kind& kind : kinds)
  {
    auto model = vtkSmartPointer<vtkPolyData>::New();
    model->ShallowCopy(input);
    names.push_back(kind.Name);
    models.push_back(model);
    errors.push_back(std::numeric_limits<double>::quiet_NaN());
    try
    {
      kind.Identify(model);
      errors.back() = holdOutErrorOf(model);
    }
    catch (const palpate::Aborted&)
    {
      throw;
    }
    catch (const std::bad_alloc&)
    {
      throw;
    }
    catch (const std::exception& failure)
    {
      failures.push_back(palpate::sentence("no ", kind.Name, " was identified: ", failure.what()));
    }
  }
  double least = std::numeric_limits<double>::infinity();
  for (double error : errors)
  {
    least = error < least ? error : least;
  }
  const auto taken =
    std::find_if(errors.begin(), errors.end(), [&](double error) { return error <= AsGood * least; });
  if (taken == errors.end() || std::isinf(least))
  {
    palpate::refuse(failures.empty() ? "probes left out cannot be predicted: measure under more probes"
                                     : failures.front());
  }
  const std::size_t chosen = taken - errors.begin();
  output->ShallowCopy(models[chosen]);
  if (names[chosen] != "field")
  {
    this->GetOutputDataObject(1)->Initialize();
  }
  std::vector<std::string> warnings = warningsOf(output);
  warnings.insert(warnings.end(), failures.begin(), failures.end());
  namespace convert = palpate::convert;
  convert::setFieldStrings(output, palpate::arrays::Warnings, warnings);
  convert::setFieldStrings(output, palpate::arrays::TriedModels, names);
  convert::setColumn(output, palpate::arrays::TriedHoldOutErrors, errors);
}
