// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkStiffnessFieldIdentification.h"

#include "array_names.h"
#include "conversion.h"
#include "fem/finite_element_method.h"
#include "fem/modulus_response.h"
#include "filled_surface.h"
#include "identified_material.h"
#include "identification/registration.h"
#include "identification/stiffness_field.h"
#include "identification/stiffness_modes.h"
#include "identification_arrays.h"
#include "measurement_arrays.h"
#include "model_arrays.h"
#include "probed_surface.h"
#include "sentence.h"
#include "volume_arrays.h"

#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

vtkStandardNewMacro(vtkStiffnessFieldIdentification);

namespace
{
constexpr double UsualLength = 0.15; // over the diagonal
constexpr double LeastVariation = 0.2; // of ln E, to speak of

Eigen::Matrix3Xd centresOf(const palpate::TetrahedralMesh& mesh)
{
  Eigen::Matrix3Xd centres(3, mesh.cellCount());
  for (int cell = 0; cell < mesh.cellCount(); ++cell)
  {
    centres.col(cell) =
      mesh.points()(Eigen::all, mesh.tetrahedra().col(cell)).rowwise().mean();
  }
  return centres;
}

void addCellNumbers(vtkUnstructuredGrid* grid, const char* name, const Eigen::VectorXd& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(values.size());
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  grid->GetCellData()->AddArray(array);
}

/// Where a mesh is coarse, stiffness that varies can stand for what its elements do not resolve.
void warnOfMesh(
  const palpate::StiffnessField& field, double error, std::vector<std::string>& warnings)
{
  const double explained =
    std::sqrt(std::max(0.0, std::pow(field.uniformError, 2) - std::pow(field.fit.fitError, 2)));
  if (explained < error && std::log(field.modulus.maxCoeff() / field.modulus.minCoeff()) > LeastVariation)
  {
    warnings.push_back(palpate::sentence("what the field explains beyond one modulus, ",
      palpate::shortly(100 * explained), " % of the displacements, is less than the mesh's own error of ",
      palpate::shortly(100 * error),
      " %: where stiffness varies here may be the mesh's doing; refine the surface"));
  }
}

/// Where the body is fixed, at its vertices; points inside are free.
void addBoundaryTypes(
  vtkUnstructuredGrid* grid, const palpate::SolidBody& body, const palpate::BoundaryConditions& conditions)
{
  vtkNew<vtkUnsignedCharArray> types;
  types->SetName(palpate::arrays::BoundaryType);
  types->SetNumberOfTuples(body.mesh().pointCount());
  types->Fill(0);
  for (int vertex : conditions.fixedNodes())
  {
    types->SetValue(body.pointOfVertex(vertex), 1);
  }
  grid->GetPointData()->AddArray(types);
}

/// The body as vtkFiniteElementGreensFunctions takes it, with what is left open.
/// @param mean  what is one to all, besides the moduli of cells.
void setField(vtkUnstructuredGrid* grid, const palpate::SolidBody& body,
  const palpate::BoundaryConditions& conditions, const palpate::Material& mean,
  const palpate::StiffnessField& field)
{
  const palpate::TetrahedralMesh& mesh = body.mesh();
  grid->Initialize();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& point : mesh.points().colwise())
  {
    points->InsertNextPoint(point.data());
  }
  grid->SetPoints(points);
  grid->Allocate(mesh.cellCount());
  for (const auto& cell : mesh.tetrahedra().colwise())
  {
    const vtkIdType corners[] = { cell[0], cell[1], cell[2], cell[3] };
    grid->InsertNextCell(VTK_TETRA, 4, corners);
  }
  addCellNumbers(grid, palpate::arrays::YoungsModulus, field.modulus);
  addCellNumbers(grid, palpate::arrays::PoissonRatio,
    Eigen::VectorXd::Constant(mesh.cellCount(), mean.poissonRatio()));
  addCellNumbers(grid, palpate::arrays::LogModulusDeviation, field.deviation);
  addBoundaryTypes(grid, body, conditions);
  palpate::convert::setFieldNumber(grid, palpate::arrays::YoungsModulus, mean.youngsModulus());
  palpate::convert::setFieldNumber(grid, palpate::arrays::PoissonRatio, mean.poissonRatio());
}
} // namespace

vtkStiffnessFieldIdentification::vtkStiffnessFieldIdentification()
{
  this->SetNumberOfOutputPorts(2);
  this->Method = FINITE_ELEMENTS;
}

void vtkStiffnessFieldIdentification::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfModes: " << this->NumberOfModes << "\n"
     << indent << "FieldLength: " << this->FieldLength << "\n"
     << indent << "FieldDeviation: " << this->FieldDeviation << "\n";
}

int vtkStiffnessFieldIdentification::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillOutputPortInformation(port, info);
  }
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkUnstructuredGrid");
  return 1;
}

void vtkStiffnessFieldIdentification::Compute(
  vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs)
{
  namespace convert = palpate::convert;
  const palpate::Progress progress(
    [this](double fraction, const char* stage) { return this->ReportProgress(fraction, stage); });
  if (this->Method != FINITE_ELEMENTS)
  {
    palpate::refuse("stiffness that varies inside takes finite elements");
  }
  if (this->YieldingSupport || this->NumberOfNextProbes > 0 || this->PatchColumns ||
    this->GetColumnNodes())
  {
    palpate::refuse("a field of stiffness is identified on a firm support, with the Green's functions of "
                    "all free vertices, and proposes no further probes");
  }
  const vtkSmartPointer<vtkPolyData> posed = convert::withAnyMaterial(input);
  palpate::ElasticModel model =
    convert::modelOf(posed, this->SmoothAngle, palpate::Domain::Interior);
  std::optional<palpate::TetrahedralMesh> mesh;
  vtkSmartPointer<vtkPolyData> boundary; // in place of the surface, null where that stays
  std::string warning;
  if (vtkUnstructuredGrid* grid = vtkUnstructuredGrid::GetData(inputs[1]))
  {
    mesh = convert::tetrahedraOf(grid);
  }
  else
  {
    convert::FilledSurface filled =
      convert::fillSurface(posed, model.sharedMesh(), 0, progress.part(0, 0.1).callback());
    if (filled.boundary)
    {
      boundary = filled.boundary;
      model = convert::modelOf(boundary, this->SmoothAngle, palpate::Domain::Interior);
    }
    mesh = std::move(filled.mesh);
    warning = filled.warning;
  }
  std::optional<palpate::Registration> registration;
  const palpate::Measurements measurements =
    this->MeasurementsOn(model.mesh(), vtkPolyData::GetData(inputs[2]), registration);
  const double diagonal = model.mesh().diagonal();
  const convert::ProbedSurface probed =
    convert::probedSurface(model, measurements, this->PlaceTolerance * diagonal);
  const palpate::ModulusResponse response(model, *mesh,
    palpate::stiffnessModes(centresOf(*mesh), mesh->volumes(),
      this->FieldLength == 0 ? UsualLength * diagonal : this->FieldLength, this->NumberOfModes),
    palpate::nodalForces(probed.setup, measurements, model.mesh().vertexAreas()));

  const palpate::MaterialUnknowns poisson = this->PoissonUnknown(true);
  palpate::StiffnessFieldOptions options;
  options.poisson = poisson.poisson;
  options.poissonRatio = poisson.poissonRatio;
  options.poissonLower = poisson.poissonLower;
  options.poissonUpper = poisson.poissonUpper;
  options.deviation = this->FieldDeviation;
  options.loss = static_cast<palpate::RobustLoss>(this->Loss);
  options.folds = this->NumberOfFolds;
  const palpate::StiffnessField field = palpate::identifyStiffnessField(
    [&](const Eigen::VectorXd& modulus, double ratio, bool derivatives, const palpate::Progress& part)
    {
      palpate::ModulusResponse::Answer answer = response.at(modulus, ratio, derivatives, part);
      return palpate::MovedSurface{ std::move(answer.displacements), std::move(answer.byModes) };
    },
    response.modes(), mesh->volumes(), probed.setup, measurements, options, progress.part(0.1, 0.7));

  const palpate::Material& mean = field.fit.materials.front();
  const palpate::ElasticModel found(
    model.sharedMesh(), mean, model.conditions(), model.smoothPatches());
  palpate::FiniteElementOptions how;
  how.reciprocal = this->Reciprocal;
  const palpate::SolidBody body = response.body(field.modulus, mean.poissonRatio());
  palpate::ComputedGreensFunctions greens = palpate::computeFiniteElementGreensFunctions(
    found, body, how, progress.part(0.7, this->EstimateError ? 0.85 : 1).callback());
  if (this->EstimateError)
  {
    // By the same body of one material: what the mesh does.
    how.estimateError = true;
    greens.info.diagnostics.error = palpate::computeFiniteElementGreensFunctions(found,
      palpate::SolidBody(found.mesh(), *mesh, { palpate::Elasticity(mean) }), how,
      progress.part(0.85, 1).callback())
                                      .info.diagnostics.error;
    palpate::Diagnostics& diagnostics = greens.info.diagnostics;
    warnOfMesh(field, diagnostics.error.total(), diagnostics.warnings);
  }
  this->Describe(input, measurements,
    palpate::sentence("a field of ", response.modes().cols(), " modes identified"), field.fit, warning,
    greens);
  vtkNew<vtkPolyData> computed;
  convert::setGreensFunctions(computed, found, std::move(greens));
  if (boundary)
  {
    convert::setBoundary(output, input, boundary, model.sharedMesh());
  }
  convert::removeResponses(output);
  convert::setFieldNumber(output, palpate::arrays::YoungsModulus, mean.youngsModulus());
  convert::setFieldNumber(output, palpate::arrays::PoissonRatio, mean.poissonRatio());
  convert::shareGreensFunctions(computed, output, mean.youngsModulus());
  convert::setIdentification(output, field.fit, measurements);
  convert::setFieldNumber(output, palpate::arrays::DeterminedUnknowns, field.determined);
  convert::setFieldNumber(output, palpate::arrays::FieldDeviation, field.expected);
  convert::setFieldNumber(output, palpate::arrays::UniformFitError, field.uniformError);
  if (registration)
  {
    convert::setRegistration(output, *registration);
  }
  this->MarkPatches(boundary ? boundary.Get() : input, found, output);
  setField(vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(1)), body, found.conditions(),
    mean, field);
}
