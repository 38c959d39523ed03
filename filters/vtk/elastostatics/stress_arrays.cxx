// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "stress_arrays.h"

#include "array_names.h"
#include "conversion.h"
#include "greens/rigid_motions.h"
#include "greens/surface_fields.h"
#include "inside_arrays.h"
#include "model_arrays.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace palpate::convert
{
namespace
{
Eigen::Matrix3Xd contactVectors(vtkPolyData* surface, const char* name)
{
  vtkDataArray* array = surface->GetPointData()->GetArray(name);
  if (!array || array->GetNumberOfComponents() != 3 ||
    array->GetNumberOfTuples() != surface->GetNumberOfPoints())
  {
    throw std::invalid_argument(std::string("there is no point array '") + name +
      "' of three components: press the model first (vtkPointContact, vtkCapacitanceSolve)");
  }
  Eigen::Matrix3Xd values(3, array->GetNumberOfTuples());
  for (vtkIdType v = 0; v < array->GetNumberOfTuples(); ++v)
  {
    array->GetTuple(v, values.col(v).data());
  }
  if (!values.allFinite())
  {
    throw std::invalid_argument(
      std::string("the point array '") + name + "' holds values that are not finite");
  }
  return values;
}

/// An array of so many components, filled tuple by tuple.
template <class Fill>
void addArray(vtkDataSetAttributes* attributes, const char* name, int components, std::size_t count,
  const Fill& fill)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(count));
  for (std::size_t i = 0; i < count; ++i)
  {
    fill(i, array->GetPointer(components * static_cast<vtkIdType>(i)));
  }
  attributes->AddArray(array);
}

/// xx, yy, zz, xy, yz, xz.
void setSymmetric(const Eigen::Matrix3d& m, double* out)
{
  const double values[] = { m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(0, 2) };
  std::copy(values, values + 6, out);
}

DeformedBody deformed(const ServedModel& served, vtkPolyData* surface)
{
  const GreensFunctionsInfo& info = served.greens->info();
  Eigen::Matrix3Xd displacement = contactVectors(surface, arrays::Displacement);
  Eigen::Matrix3Xd traction = contactVectors(surface, arrays::Traction);
  if (info.domain == Domain::Unsupported)
  {
    const Eigen::MatrixXd motions = rigidMotionsOfBodies(*served.mesh);
    const Eigen::VectorXd mean = meanRigidMotion(info.vertexAreas, motions) * traction.reshaped();
    traction -= (motions * mean).reshaped(3, traction.cols());
  }
  return { ElasticModel(
             served.mesh, info.material, info.conditions, served.smoothPatches, info.domain),
    std::move(displacement), std::move(traction) };
}
} // namespace

DeformedBody deformedBodyOf(vtkPolyData* surface)
{
  const ServedModel served = servedModelOf(surface);
  const GreensFunctionsInfo& info = served.greens->info();
  if (!info.homogeneous ||
    (info.domain != Domain::Interior && info.domain != Domain::Exterior &&
      info.domain != Domain::Unsupported))
  {
    throw std::invalid_argument(
      "stresses are computed inside bodies of one isotropic material and around cavities, not in this "
      "model; other bodies of finite elements, and what is put on springs, know of the places inside "
      "that are named beforehand (precompute --method fem --probe, foundation --probe)");
  }
  return deformed(served, surface);
}

DeformedBody deformedSurfaceOf(vtkPolyData* surface, std::vector<Elasticity>& materials)
{
  const ServedModel served = servedModelOf(surface);
  const GreensFunctionsInfo& info = served.greens->info();
  if (info.homogeneous)
  {
    materials.clear();
  }
  else
  {
    materials = surfaceElasticityOf(surface,
      info.material.youngsModulus() /
        fieldNumber(surface, arrays::GreensFunctionYoungsModulus, "compute the Green's functions again"));
  }
  if (info.domain == Domain::Shell || info.domain == Domain::Given)
  {
    throw std::invalid_argument("stresses at the surface are computed of solids, cavities and half-spaces: "
                                "not in shells, of given matrices or on springs");
  }
  if (!info.homogeneous && materials.empty())
  {
    throw std::invalid_argument(
      "the model does not know the materials behind its triangles, or what holds single components bears: "
      "for stresses at the surface compute its Green's functions by finite elements, without "
      "HeldComponents (precompute --method fem)");
  }
  return deformed(served, surface);
}

std::optional<StoredProbes> storedProbesOf(vtkPolyData* surface, const Eigen::Matrix3Xd& places)
{
  constexpr double tolerance = 1e-6; // of the diagonal
  const ServedModel served = servedModelOf(surface);
  const GreensFunctionsInfo& info = served.greens->info();
  if (info.homogeneous || !info.probes)
  {
    return std::nullopt;
  }
  const Eigen::Matrix3Xd displacement = contactVectors(surface, arrays::Displacement);
  Eigen::Matrix3Xd given = contactVectors(surface, arrays::Traction);
  for (int node : info.conditions.fixedNodes())
  {
    given.col(node) = displacement.col(node);
    if (!given.col(node).isZero(0) && !served.greens->hasColumn(node))
    {
      throw std::invalid_argument("vertex " + std::to_string(node) +
        " of the support is moved, whose part of the inside's fields is not known: precompute with "
        "--support-columns (in Python columns=np.arange(n))");
    }
  }
  return StoredProbes{ info.probes->at(places, tolerance * served.mesh->diagonal()), served.mesh,
    std::move(given) };
}

void setStresses(vtkDataSetAttributes* attributes, const std::vector<Eigen::Matrix3d>& gradients,
  const std::vector<Eigen::Matrix3d>& stresses)
{
  const std::size_t count = gradients.size();
  addArray(attributes, arrays::Strain, 6, count, [&](std::size_t i, double* out)
    { setSymmetric((gradients[i] + gradients[i].transpose()) / 2, out); });
  addArray(attributes, arrays::Stress, 6, count,
    [&](std::size_t i, double* out) { setSymmetric(stresses[i], out); });
  addArray(attributes, arrays::VonMisesStress, 1, count,
    [&](std::size_t i, double* out) { *out = vonMisesStress(stresses[i]); });
  addArray(attributes, arrays::PrincipalStress, 3, count, [&](std::size_t i, double* out)
    { std::copy_n(principalStresses(stresses[i]).data(), 3, out); });
}
} // namespace palpate::convert
