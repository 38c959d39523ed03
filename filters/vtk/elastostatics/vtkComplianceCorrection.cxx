// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkComplianceCorrection.h"

#include "array_names.h"
#include "conversion.h"
#include "identification/compliance_correction.h"
#include "identified_material.h"
#include "identification_arrays.h"
#include "measurement_arrays.h"
#include "model_arrays.h"
#include "probed_surface.h"
#include "sentence.h"

#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <utility>

vtkStandardNewMacro(vtkComplianceCorrection);

vtkComplianceCorrection::vtkComplianceCorrection()
{
  this->SetNumberOfInputPorts(2);
}

void vtkComplianceCorrection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MeasurementFileName: " << this->MeasurementFileName << "\n"
     << indent << "LengthUnit: " << this->LengthUnit << "\n"
     << indent << "ForceUnit: " << this->ForceUnit << "\n"
     << indent << "NumberOfModes: " << this->NumberOfModes << "\n"
     << indent << "Smoothing: " << this->Smoothing << "\n"
     << indent << "NumberOfFolds: " << this->NumberOfFolds << "\n"
     << indent << "LeaveOutOutliers: " << this->LeaveOutOutliers << "\n"
     << indent << "PlaceTolerance: " << this->PlaceTolerance << "\n";
}

void vtkComplianceCorrection::SetMeasurementFileName(const char* name)
{
  this->SetName(this->MeasurementFileName, name);
}

void vtkComplianceCorrection::SetLengthUnit(const char* unit)
{
  this->SetName(this->LengthUnit, unit);
}

void vtkComplianceCorrection::SetForceUnit(const char* unit)
{
  this->SetName(this->ForceUnit, unit);
}

int vtkComplianceCorrection::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

void vtkComplianceCorrection::Compute(
  vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs)
{
  namespace convert = palpate::convert;
  if (!(this->PlaceTolerance >= 0 && this->PlaceTolerance <= 1))
  {
    palpate::refuse("the tolerance of places must be from 0 to 1, not ", this->PlaceTolerance);
  }
  const palpate::Measurements measurements =
    convert::measurementsFrom(vtkPolyData::GetData(inputs[1]), this->MeasurementFileName,
      this->LengthUnit, this->ForceUnit);
  const convert::ServedModel served = convert::servedModelOf(input);
  const palpate::GreensFunctionsInfo& info = served.greens->info();
  const palpate::ElasticModel model(
    served.mesh, info.material, info.conditions, served.smoothPatches, info.domain);
  const convert::ProbedSurface probed =
    convert::probedSurface(model, measurements, this->PlaceTolerance * served.mesh->diagonal());
  palpate::CorrectionOptions options;
  options.modes = this->NumberOfModes;
  options.smoothing = this->Smoothing;
  options.folds = this->NumberOfFolds;
  options.leaveOutOutliers = this->LeaveOutOutliers;
  palpate::CorrectedGreensFunctions corrected = palpate::correctCompliance(*served.greens, model,
    probed.setup, measurements, options,
    [this](double fraction, const char* stage) { return this->ReportProgress(fraction, stage); });
  corrected.greens.info.source += convert::tableNamed(this->MeasurementFileName);
  std::vector<std::string>& warnings = corrected.greens.info.diagnostics.warnings;
  warnings.insert(
    warnings.end(), corrected.fit.warnings.begin(), corrected.fit.warnings.end());
  vtkNew<vtkPolyData> arrays;
  convert::setGreensFunctions(arrays, corrected.model, std::move(corrected.greens));
  convert::removeResponses(output);
  convert::shareGreensFunctions(arrays, output, info.material.youngsModulus());
  corrected.fit.materials = { info.material };
  convert::setIdentification(output, corrected.fit, measurements);
  convert::setFieldNumber(output, palpate::arrays::PriorHoldOutError, corrected.priorHoldOutError);
  convert::setFieldNumber(output, palpate::arrays::CorrectionSmoothing, corrected.smoothing);
}
