// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkIdentificationByCrossValidation.h"

#include "array_names.h"
#include "conversion.h"
#include "identification/model_choice.h"
#include "measurement_arrays.h"
#include "progress.h"
#include "sentence.h"
#include "vtkComplianceCorrection.h"

#include "vtkCallbackCommand.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkIdentificationByCrossValidation);

namespace
{
/// A kind of model, and how to identify it.
struct Kind
{
  const char* Name;
  std::function<void(vtkPolyData* output)> Identify;
};

/// What probes left out tell of a model; nothing of one that was not identified.
palpate::TriedModel triedModelOf(vtkPolyData* model)
{
  palpate::TriedModel tried;
  vtkFieldData* fields = model->GetFieldData();
  vtkDataArray* heldOut = fields->GetArray(palpate::arrays::MeasurementHeldOutResidual);
  vtkDataArray* outliers = fields->GetArray(palpate::arrays::MeasurementOutlier);
  if (!heldOut || !outliers)
  {
    return tried;
  }
  tried.heldOut.resize(3, heldOut->GetNumberOfTuples());
  for (vtkIdType i = 0; i < heldOut->GetNumberOfTuples(); ++i)
  {
    heldOut->GetTuple(i, tried.heldOut.col(i).data());
    if (outliers->GetComponent(i, 0) != 0)
    {
      tried.outliers.push_back(static_cast<int>(i));
    }
  }
  return tried;
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
  std::vector<palpate::TriedModel> tried;
  for (const Kind& kind : kinds)
  {
    auto model = vtkSmartPointer<vtkPolyData>::New();
    model->ShallowCopy(input);
    names.push_back(kind.Name);
    models.push_back(model);
    try
    {
      kind.Identify(model);
      tried.push_back(triedModelOf(model));
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
      tried.emplace_back();
      failures.push_back(palpate::sentence("no ", kind.Name, " was identified: ", failure.what()));
    }
  }
  namespace convert = palpate::convert;
  const auto first = std::find_if(tried.begin(), tried.end(),
    [](const palpate::TriedModel& model) { return model.heldOut.size() > 0; });
  if (first == tried.end())
  {
    palpate::refuse(failures.empty() ? "probes left out cannot be predicted: measure under more probes"
                                     : failures.front());
  }
  const palpate::ModelChoice choice =
    palpate::chooseModel(convert::measurementsOf(models[first - tried.begin()]), tried);
  output->ShallowCopy(models[choice.taken]);
  if (names[choice.taken] != "field")
  {
    this->GetOutputDataObject(1)->Initialize();
  }
  std::vector<std::string> warnings = warningsOf(output);
  warnings.insert(warnings.end(), failures.begin(), failures.end());
  convert::setFieldStrings(output, palpate::arrays::Warnings, warnings);
  convert::setFieldStrings(output, palpate::arrays::TriedModels, names);
  convert::setColumn(output, palpate::arrays::TriedHoldOutErrors, choice.errors);
}
