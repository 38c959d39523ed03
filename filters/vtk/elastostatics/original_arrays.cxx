// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "original_arrays.h"

#include "array_names.h"
#include "conversion.h"
#include "mesh/shells.h"
#include "mesh/surface_map.h"
#include "sentence.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkTypeUInt64Array.h"

#include <cmath>
#include <cstring>
#include <utility>

namespace palpate::convert
{
namespace
{
/// Weights of corners may differ from a sum of one by what text files round off.
constexpr double WeightRounding = 1e-6;

vtkDataArray* fieldArray(vtkPolyData* surface, const char* name, int components)
{
  vtkDataArray* array = surface->GetFieldData()->GetArray(name);
  if (!array || array->GetNumberOfComponents() != components)
  {
    refuse("the surface was not remeshed with its original kept: it has no field array '", name, "' of ",
      components, " components");
  }
  return array;
}

std::uint64_t fingerprintOf(const SurfaceMesh& mesh)
{
  return Fingerprint().add(mesh).value();
}

void requireFingerprint(vtkPolyData* surface, const SurfaceMesh& mesh)
{
  vtkDataArray* array = fieldArray(surface, arrays::OriginalFingerprint, 1);
  std::uint64_t stored = 0;
  const bool usable = array->GetNumberOfTuples() == 1 && array->GetDataTypeSize() == sizeof stored &&
    array->HasStandardMemoryLayout();
  if (usable)
  {
    std::memcpy(&stored, array->GetVoidPointer(0), sizeof stored);
  }
  if (!usable || stored != fingerprintOf(mesh))
  {
    refuse("points or triangles have changed since the surface was remeshed, and its original lies "
           "elsewhere on it: take the original before they change");
  }
}

vtkSmartPointer<vtkIdTypeArray> idArray(const char* name, int components, vtkIdType count)
{
  auto array = vtkSmartPointer<vtkIdTypeArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(count);
  return array;
}
} // namespace

bool hasOriginal(vtkPolyData* surface)
{
  return surface->GetFieldData()->HasArray(arrays::OriginalPoints);
}

SurfaceMesh originalOf(vtkPolyData* surface)
{
  vtkDataArray* points = fieldArray(surface, arrays::OriginalPoints, 3);
  vtkDataArray* corners = fieldArray(surface, arrays::OriginalTriangles, 3);
  Eigen::Matrix3Xd places(3, points->GetNumberOfTuples());
  for (Eigen::Index v = 0; v < places.cols(); ++v)
  {
    points->GetTuple(v, places.col(v).data());
  }
  Eigen::Matrix3Xi triangles(3, corners->GetNumberOfTuples());
  for (Eigen::Index f = 0; f < triangles.cols(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      triangles(k, f) = vertexNumber(
        corners->GetComponent(f, k), points->GetNumberOfTuples(), "a corner of original triangle ", f);
    }
  }
  return SurfaceMesh(std::move(places), std::move(triangles));
}

std::vector<SurfacePoint> originalPlacesOf(vtkPolyData* surface, const SurfaceMesh& mesh, int count)
{
  requireFingerprint(surface, mesh);
  vtkDataArray* triangles = fieldArray(surface, arrays::OriginalPointTriangle, 1);
  vtkDataArray* weights = fieldArray(surface, arrays::OriginalPointWeights, 3);
  if (triangles->GetNumberOfTuples() != count || weights->GetNumberOfTuples() != count)
  {
    refuse("there are places of ", triangles->GetNumberOfTuples(), " and weights of ",
      weights->GetNumberOfTuples(), " original points, which are ", count);
  }
  std::vector<SurfacePoint> places(count);
  for (int v = 0; v < count; ++v)
  {
    places[v].triangle = vertexNumber(
      triangles->GetComponent(v, 0), mesh.triangleCount(), "the triangle of original point ", v);
    weights->GetTuple(v, places[v].barycentric.data());
    const Eigen::Vector3d& parts = places[v].barycentric;
    if (!(parts.minCoeff() >= -WeightRounding) || !(std::abs(parts.sum() - 1) <= WeightRounding))
    {
      refuse("the weights of original point ", v, " must be none negative and add up to 1, not ",
        parts[0], ", ", parts[1], ", ", parts[2]);
    }
  }
  return places;
}

void setOriginal(
  vtkPolyData* surface, const std::shared_ptr<const SurfaceMesh>& mesh, const SurfaceMesh& original)
{
  const SurfaceMap map = mapOnto(mesh, original.points(), original.vertexNormals());
  const auto corners = idArray(arrays::OriginalTriangles, 3, original.triangleCount());
  for (int f = 0; f < original.triangleCount(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      corners->SetComponent(f, k, original.triangles()(k, f));
    }
  }
  const auto triangles = idArray(arrays::OriginalPointTriangle, 1, original.vertexCount());
  Eigen::Matrix3Xd weights(3, original.vertexCount());
  for (int v = 0; v < original.vertexCount(); ++v)
  {
    triangles->SetValue(v, map.places[v].triangle);
    weights.col(v) = map.places[v].barycentric;
  }
  vtkNew<vtkTypeUInt64Array> fingerprint;
  fingerprint->SetName(arrays::OriginalFingerprint);
  fingerprint->InsertNextValue(fingerprintOf(*mesh));
  setFieldVectors(surface, arrays::OriginalPoints, original.points());
  setFieldVectors(surface, arrays::OriginalPointWeights, weights);
  setFieldNumber(surface, arrays::OriginalDistance, map.largestDistance);
  setFieldNumber(surface, arrays::OriginalVolumeChange,
    enclosedVolume(mesh->points(), mesh->triangles()) /
        enclosedVolume(original.points(), original.triangles()) -
      1);
  for (vtkDataArray* array : { static_cast<vtkDataArray*>(corners), static_cast<vtkDataArray*>(triangles),
         static_cast<vtkDataArray*>(fingerprint) })
  {
    surface->GetFieldData()->AddArray(array);
  }
}
} // namespace palpate::convert
