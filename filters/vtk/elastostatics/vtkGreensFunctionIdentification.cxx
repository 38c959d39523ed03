// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkGreensFunctionIdentification.h"

#include "array_names.h"
#include "conversion.h"
#include "filled_surface.h"
#include "identified_body.h"
#include "identified_material.h"
#include "identification/next_probes.h"
#include "identification_arrays.h"
#include "measurement_arrays.h"
#include "model_arrays.h"
#include "probed_surface.h"
#include "sentence.h"
#include "volume_arrays.h"

#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

vtkStandardNewMacro(vtkGreensFunctionIdentification);

namespace
{
constexpr double SplitFrom = palpate::Elasticity::kSplitFrom;
constexpr int CandidatePlaces = 16;
} // namespace

vtkGreensFunctionIdentification::vtkGreensFunctionIdentification()
{
  this->SetNumberOfInputPorts(3);
}

vtkGreensFunctionIdentification::~vtkGreensFunctionIdentification() = default;

void vtkGreensFunctionIdentification::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->Method << "\n"
     << indent << "MeasurementFileName: " << this->MeasurementFileName << "\n"
     << indent << "LengthUnit: " << this->LengthUnit << "\n"
     << indent << "ForceUnit: " << this->ForceUnit << "\n"
     << indent << "PoissonRatio: " << this->PoissonRatio << "\n"
     << indent << "PoissonRange: " << this->PoissonRange[0] << ", " << this->PoissonRange[1] << "\n"
     << indent << "YieldingSupport: " << this->YieldingSupport << "\n"
     << indent << "Register: " << this->Register << "\n"
     << indent << "Loss: " << this->Loss << "\n"
     << indent << "LargestRatio: " << this->LargestRatio << "\n"
     << indent << "InterpolationTolerance: " << this->InterpolationTolerance << "\n"
     << indent << "NumberOfFolds: " << this->NumberOfFolds << "\n"
     << indent << "NumberOfNextProbes: " << this->NumberOfNextProbes << "\n"
     << indent << "PlaceTolerance: " << this->PlaceTolerance << "\n"
     << indent << "EstimateError: " << this->EstimateError << "\n";
}

void vtkGreensFunctionIdentification::SetMeasurementFileName(const char* name)
{
  this->SetName(this->MeasurementFileName, name);
}

void vtkGreensFunctionIdentification::SetLengthUnit(const char* unit)
{
  this->SetName(this->LengthUnit, unit);
}

void vtkGreensFunctionIdentification::SetForceUnit(const char* unit)
{
  this->SetName(this->ForceUnit, unit);
}

int vtkGreensFunctionIdentification::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(
    vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 1 ? "vtkUnstructuredGrid" : "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

palpate::Measurements vtkGreensFunctionIdentification::MeasurementsOn(const palpate::SurfaceMesh& mesh,
  vtkPolyData* table, std::optional<palpate::Registration>& registration)
{
  palpate::Measurements measurements = palpate::convert::measurementsFrom(
    table, this->MeasurementFileName, this->LengthUnit, this->ForceUnit);
  if (!this->Register)
  {
    return measurements;
  }
  registration = palpate::registerToSurface(
    mesh, measurements, [this] { return this->ReportProgress(0, "register"); });
  return palpate::registered(measurements, *registration);
}

vtkGreensFunctionIdentification::Body vtkGreensFunctionIdentification::BodyOf(
  vtkPolyData* surface, vtkUnstructuredGrid* grid, const palpate::Progress& progress) const
{
  namespace convert = palpate::convert;
  const vtkSmartPointer<vtkPolyData> posed = convert::withAnyMaterial(surface);
  Body body{ *this, convert::modelOf(posed, this->SmoothAngle, palpate::Domain::Interior), {}, {}, {}, 1,
    {}, {} };
  const bool isSolid = this->Method == FINITE_ELEMENTS;
  if (grid && !isSolid)
  {
    palpate::refuse("a volume mesh goes with finite elements: choose them, or leave it out");
  }
  if (grid)
  {
    body.Mesh = convert::tetrahedraOf(grid);
    body.RegionOfCell = convert::regionsOf(grid, body.Regions);
  }
  else if (isSolid)
  {
    convert::FilledSurface filled =
      convert::fillSurface(posed, body.Given.sharedMesh(), 0, progress.callback());
    if (filled.boundary)
    {
      body.Boundary = filled.boundary;
      body.Given = convert::modelOf(body.Boundary, this->SmoothAngle, palpate::Domain::Interior);
      body.Warning = filled.warning;
    }
    body.Mesh = std::move(filled.mesh);
  }
  if (this->YieldingSupport)
  {
    if (body.Given.conditions().fixedNodes().empty())
    {
      palpate::refuse("a support that yields needs fixed vertices");
    }
    body.Columns.resize(body.Given.mesh().vertexCount());
    std::iota(body.Columns.begin(), body.Columns.end(), 0);
  }
  return body;
}

palpate::MaterialUnknowns vtkGreensFunctionIdentification::PoissonUnknown(bool isSolid) const
{
  palpate::MaterialUnknowns unknowns;
  unknowns.poisson = std::isnan(this->PoissonRatio);
  unknowns.poissonRatio = this->PoissonRatio;
  if (isSolid)
  {
    unknowns.poissonUpper = SplitFrom - 1e-3;
  }
  if (!std::isnan(this->PoissonRange[0]))
  {
    unknowns.poissonLower = this->PoissonRange[0];
    unknowns.poissonUpper = this->PoissonRange[1];
  }
  if (isSolid && unknowns.poisson && unknowns.poissonLower < SplitFrom &&
    unknowns.poissonUpper >= SplitFrom)
  {
    palpate::refuse("finite elements are of another kind from Poisson's ratio ", SplitFrom,
      " on: look for it below, or from there on");
  }
  return unknowns;
}

palpate::IdentificationOptions vtkGreensFunctionIdentification::OptionsFor(const Body& body) const
{
  palpate::IdentificationOptions options;
  palpate::MaterialUnknowns& unknowns = options.unknowns;
  unknowns = this->PoissonUnknown(body.Mesh.has_value());
  unknowns.regions = body.Regions;
  unknowns.largestRatio = this->LargestRatio;
  unknowns.support = this->YieldingSupport;
  options.loss = static_cast<palpate::RobustLoss>(this->Loss);
  options.interpolationTolerance = this->InterpolationTolerance;
  options.folds = this->NumberOfFolds;
  return options;
}

palpate::MaterialIdentifier vtkGreensFunctionIdentification::IdentifierFor(const Body& body,
  const palpate::Measurements& measurements, const palpate::Progress& progress) const
{
  const palpate::SurfaceMesh& mesh = body.Given.mesh();
  const palpate::convert::ProbedSurface probed = palpate::convert::probedSurface(
    body.Given, measurements, this->PlaceTolerance * mesh.diagonal());
  return { [&](const std::vector<palpate::Material>& materials, const palpate::Progress& part)
    {
      const auto greens = body.Compute(materials, false, part).take();
      return palpate::MeasuredResponse(*greens, probed.setup, this->YieldingSupport);
    },
    probed.setup, mesh.diagonal(), probed.normals, this->OptionsFor(body), progress };
}

void vtkGreensFunctionIdentification::Describe(vtkPolyData* input,
  const palpate::Measurements& measurements, const std::string& how,
  const palpate::MaterialIdentification& result, const std::string& warning,
  palpate::ComputedGreensFunctions& greens) const
{
  namespace convert = palpate::convert;
  greens.info.source +=
    "; " + how + " from " + convert::countOf(measurements, this->MeasurementFileName);
  std::vector<std::string>& warnings = greens.info.diagnostics.warnings;
  for (const std::string& doubt :
    { warning, convert::unitDoubt(input, result.materials.front().youngsModulus()) })
  {
    if (!doubt.empty())
    {
      warnings.push_back(doubt);
    }
  }
  warnings.insert(warnings.end(), result.warnings.begin(), result.warnings.end());
}

void vtkGreensFunctionIdentification::ProposeProbes(const Body& body,
  const palpate::MaterialIdentifier& identifier, const palpate::Measurements& measurements,
  const palpate::MaterialIdentification& result, vtkPolyData* output,
  const palpate::Progress& progress) const
{
  const palpate::Measurements candidates = palpate::candidateProbes(
    body.Given.mesh(), body.Given.conditions(), measurements, CandidatePlaces);
  Eigen::VectorXd parameters(result.parameters.size());
  for (std::size_t i = 0; i < result.parameters.size(); ++i)
  {
    parameters[i] = result.parameters[i].value;
  }
  Eigen::MatrixXd present = Eigen::MatrixXd::Zero(parameters.size(), parameters.size());
  for (const Eigen::MatrixXd& probe :
    palpate::informationOfProbes(identifier, parameters, measurements, result.noise))
  {
    present += probe;
  }
  const palpate::MaterialIdentifier further = this->IdentifierFor(body, candidates, progress);
  const std::vector<palpate::ChosenProbe> chosen = palpate::chooseProbes(present,
    palpate::informationOfProbes(further, parameters, candidates, result.noise),
    palpate::contactVertices(candidates), this->NumberOfNextProbes);
  std::vector<palpate::Probe> probes;
  Eigen::MatrixXd deviations(chosen.size(), parameters.size());
  for (std::size_t i = 0; i < chosen.size(); ++i)
  {
    probes.push_back(candidates.probes[chosen[i].candidate]);
    deviations.row(i) = identifier.deviations(parameters, chosen[i].information);
  }
  palpate::convert::setNextProbes(output, probes, deviations);
}

void vtkGreensFunctionIdentification::Compute(
  vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs)
{
  namespace convert = palpate::convert;
  const palpate::Progress progress(
    [this](double fraction, const char* stage) { return this->ReportProgress(fraction, stage); });
  if (this->PatchColumns || this->GetColumnNodes())
  {
    palpate::refuse("identification computes the Green's functions of all free vertices: leave columns "
                    "and patch columns out");
  }
  const Body body =
    this->BodyOf(input, vtkUnstructuredGrid::GetData(inputs[1]), progress.part(0, 0.05));
  const palpate::SurfaceMesh& mesh = body.Given.mesh();
  std::optional<palpate::Registration> registration;
  const palpate::Measurements measurements =
    this->MeasurementsOn(mesh, vtkPolyData::GetData(inputs[2]), registration);
  const palpate::MaterialIdentifier identifier =
    this->IdentifierFor(body, measurements, progress.part(0.05, 0.6));
  palpate::MaterialIdentification result = identifier.identify(measurements, progress.part(0.6, 0.61));
  if (registration)
  {
    const Eigen::MatrixXd changes =
      body.Changes(measurements, *registration, result, progress.part(0.61, 0.64));
    result = identifier.identify(measurements, progress.part(0.64, 0.65), changes);
  }

  palpate::ComputedGreensFunctions greens =
    body.Compute(result.materials, this->EstimateError, progress.part(0.65, 0.8));
  const palpate::Material& material = result.materials.front();
  this->Describe(input, measurements, "identified", result, body.Warning, greens);
  const palpate::ElasticModel model = body.ModelOf(material);
  vtkNew<vtkPolyData> computed;
  convert::setGreensFunctions(computed, model, std::move(greens));
  if (body.Boundary)
  {
    convert::setBoundary(output, input, body.Boundary, model.sharedMesh());
  }
  convert::removeResponses(output);
  convert::setFieldNumber(output, palpate::arrays::YoungsModulus, material.youngsModulus());
  convert::setFieldNumber(output, palpate::arrays::PoissonRatio, material.poissonRatio());
  convert::shareGreensFunctions(computed, output, material.youngsModulus());
  convert::setIdentification(output, result, measurements);
  if (this->NumberOfNextProbes > 0)
  {
    this->ProposeProbes(body, identifier, measurements, result, output, progress.part(0.8, 1));
  }
  if (registration)
  {
    convert::setRegistration(output, *registration);
    convert::setRegistrationDeviations(output, result);
  }
  if (this->EstimateError && body.Regions > 1 && !this->YieldingSupport)
  {
    if (const Eigen::VectorXd off = body.OffByMesh(identifier, measurements, result, progress.part(0.95, 1));
        off.size() > 0)
    {
      convert::setColumn(output, palpate::arrays::ParametersOffByMesh, { off.begin(), off.end() });
    }
  }
  this->MarkPatches(body.Boundary ? body.Boundary.Get() : input, model, output);
}
