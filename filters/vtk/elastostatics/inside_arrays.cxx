// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "inside_arrays.h"

#include "array_names.h"
#include "conversion.h"
#include "model_arrays.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <stdexcept>
#include <string>

namespace palpate::convert
{
namespace
{
constexpr int ElasticityValues = 22;

/// A tuple a column.
void setFieldMatrix(vtkPolyData* surface, const char* name, const Eigen::MatrixXd& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(values.rows()));
  array->SetNumberOfTuples(values.cols());
  Eigen::Map<Eigen::MatrixXd>(array->GetPointer(0), values.rows(), values.cols()) = values;
  surface->GetFieldData()->AddArray(array);
}

/// The same, read.
Eigen::MatrixXd fieldMatrix(vtkPolyData* surface, const char* name, vtkIdType rows, vtkIdType columns)
{
  vtkDataArray* array = surface->GetFieldData()->GetArray(name);
  if (!array || array->GetNumberOfComponents() != rows || array->GetNumberOfTuples() != columns)
  {
    throw std::invalid_argument(std::string("the field array '") + name + "' must hold " +
      std::to_string(rows) + " by " + std::to_string(columns) +
      " values for this surface: compute its Green's functions again");
  }
  Eigen::MatrixXd values(rows, columns);
  for (vtkIdType i = 0; i < columns; ++i)
  {
    array->GetTuple(i, values.col(i).data());
  }
  if (!values.allFinite())
  {
    throw std::invalid_argument(
      std::string("the field array '") + name + "' holds values that are not finite");
  }
  return values;
}

std::shared_ptr<const ProbeRows> probesOf(vtkPolyData* surface)
{
  vtkDataArray* places = surface->GetFieldData()->GetArray(arrays::ProbePoints);
  if (!places || !hasField(surface, arrays::ProbeGreensFunctions))
  {
    return nullptr;
  }
  const vtkIdType count = places->GetNumberOfTuples();
  const Eigen::MatrixXd stiffness = fieldMatrix(surface, arrays::ProbeStiffness, 36, count);
  std::vector<Matrix6d> all;
  for (vtkIdType i = 0; i < count; ++i)
  {
    all.emplace_back(stiffness.col(i).reshaped(6, 6));
  }
  return std::make_shared<const ProbeRows>(fieldMatrix(surface, arrays::ProbePoints, 3, count),
    fieldMatrix(
      surface, arrays::ProbeGreensFunctions, 13 * count, 3 * surface->GetNumberOfPoints()),
    std::move(all));
}
} // namespace

void setInside(vtkPolyData* surface, const GreensFunctionsInfo& info)
{
  if (info.weightResponse.size() > 0)
  {
    setFieldMatrix(surface, arrays::WeightResponse, info.weightResponse);
  }
  if (info.density > 0)
  {
    setFieldNumber(surface, arrays::Density, info.density);
  }
  if (!info.probes)
  {
    return;
  }
  setFieldMatrix(surface, arrays::ProbeGreensFunctions, info.probes->rows());
  setFieldMatrix(surface, arrays::ProbePoints, info.probes->points());
  Eigen::MatrixXd stiffness(36, info.probes->count());
  for (int point = 0; point < info.probes->count(); ++point)
  {
    stiffness.col(point) = info.probes->stiffness(point).reshaped();
  }
  setFieldMatrix(surface, arrays::ProbeStiffness, stiffness);
}

void readInside(vtkPolyData* surface, GreensFunctionsInfo& info)
{
  if (hasField(surface, arrays::Density))
  {
    info.density = fieldNumber(surface, arrays::Density, "compute the Green's functions again");
  }
  if (hasField(surface, arrays::WeightResponse))
  {
    vtkIdType rows = 3 * surface->GetNumberOfPoints();
    vtkDataArray* array = surface->GetFieldData()->GetArray(arrays::WeightResponse);
    if (array && array->GetNumberOfComponents() > rows) // of what nothing holds
    {
      rows += 6 * SurfaceMesh(meshOf(surface)).bodyCount(); // the weight's resultants
    }
    info.weightResponse = fieldMatrix(surface, arrays::WeightResponse, rows, 3);
  }
  info.probes = probesOf(surface);
}

void setSurfaceElasticity(vtkPolyData* surface, const std::vector<Elasticity>& materials)
{
  Eigen::MatrixXd values(ElasticityValues, static_cast<Eigen::Index>(materials.size()));
  for (std::size_t f = 0; f < materials.size(); ++f)
  {
    int next = 0;
    for (int row = 0; row < 6; ++row)
    {
      for (int column = row; column < 6; ++column)
      {
        values(next++, f) = materials[f].stiffness()(row, column);
      }
    }
    values(next, f) = materials[f].isSplit() ? materials[f].compressibility() : -1;
  }
  setFieldMatrix(surface, arrays::SurfaceElasticity, values);
}

std::vector<Elasticity> surfaceElasticityOf(vtkPolyData* surface, double factor)
{
  std::vector<Elasticity> materials;
  if (!hasField(surface, arrays::SurfaceElasticity))
  {
    return materials;
  }
  const Eigen::MatrixXd values = fieldMatrix(
    surface, arrays::SurfaceElasticity, ElasticityValues, surface->GetNumberOfPolys());
  for (const auto& of : values.colwise())
  {
    Matrix6d stiffness;
    int next = 0;
    for (int row = 0; row < 6; ++row)
    {
      for (int column = row; column < 6; ++column)
      {
        stiffness(row, column) = stiffness(column, row) = factor * of[next++];
      }
    }
    if (of[next] < 0)
    {
      materials.emplace_back(stiffness);
      continue;
    }
    // Isotropic: 1 / lambda = (1 - 2 nu) / (2 G nu).
    const double shear = stiffness(3, 3), nu = 1 / (2 + 2 * shear * of[next] / factor);
    materials.emplace_back(Material(2 * shear * (1 + nu), nu));
  }
  return materials;
}
} // namespace palpate::convert
