// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkReferenceBoundaryConditions.h"

#include "array_names.h"
#include "conversion.h"
#include "mesh/surface_mesh.h"
#include "model/material.h"
#include "smooth_patch_arrays.h"

#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkExtractSelection.h"
#include "vtkIdList.h"
#include "vtkImplicitFunction.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

vtkStandardNewMacro(vtkReferenceBoundaryConditions);

vtkReferenceBoundaryConditions::vtkReferenceBoundaryConditions()
  : YoungsModulus(vtkMath::Nan())
  , PoissonRatio(vtkMath::Nan())
{
  this->SetNumberOfInputPorts(2);
}

vtkReferenceBoundaryConditions::~vtkReferenceBoundaryConditions() = default;

void vtkReferenceBoundaryConditions::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "YoungsModulus: " << this->YoungsModulus << "\n"
     << indent << "PoissonRatio: " << this->PoissonRatio << "\n"
     << indent << "RequireMaterial: " << this->RequireMaterial << "\n"
     << indent << "FixedArrayName: " << this->FixedArrayName << "\n"
     << indent << "Fixed half-spaces, boxes, spheres: " << this->HalfSpaces.size() << ", "
     << this->Boxes.size() << ", " << this->Spheres.size() << "\n";
}

vtkMTimeType vtkReferenceBoundaryConditions::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->FixedFunction ? std::max(own, this->FixedFunction->GetMTime()) : own;
}

int vtkReferenceBoundaryConditions::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkSelection");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

void vtkReferenceBoundaryConditions::SetFixedArrayName(const char* name)
{
  this->SetName(this->FixedArrayName, name);
}

void vtkReferenceBoundaryConditions::AddFixedHalfSpace(const double origin[3], const double normal[3])
{
  this->HalfSpaces.push_back(
    { origin[0], origin[1], origin[2], normal[0], normal[1], normal[2] });
  this->Modified();
}

void vtkReferenceBoundaryConditions::AddFixedBox(const double b[6])
{
  this->Boxes.push_back({ b[0], b[1], b[2], b[3], b[4], b[5] });
  this->Modified();
}

void vtkReferenceBoundaryConditions::AddFixedSphere(const double center[3], double radius)
{
  this->Spheres.push_back({ center[0], center[1], center[2], radius });
  this->Modified();
}

void vtkReferenceBoundaryConditions::ClearFixedRegions()
{
  this->HalfSpaces.clear();
  this->Boxes.clear();
  this->Spheres.clear();
  this->Modified();
}

void vtkReferenceBoundaryConditions::SetFixedFunction(vtkImplicitFunction* function)
{
  if (this->FixedFunction != function)
  {
    this->FixedFunction = function;
    this->Modified();
  }
}

vtkImplicitFunction* vtkReferenceBoundaryConditions::GetFixedFunction()
{
  return this->FixedFunction;
}

namespace
{
using Six = std::array<double, 6>;
using Four = std::array<double, 4>;

void requireSensibleRegions(
  const std::vector<Six>& halfSpaces, const std::vector<Six>& boxes, const std::vector<Four>& balls)
{
  const auto isFinite = [](const auto& values)
  { return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }); };
  for (const Six& h : halfSpaces)
  {
    if (!isFinite(h) || (h[3] == 0 && h[4] == 0 && h[5] == 0))
    {
      throw std::invalid_argument(
        "a fixed half-space needs a finite origin and a finite normal that is not zero");
    }
  }
  for (const Six& b : boxes)
  {
    if (!isFinite(b) || b[0] > b[1] || b[2] > b[3] || b[4] > b[5])
    {
      throw std::invalid_argument(
        "a fixed box needs finite bounds in the order xmin, xmax, ymin, ymax, zmin, zmax");
    }
  }
  for (const Four& s : balls)
  {
    if (!isFinite(s) || s[3] < 0)
    {
      throw std::invalid_argument("a fixed ball needs a finite centre and a radius of at least 0");
    }
  }
}

/// 1 for each point of the surface that a selection of points or of cells holds.
std::vector<unsigned char> selectedPoints(vtkPolyData* surface, vtkSelection* selection)
{
  constexpr const char* insideName = "vtkInsidedness";
  vtkNew<vtkExtractSelection> extract;
  extract->SetInputData(0, surface);
  extract->SetInputData(1, selection);
  extract->PreserveTopologyOn();
  extract->Update();
  auto* marked = vtkDataSet::SafeDownCast(extract->GetOutputDataObject(0));
  vtkDataArray* points = marked ? marked->GetPointData()->GetArray(insideName) : nullptr;
  vtkDataArray* cells = marked ? marked->GetCellData()->GetArray(insideName) : nullptr;
  std::vector<unsigned char> selected(surface->GetNumberOfPoints(), 0);
  if (points && points->GetNumberOfTuples() == surface->GetNumberOfPoints())
  {
    for (vtkIdType i = 0; i < points->GetNumberOfTuples(); ++i)
    {
      selected[i] = points->GetComponent(i, 0) > 0;
    }
  }
  else if (cells && cells->GetNumberOfTuples() == surface->GetNumberOfCells())
  {
    vtkNew<vtkIdList> corners;
    for (vtkIdType f = 0; f < cells->GetNumberOfTuples(); ++f)
    {
      marked->GetCellPoints(f, corners);
      for (vtkIdType k = 0; cells->GetComponent(f, 0) > 0 && k < corners->GetNumberOfIds(); ++k)
      {
        selected[corners->GetId(k)] = 1;
      }
    }
  }
  else
  {
    throw std::invalid_argument(
      "the selection of fixed points is neither one of this surface's points nor of its cells");
  }
  return selected;
}
/// 1 for each point where an array is not zero.
std::vector<unsigned char> pointsByArray(vtkPolyData* surface, const std::string& name)
{
  vtkDataArray* array = surface->GetPointData()->GetArray(name.c_str());
  if (!array || array->GetNumberOfComponents() != 1 ||
    array->GetNumberOfTuples() != surface->GetNumberOfPoints())
  {
    throw std::invalid_argument("there is no point array '" + name + "' with a number a point");
  }
  std::vector<unsigned char> points;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    const double value = array->GetComponent(i, 0);
    if (std::isnan(value))
    {
      throw std::invalid_argument(
        "the value of the array '" + name + "' at point " + std::to_string(i) + " is not a number");
    }
    points.push_back(value != 0);
  }
  return points;
}

/// Writes a number to the field data unless it is NaN.
void setOrKeep(vtkPolyData* surface, const char* name, double value)
{
  if (!vtkMath::IsNan(value))
  {
    palpate::convert::setFieldNumber(surface, name, value);
  }
}

void requireMaterial(vtkPolyData* surface)
{
  constexpr const char* cure = "give Young's modulus and Poisson's ratio";
  const double young = palpate::convert::fieldNumber(surface, palpate::arrays::YoungsModulus, cure);
  palpate::Material(
    young, palpate::convert::fieldNumber(surface, palpate::arrays::PoissonRatio, cure)); // checks them
}
} // namespace

bool vtkReferenceBoundaryConditions::IsInFixedRegion(const double point[3]) const
{
  const Eigen::Vector3d x(point);
  const auto isBehind = [&](const Six& h)
  { return (x - Eigen::Vector3d(&h[0])).dot(Eigen::Vector3d(&h[3])) <= 0; };
  const auto isInBox = [&](const Six& b)
  {
    return x.x() >= b[0] && x.x() <= b[1] && x.y() >= b[2] && x.y() <= b[3] && x.z() >= b[4] &&
      x.z() <= b[5];
  };
  const auto isInBall = [&](const Four& s) { return (x - Eigen::Vector3d(&s[0])).norm() <= s[3]; };
  return std::any_of(this->HalfSpaces.begin(), this->HalfSpaces.end(), isBehind) ||
    std::any_of(this->Boxes.begin(), this->Boxes.end(), isInBox) ||
    std::any_of(this->Spheres.begin(), this->Spheres.end(), isInBall) ||
    (this->FixedFunction && this->FixedFunction->FunctionValue(point) <= 0);
}

std::vector<unsigned char> vtkReferenceBoundaryConditions::FindFixedPoints(
  vtkPolyData* surface, vtkSelection* selection) const
{
  const vtkIdType count = surface->GetNumberOfPoints();
  const std::vector<unsigned char> none(count, 0);
  const auto selected = selection ? selectedPoints(surface, selection) : none;
  const auto marked =
    this->FixedArrayName.empty() ? none : pointsByArray(surface, this->FixedArrayName);
  std::vector<unsigned char> fixed;
  for (vtkIdType i = 0; i < count; ++i)
  {
    fixed.push_back(selected[i] || marked[i] || this->IsInFixedRegion(surface->GetPoint(i)));
  }
  return fixed;
}

namespace
{
/// Smooth patches that were found for another support go with it.
void changeBoundaryTypes(vtkPolyData* surface, const std::vector<unsigned char>& types)
{
  namespace convert = palpate::convert;
  if (convert::hasField(surface, palpate::arrays::SmoothAngle) &&
    convert::boundaryTypesOf(surface, true) != types)
  {
    // Whether the surface may have rims, who computes Green's functions of it says.
    convert::removeFoundPatches(surface,
      palpate::SurfaceMesh(
        convert::pointsOf(surface), convert::trianglesOf(surface), palpate::Rims::Allowed));
  }
  convert::setBoundaryTypes(surface, types);
}
} // namespace

void vtkReferenceBoundaryConditions::Compute(
  vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs)
{
  requireSensibleRegions(this->HalfSpaces, this->Boxes, this->Spheres);
  palpate::convert::removeResponses(output);
  vtkSelection* selection = vtkSelection::GetData(inputs[1]);
  const bool hasRegions =
    !this->HalfSpaces.empty() || !this->Boxes.empty() || !this->Spheres.empty();
  if (hasRegions || selection || this->FixedFunction || !this->FixedArrayName.empty())
  {
    changeBoundaryTypes(output, this->FindFixedPoints(input, selection));
  }
  setOrKeep(output, palpate::arrays::YoungsModulus, this->YoungsModulus);
  setOrKeep(output, palpate::arrays::PoissonRatio, this->PoissonRatio);
  if (this->RequireMaterial)
  {
    requireMaterial(output);
  }
}
