// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkContactRecovery.h"

#include "array_names.h"
#include "conversion.h"
#include "greens/surface_fields.h"
#include "identification/contact_recovery.h"
#include "measurement_arrays.h"
#include "model_arrays.h"
#include "recovery_arrays.h"
#include "sentence.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkContactRecovery);

vtkContactRecovery::vtkContactRecovery()
{
  this->SetNumberOfInputPorts(2);
}

void vtkContactRecovery::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DisplacementFileName: " << this->DisplacementFileName << "\n"
     << indent << "LengthUnit: " << this->LengthUnit << "\n"
     << indent << "ProbeName: " << this->ProbeName << "\n"
     << indent << "Friction: " << this->Friction << "\n"
     << indent << "Noise: " << this->Noise << "\n"
     << indent << "PatchRadius: " << this->PatchRadius << "\n"
     << indent << "YieldingSupport: " << this->YieldingSupport << "\n"
     << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n"
     << indent << "Seed: " << this->Seed << "\n"
     << indent << "PlaceTolerance: " << this->PlaceTolerance << "\n";
}

void vtkContactRecovery::SetDisplacementFileName(const char* name)
{
  this->SetName(this->DisplacementFileName, name);
}

void vtkContactRecovery::SetLengthUnit(const char* unit)
{
  this->SetName(this->LengthUnit, unit);
}

void vtkContactRecovery::SetProbeName(const char* name)
{
  this->SetName(this->ProbeName, name);
}

int vtkContactRecovery::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

void vtkContactRecovery::Compute(
  vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs)
{
  namespace convert = palpate::convert;
  if (!(this->PlaceTolerance >= 0 && this->PlaceTolerance <= 1))
  {
    palpate::refuse("the tolerance of places must be from 0 to 1, not ", this->PlaceTolerance);
  }
  const palpate::Measurements observations = convert::observationsFrom(
    vtkPolyData::GetData(inputs[1]), this->DisplacementFileName, this->LengthUnit);
  const convert::ServedModel served = convert::servedModelOf(input);
  const palpate::SurfaceMesh& mesh = *served.mesh;
  const palpate::ObservedDisplacements observed = palpate::observedUnder(observations,
    palpate::markersOn(mesh, observations, this->PlaceTolerance * mesh.diagonal()), this->ProbeName,
    this->Noise);
  palpate::RecoveryOptions options;
  options.friction = this->Friction;
  options.radius = this->PatchRadius;
  options.yieldingSupport = this->YieldingSupport;
  options.samples = this->NumberOfSamples;
  options.seed = static_cast<unsigned>(this->Seed);
  const palpate::ContactRecovery recovery = palpate::recoverContacts(*served.greens, mesh,
    served.smoothPatches, observed, options,
    palpate::Progress([this](double fraction, const char* stage)
      { return this->ReportProgress(fraction, stage); }));
  Eigen::Matrix3Xd places(3, observed.points.size());
  for (Eigen::Index i = 0; i < places.cols(); ++i)
  {
    places.col(i) = palpate::placeOf(mesh, observed.points[i]);
  }
  convert::setRecovery(output, recovery, places, observed.displacements);
  convert::setFieldNumber(output, palpate::arrays::LargestDisplacementGradient,
    palpate::surfaceGradients(mesh, recovery.displacement).largest);
}
