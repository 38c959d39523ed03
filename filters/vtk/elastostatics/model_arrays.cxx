// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model_arrays.h"

#include "array_names.h"
#include "conversion.h"
#include "fingerprint_arrays.h"
#include "greens/dense_greens_functions.h"
#include "halfspace/half_space_greens_functions.h"
#include "held_arrays.h"
#include "inside_arrays.h"
#include "mesh/mesh_defects.h"
#include "mesh/smooth_patches.h"
#include "shell_arrays.h"
#include "smooth_patch_arrays.h"

#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTypeUInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <stdexcept>

namespace palpate::convert
{
namespace
{

Material materialOf(vtkPolyData* surface)
{
  const std::string cure = "give Young's modulus and Poisson's ratio (vtkReferenceBoundaryConditions)";
  return Material(fieldNumber(surface, arrays::YoungsModulus, cure),
    fieldNumber(surface, arrays::PoissonRatio, cure));
}

template <class Array, class Scalar>
void addMatrix(vtkPolyData* surface, const char* name, AlignedBuffer<Scalar> matrix, int rows)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(rows);
  const vtkIdType size = static_cast<vtkIdType>(matrix.size());
  array->SetArray(matrix.release(), size, 0, vtkAbstractArray::VTK_DATA_ARRAY_FREE);
  surface->GetFieldData()->AddArray(array);
}

void addPatchColumns(
  vtkPolyData* surface, const GreensFunctionsInfo& info, ComputedGreensFunctions& result, int rows)
{
  if (info.patchColumns.empty())
  {
    return;
  }
  if (result.floatPatchMatrix.size() > 0)
  {
    addMatrix<vtkFloatArray>(
      surface, arrays::PatchGreensFunctions, std::move(result.floatPatchMatrix), rows);
  }
  else
  {
    addMatrix<vtkDoubleArray>(
      surface, arrays::PatchGreensFunctions, std::move(result.patchMatrix), rows);
  }
  vtkNew<vtkIdTypeArray> patchNodes;
  patchNodes->SetName(arrays::PatchGreensFunctionNodes);
  patchNodes->SetNumberOfComponents(2);
  for (const PatchColumn& column : info.patchColumns)
  {
    const vtkIdType tuple[2] = { column.node, column.patch };
    patchNodes->InsertNextTypedTuple(tuple);
  }
  surface->GetFieldData()->AddArray(patchNodes);
}

void addDiagnostics(vtkPolyData* surface, const Diagnostics& d)
{
  setFieldNumber(surface, arrays::ConditionEstimate, d.conditionEstimate);
  setFieldNumber(surface, arrays::ReciprocityDefect, d.reciprocityDefect);
  setFieldNumber(surface, arrays::RotationDefect, d.rotationDefect);
  setFieldNumber(surface, arrays::SolverResidual, d.solverResidual);
  setFieldNumber(surface, arrays::IntegrationTolerance, d.quadratureTolerance);
  setFieldNumber(surface, arrays::WallRatio, d.wallRatio);
  setFieldNumber(surface, arrays::SupportWidth, d.supportWidth);
  setFieldNumber(surface, arrays::RockingCompliance, d.rockingCompliance);
  setFieldNumber(surface, arrays::ErrorEstimate, d.error.total());
  setFieldNumber(surface, arrays::ContactErrorEstimate, d.error.contactTotal());
  setFieldNumber(surface, arrays::MostErrorEstimate, d.error.most());
  setFieldNumber(surface, arrays::DiscretizationError, d.error.discretization);
  setFieldNumber(surface, arrays::IntegrationError, d.error.integration);
  setFieldNumber(surface, arrays::SolverError, d.error.solver);
  setFieldNumber(surface, arrays::StorageError, d.error.storage);
  setFieldNumber(surface, arrays::ErrorLoadLength, d.error.loadLength);
  setFieldNumber(surface, arrays::PeakBytes, static_cast<double>(d.peakBytes));
  std::vector<std::string> names;
  vtkNew<vtkDoubleArray> seconds;
  seconds->SetName(arrays::StageSeconds);
  for (const auto& [stage, time] : d.seconds)
  {
    names.push_back(stage);
    seconds->InsertNextValue(time);
  }
  surface->GetFieldData()->AddArray(seconds);
  setFieldStrings(surface, arrays::StageNames, names);
  if (!d.warnings.empty())
  {
    setFieldStrings(surface, arrays::Warnings, d.warnings);
  }
}

constexpr const char* SurfaceHasChanged =
  ": the surface has changed since its Green's functions were computed; compute them again";

/// A column matrix of field data, checked.
struct MatrixView
{
  vtkSmartPointer<vtkDataArray> array;
  template <class Scalar>
  const Scalar* data() const
  {
    return array ? static_cast<const Scalar*>(array->GetVoidPointer(0)) : nullptr;
  }
};

template <class Scalar>
bool allFinite(const MatrixView& view)
{
  return !view.array ||
    Eigen::Map<const Eigen::Array<Scalar, Eigen::Dynamic, 1>>(
      view.data<Scalar>(), view.array->GetNumberOfValues())
      .isFinite()
      .all();
}

MatrixView matrixOf(vtkPolyData* surface, const char* name, vtkIdType columns)
{
  MatrixView view{ surface->GetFieldData()->GetArray(name) };
  if (columns == 0 && !view.array)
  {
    return view;
  }
  const vtkIdType rows = 3 * surface->GetNumberOfPoints();
  if (!view.array || view.array->GetNumberOfComponents() != rows ||
    view.array->GetNumberOfTuples() != 3 * columns)
  {
    throw std::invalid_argument(std::string("the field array '") + name + "' must hold " +
      std::to_string(rows) + " by " + std::to_string(3 * columns) +
      " values for this surface" + SurfaceHasChanged);
  }
  const bool isFloat = view.array->GetDataType() == VTK_FLOAT;
  if (!view.array->HasStandardMemoryLayout() ||
    (!isFloat && view.array->GetDataType() != VTK_DOUBLE))
  {
    throw std::invalid_argument(
      std::string("the field array '") + name + "' must hold doubles or floats");
  }
  if (isFloat ? !allFinite<float>(view) : !allFinite<double>(view))
  {
    throw std::invalid_argument(
      std::string("the field array '") + name + "' holds values that are not finite");
  }
  return view;
}

/// The vertex that a stored column belongs to.
int storedNode(vtkPolyData* surface, double value, const std::string& what, vtkIdType index)
{
  try
  {
    return vertexNumber(value, surface->GetNumberOfPoints(), what, index);
  }
  catch (const std::invalid_argument& wrong)
  {
    throw std::invalid_argument(std::string(wrong.what()) + SurfaceHasChanged);
  }
}

std::vector<int> columnNodesOf(vtkPolyData* surface)
{
  vtkDataArray* array = surface->GetFieldData()->GetArray(arrays::GreensFunctionNodes);
  if (!array || array->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument(
      "the surface carries no Green's functions: compute them with "
      "vtkBoundaryElementGreensFunctions (palpate precompute)");
  }
  if (array->GetNumberOfTuples() == 0)
  {
    throw std::invalid_argument(std::string("the field array '") + arrays::GreensFunctionNodes +
      "' is empty: compute the Green's functions again");
  }
  std::vector<int> nodes;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    nodes.push_back(
      storedNode(surface, array->GetComponent(i, 0), "the Green's function of column ", i));
  }
  return nodes;
}

std::vector<PatchColumn> patchColumnsOf(vtkPolyData* surface)
{
  std::vector<PatchColumn> columns;
  vtkDataArray* array = surface->GetFieldData()->GetArray(arrays::PatchGreensFunctionNodes);
  for (vtkIdType i = 0; array && array->GetNumberOfComponents() == 2 && i < array->GetNumberOfTuples();
       ++i)
  {
    const int node = storedNode(surface, array->GetComponent(i, 0), "the patch column ", i);
    columns.push_back(
      { node, wholeNumber(array->GetComponent(i, 1), "the patch of patch column ", i) });
  }
  return columns;
}

constexpr const char* DomainNames[] = { "interior", "exterior", "halfspace", "shell", "given",
  "unsupported" };

Domain domainOf(vtkPolyData* surface)
{
  const auto name = std::find(std::begin(DomainNames), std::end(DomainNames),
    fieldString(surface, arrays::GreensFunctionDomain));
  return name == std::end(DomainNames) ? Domain::Interior
                                       : static_cast<Domain>(name - std::begin(DomainNames));
}

/// The Green's functions of the columns, from the matrices that the surface carries.
std::shared_ptr<const GreensFunctions> storedGreensFunctions(
  vtkPolyData* surface, GreensFunctionsInfo info)
{
  const MatrixView matrix =
    matrixOf(surface, arrays::GreensFunctions, static_cast<vtkIdType>(info.columnNodes.size()));
  const MatrixView patchMatrix = matrixOf(
    surface, arrays::PatchGreensFunctions, static_cast<vtkIdType>(info.patchColumns.size()));
  if (patchMatrix.array && patchMatrix.array->GetDataType() != matrix.array->GetDataType())
  {
    throw std::invalid_argument(std::string("the field arrays '") + arrays::GreensFunctions +
      "' and '" + arrays::PatchGreensFunctions + "' must both hold doubles or both floats");
  }
  auto keeper = std::make_shared<std::pair<MatrixView, MatrixView>>(matrix, patchMatrix);
  if (matrix.array->GetDataType() == VTK_FLOAT)
  {
    return std::make_shared<DenseGreensFunctions<float>>(
      std::move(info), matrix.data<float>(), patchMatrix.data<float>(), keeper);
  }
  return std::make_shared<DenseGreensFunctions<double>>(
    std::move(info), matrix.data<double>(), patchMatrix.data<double>(), keeper);
}
} // namespace

SurfaceMesh meshOf(vtkPolyData* surface)
{
  return SurfaceMesh(pointsOf(surface), trianglesOf(surface), rimsOf(domainOf(surface)));
}

std::shared_ptr<const SurfaceMesh> soundMeshOf(vtkPolyData* surface, Rims rims)
{
  auto mesh = std::make_shared<const SurfaceMesh>(pointsOf(surface), trianglesOf(surface), rims);
  requireNoDefect(findSelfIntersections(*mesh, 1));
  return mesh;
}

ElasticModel modelOf(vtkPolyData* surface, double smoothAngle, Domain domain)
{
  const auto mesh = soundMeshOf(surface, rimsOf(domain));
  const bool isShell = domain == Domain::Shell, isGiven = !isShell && hasGivenPatches(surface, *mesh);
  Eigen::VectorXi patches = isGiven ? storedPatches(surface)
                                    : findSmoothPatches(*mesh, isShell ? OnePatchAngle : smoothAngle);
  return ElasticModel(mesh, domain == Domain::Given ? Material(1, 0) : materialOf(surface),
    isShell ? shellConditionsOf(surface)
      : domain == Domain::Unsupported
      ? BoundaryConditions(std::vector<unsigned char>(surface->GetNumberOfPoints(), 0))
      : BoundaryConditions(boundaryTypesOf(surface, domain != Domain::Interior)),
    std::move(patches), domain);
}

void setGreensFunctions(
  vtkPolyData* surface, const ElasticModel& model, ComputedGreensFunctions result)
{
  const GreensFunctionsInfo& info = result.info;
  const int rows = 3 * model.mesh().vertexCount();
  if (result.floatMatrix.size() > 0)
  {
    addMatrix<vtkFloatArray>(surface, arrays::GreensFunctions, std::move(result.floatMatrix), rows);
  }
  else if (info.domain != Domain::HalfSpace) // those are computed when they are asked for
  {
    addMatrix<vtkDoubleArray>(surface, arrays::GreensFunctions, std::move(result.matrix), rows);
  }
  vtkNew<vtkIdTypeArray> nodes;
  nodes->SetName(arrays::GreensFunctionNodes);
  for (int node : info.columnNodes)
  {
    nodes->InsertNextValue(node);
  }
  surface->GetFieldData()->AddArray(nodes);
  addPatchColumns(surface, info, result, rows);
  setInside(surface, info);
  vtkNew<vtkTypeUInt64Array> fingerprint;
  fingerprint->SetName(arrays::MeshFingerprint);
  fingerprint->InsertNextValue(info.fingerprint);
  surface->GetFieldData()->AddArray(fingerprint);
  vtkNew<vtkUnsignedCharArray> reciprocal;
  reciprocal->SetName(arrays::GreensFunctionsReciprocal);
  reciprocal->InsertNextValue(info.reciprocal);
  surface->GetFieldData()->AddArray(reciprocal);
  setFieldNumber(
    surface, arrays::GreensFunctionYoungsModulus, info.material.youngsModulus());
  if (!info.homogeneous)
  {
    setFieldNumber(surface, arrays::HomogeneousMaterial, 0);
  }
  setFieldStrings(surface, arrays::GreensFunctionSource, { info.source });
  setFieldStrings(surface, arrays::GreensFunctionDomain,
    { DomainNames[static_cast<int>(info.domain)] });
  addDiagnostics(surface, info.diagnostics);

  setBoundaryTypes(surface, model.conditions().types());
  setPointNumbers(surface, arrays::VertexArea, info.vertexAreas);
  setSmoothPatches(surface, model.smoothPatches());
}

void shareGreensFunctions(vtkPolyData* from, vtkPolyData* surface, double youngsModulus)
{
  removeGreensFunctions(surface);
  for (int type : { vtkDataObject::POINT, vtkDataObject::CELL, vtkDataObject::FIELD })
  {
    vtkFieldData* shared = from->GetAttributesAsFieldData(type);
    for (int i = 0; i < shared->GetNumberOfArrays(); ++i)
    {
      surface->GetAttributesAsFieldData(type)->AddArray(shared->GetAbstractArray(i));
    }
  }
  const std::string cure = "compute the Green's functions again";
  const double rocking = fieldNumber(from, arrays::RockingCompliance, cure);
  const double ratio = fieldNumber(from, arrays::GreensFunctionYoungsModulus, cure) / youngsModulus;
  setFieldNumber(surface, arrays::RockingCompliance, rocking > 0 ? rocking * ratio : rocking);
}

ServedModel servedModelOf(vtkPolyData* surface)
{
  ServedModel served;
  GreensFunctionsInfo info;
  info.columnNodes = columnNodesOf(surface);
  info.patchColumns = patchColumnsOf(surface);
  info.homogeneous = !hasField(surface, arrays::HomogeneousMaterial);
  info.domain = domainOf(surface);
  served.mesh = std::make_shared<const SurfaceMesh>(meshOf(surface));
  served.smoothPatches = storedPatches(surface);
  info.conditions = BoundaryConditions(boundaryTypesOf(surface, false));
  const Material material = materialOf(surface);
  info.material = Material(fieldNumber(surface, arrays::GreensFunctionYoungsModulus,
                             "compute the Green's functions again"),
    material.poissonRatio());
  info.fingerprint = modelFingerprint(*served.mesh, info.conditions, served.smoothPatches,
    material.poissonRatio(), info.domain);
  if (info.domain == Domain::Shell)
  {
    readShellArrays(surface, *served.mesh, info);
  }
  if (info.domain == Domain::Interior)
  {
    readHeldArrays(surface, info);
  }
  requireFingerprint(surface, info.fingerprint);
  info.vertexAreas = served.mesh->vertexAreas();
  info.reciprocal =
    fieldNumber(surface, arrays::GreensFunctionsReciprocal, "compute the Green's functions again") != 0;
  info.source = fieldString(surface, arrays::GreensFunctionSource);
  readInside(surface, info);

  const std::shared_ptr<const GreensFunctions> stored = info.domain == Domain::HalfSpace
    ? std::make_shared<HalfSpaceGreensFunctions>(std::move(info), *served.mesh)
    : storedGreensFunctions(surface, std::move(info));
  served.greens = material.youngsModulus() == stored->info().material.youngsModulus()
    ? stored
    : stored->withYoungsModulus(material.youngsModulus());
  return served;
}
} // namespace palpate::convert
