// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "volume_arrays.h"

#include "array_names.h"
#include "conversion.h"
#include "mesh/surface_mesh.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

namespace palpate::convert
{
namespace
{
bool isTetrahedron(int type)
{
  return type == VTK_TETRA || type == VTK_QUADRATIC_TETRA;
}

bool isSolid(int type)
{
  vtkNew<vtkGenericCell> cell;
  cell->SetCellType(type);
  return cell->GetCellDimension() == 3;
}

/// Cells of the grid that are tetrahedra.
/// @throws for other solid cells.
std::vector<vtkIdType> tetrahedronCells(vtkUnstructuredGrid* grid)
{
  std::vector<vtkIdType> cells;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    const int type = grid->GetCellType(cell);
    if (isTetrahedron(type))
    {
      cells.push_back(cell);
    }
    else if (isSolid(type))
    {
      throw std::invalid_argument("cell " + std::to_string(cell) +
        " of the volume mesh is no tetrahedron: cut it up (vtkDataSetTriangleFilter)");
    }
  }
  return cells;
}

constexpr std::size_t LargestMaterial = 21;
using MaterialKey = std::array<double, LargestMaterial>;

vtkDataArray* cellArray(vtkUnstructuredGrid* grid, const char* name, int components)
{
  vtkDataArray* array = grid->GetCellData()->GetArray(name);
  if (array && array->GetNumberOfComponents() != components)
  {
    throw std::invalid_argument(std::string("the cell array '") + name + "' of the volume mesh must have " +
      std::to_string(components) + " components, not " + std::to_string(array->GetNumberOfComponents()));
  }
  return array;
}

/// Of each tetrahedron; none where the grid has no such array.
Eigen::VectorXd densitiesOf(vtkUnstructuredGrid* grid)
{
  vtkDataArray* array = cellArray(grid, arrays::Density, 1);
  if (!array)
  {
    return {};
  }
  const std::vector<vtkIdType> cells = tetrahedronCells(grid);
  Eigen::VectorXd densities(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    densities[i] = array->GetComponent(cells[i], 0);
  }
  return densities;
}

Elasticity isotropic(const MaterialKey& values)
{
  return Elasticity(Material(values[0], values[1]));
}

Elasticity withFibres(const MaterialKey& values)
{
  return Elasticity::transverselyIsotropic(
    { values[5], values[6], values[7] }, values[0], values[1], values[2], values[3], values[4]);
}

Elasticity withThreeAxes(const MaterialKey& values)
{
  const OrthotropicModuli moduli{ { values[0], values[1], values[2] },
    { values[3], values[4], values[5] }, { values[6], values[7], values[8] } };
  const Eigen::Vector3d first = Eigen::Vector3d(values[9], values[10], values[11]).stableNormalized();
  const Eigen::Vector3d given = Eigen::Vector3d(values[12], values[13], values[14]).stableNormalized();
  const Eigen::Vector3d second = given - given.dot(first) * first;
  if (!(second.norm() > 1e-6 && first.norm() > 0.5))
  {
    throw std::invalid_argument("its MaterialAxes are not two directions");
  }
  Eigen::Matrix3d axes;
  axes << first, second.normalized(), first.cross(second.normalized());
  return Elasticity::orthotropic(moduli, axes);
}

Elasticity withAllConstants(const MaterialKey& values)
{
  Matrix6d stiffness;
  for (int row = 0, next = 0; row < 6; ++row)
  {
    for (int column = row; column < 6; ++column)
    {
      stiffness(row, column) = stiffness(column, row) = values[next++];
    }
  }
  return Elasticity(stiffness);
}

/// Cell arrays that go together; their components, one after the other, are a material.
struct MaterialArrays
{
  struct Array
  {
    const char* name;
    int components;
  };
  std::vector<Array> arrays;
  Elasticity (*material)(const MaterialKey&);
};

const MaterialArrays MaterialKinds[] = {
  { { { arrays::YoungsModulus, 1 }, { arrays::PoissonRatio, 1 } }, isotropic },
  { { { arrays::TransverselyIsotropicModuli, 5 }, { arrays::FibreDirection, 3 } }, withFibres },
  { { { arrays::OrthotropicModuli, 9 }, { arrays::MaterialAxes, 6 } }, withThreeAxes },
  { { { arrays::ElasticityTensor, LargestMaterial } }, withAllConstants },
};

/// The kind of material that a grid's cells have, null for none.
const MaterialArrays* materialKindOf(vtkUnstructuredGrid* grid)
{
  const MaterialArrays* found = nullptr;
  for (const MaterialArrays& kind : MaterialKinds)
  {
    bool isPresent = false;
    for (const MaterialArrays::Array& array : kind.arrays)
    {
      isPresent = cellArray(grid, array.name, array.components) || isPresent;
    }
    if (!isPresent)
    {
      continue;
    }
    for (const MaterialArrays::Array& array : kind.arrays)
    {
      if (!grid->GetCellData()->HasArray(array.name))
      {
        throw std::invalid_argument(std::string("the cells of the volume mesh have no '") + array.name +
          "', which goes with their '" +
          (array.name == kind.arrays[0].name ? kind.arrays[1] : kind.arrays[0]).name + "': add it");
      }
    }
    if (found)
    {
      throw std::invalid_argument(
        "the cells of a volume mesh have materials of two kinds: they have either YoungsModulus and PoissonRatio, or "
        "TransverselyIsotropicModuli and FibreDirection, or OrthotropicModuli and MaterialAxes, or "
        "ElasticityTensor");
    }
    found = &kind;
  }
  return found;
}

/// The isotropic material nearest to one, with the same bulk and shear moduli in the mean over all
/// directions (W. Voigt 1889).
Material isotropicMeanOf(const Elasticity& material)
{
  const Matrix6d& c = material.stiffness();
  const double shear = (c(0, 0) + c(1, 1) + c(2, 2) - c(0, 1) - c(0, 2) - c(1, 2) +
                         3 * (c(3, 3) + c(4, 4) + c(5, 5))) /
    15;
  const double bulk = c.topLeftCorner<3, 3>().sum() / 9;
  const double young = 9 * bulk * shear / (3 * bulk + shear);
  return Material(young, young / (2 * shear) - 1);
}

/// In the mean over the tetrahedra: the unit that a body of several materials is told by.
/// @param kind  of its cells' materials.
Material meanMaterialOf(vtkUnstructuredGrid* grid, const MaterialArrays& kind)
{
  const CellMaterials cells = materialsOf(grid, Material(1, 0));
  const std::vector<vtkIdType> tetrahedra = tetrahedronCells(grid);
  double young = 0, poisson = 0;
  for (std::size_t i = 0; i < tetrahedra.size(); ++i)
  {
    const auto given = [&](const char* name)
    { return grid->GetCellData()->GetArray(name)->GetComponent(tetrahedra[i], 0); };
    const Material material = kind.material == isotropic
      ? Material(given(arrays::YoungsModulus), given(arrays::PoissonRatio))
      : isotropicMeanOf(cells.materials[cells.ofCell[i]]);
    const double share = 1. / static_cast<double>(tetrahedra.size());
    young += share * material.youngsModulus();
    poisson += share * material.poissonRatio();
  }
  return Material(young, poisson);
}

/// Tetrahedra, and the grid's point behind each of theirs.
struct GridTetrahedra
{
  TetrahedralMesh mesh;
  std::vector<vtkIdType> pointIds;
};

GridTetrahedra gridTetrahedra(vtkUnstructuredGrid* grid)
{
  const std::vector<vtkIdType> cells = tetrahedronCells(grid);
  if (cells.empty())
  {
    throw std::invalid_argument("the volume mesh has no tetrahedra");
  }
  std::vector<int> number(grid->GetNumberOfPoints(), -1);
  Eigen::Matrix4Xi tetrahedra(4, static_cast<Eigen::Index>(cells.size()));
  vtkNew<vtkIdList> corners;
  for (std::size_t t = 0; t < cells.size(); ++t)
  {
    grid->GetCellPoints(cells[t], corners);
    for (int k = 0; k < 4; ++k)
    {
      const vtkIdType point = k < corners->GetNumberOfIds() ? corners->GetId(k) : -1;
      if (point < 0 || point >= grid->GetNumberOfPoints())
      {
        throw std::invalid_argument(
          "cell " + std::to_string(cells[t]) + " of the volume mesh refers to a point that it has not");
      }
      number[point] = 0;
      tetrahedra(k, static_cast<Eigen::Index>(t)) = static_cast<int>(point);
    }
  }
  std::vector<vtkIdType> ids;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    if (number[i] == 0)
    {
      number[i] = static_cast<int>(ids.size());
      ids.push_back(i);
    }
  }
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(ids.size()));
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    grid->GetPoint(ids[i], points.col(static_cast<Eigen::Index>(i)).data());
  }
  return { TetrahedralMesh(
             std::move(points), tetrahedra.unaryExpr([&](int point) { return number[point]; })),
    std::move(ids) };
}
} // namespace

TetrahedralMesh tetrahedraOf(vtkUnstructuredGrid* grid)
{
  return gridTetrahedra(grid).mesh;
}

vtkSmartPointer<vtkPolyData> boundaryOf(vtkUnstructuredGrid* grid)
{
  const GridTetrahedra body = gridTetrahedra(grid);
  std::vector<int> number(body.pointIds.size(), -1);
  for (int corner : body.mesh.boundary().reshaped())
  {
    number[corner] = 0;
  }
  vtkNew<vtkIdList> from, to;
  for (std::size_t i = 0; i < number.size(); ++i)
  {
    if (number[i] == 0)
    {
      number[i] = static_cast<int>(from->GetNumberOfIds());
      to->InsertNextId(from->GetNumberOfIds());
      from->InsertNextId(body.pointIds[i]);
    }
  }
  Eigen::Matrix3Xd points(3, from->GetNumberOfIds());
  for (vtkIdType v = 0; v < from->GetNumberOfIds(); ++v)
  {
    grid->GetPoint(from->GetId(v), points.col(v).data());
  }
  auto boundary = vtkSmartPointer<vtkPolyData>::New();
  setSurface(boundary, points, body.mesh.boundary().unaryExpr([&](int i) { return number[i]; }));
  boundary->GetFieldData()->ShallowCopy(grid->GetFieldData());
  const MaterialArrays* kind = materialKindOf(grid);
  if (kind && !hasField(boundary, arrays::YoungsModulus) && !hasField(boundary, arrays::PoissonRatio))
  {
    const Material mean = meanMaterialOf(grid, *kind);
    setFieldNumber(boundary, arrays::YoungsModulus, mean.youngsModulus());
    setFieldNumber(boundary, arrays::PoissonRatio, mean.poissonRatio());
  }
  vtkPointData* data = boundary->GetPointData();
  data->CopyAllOn();
  data->CopyAllocate(grid->GetPointData(), from->GetNumberOfIds());
  data->CopyData(grid->GetPointData(), from, to);
  return boundary;
}

CellMaterials materialsOf(vtkUnstructuredGrid* grid, const Material& otherwise)
{
  CellMaterials result;
  result.densities = densitiesOf(grid);
  const MaterialArrays* kind = materialKindOf(grid);
  if (!kind)
  {
    result.materials.emplace_back(otherwise);
    return result;
  }
  std::vector<vtkDataArray*> present;
  for (const MaterialArrays::Array& array : kind->arrays)
  {
    present.push_back(grid->GetCellData()->GetArray(array.name));
  }
  std::map<MaterialKey, int> numbers;
  for (vtkIdType cell : tetrahedronCells(grid))
  {
    MaterialKey key{};
    int next = 0;
    for (vtkDataArray* array : present)
    {
      for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      {
        key[next++] = array->GetComponent(cell, c);
      }
    }
    for (double value : key)
    {
      if (!std::isfinite(value))
      {
        throw std::invalid_argument(
          "the material of cell " + std::to_string(cell) + " of the volume mesh is not finite");
      }
    }
    const auto [entry, isNew] = numbers.emplace(key, static_cast<int>(result.materials.size()));
    if (isNew)
    {
      try
      {
        result.materials.push_back(kind->material(key));
      }
      catch (const std::invalid_argument& wrong)
      {
        throw std::invalid_argument(
          "cell " + std::to_string(cell) + " of the volume mesh: " + wrong.what());
      }
    }
    result.ofCell.push_back(entry->second);
  }
  return result;
}

std::uint64_t gridFingerprint(const TetrahedralMesh& mesh, const CellMaterials& materials)
{
  Fingerprint fingerprint;
  fingerprint.add(mesh.points().data(), sizeof(double) * mesh.points().size())
    .add(mesh.tetrahedra().data(), sizeof(int) * mesh.tetrahedra().size())
    .add(materials.ofCell.data(), sizeof(int) * materials.ofCell.size())
    .add(materials.densities.data(), sizeof(double) * materials.densities.size());
  if (materials.ofCell.empty())
  {
    return fingerprint.value();
  }
  for (const Elasticity& material : materials.materials)
  {
    const double compressibility = material.compressibility();
    fingerprint.add(material.stiffness().data(), sizeof(Matrix6d))
      .add(&compressibility, sizeof compressibility);
  }
  return fingerprint.value();
}
} // namespace palpate::convert
