// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identified_material.h"

#include "array_names.h"
#include "conversion.h"
#include "sentence.h"
#include "volume_arrays.h"

#include "vtkCellData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>

namespace palpate::convert
{
namespace
{
constexpr double DoubtfulRatio = 100;

/// To two digits.
double rounded(double x)
{
  const double unit = std::pow(10, std::floor(std::log10(x)) - 1);
  return std::round(x / unit) * unit;
}
} // namespace

vtkSmartPointer<vtkPolyData> withAnyMaterial(vtkPolyData* surface)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->ShallowCopy(surface);
  setFieldNumber(copy, arrays::YoungsModulus, 1);
  setFieldNumber(copy, arrays::PoissonRatio, 0.3);
  return copy;
}

std::vector<int> regionsOf(vtkUnstructuredGrid* grid, int& count)
{
  count = 1;
  vtkDataArray* array = grid ? grid->GetCellData()->GetArray(arrays::MaterialRegion) : nullptr;
  std::vector<int> regions;
  for (vtkIdType cell = 0; array && cell < grid->GetNumberOfCells(); ++cell)
  {
    const int type = grid->GetCellType(cell);
    if (type != VTK_TETRA && type != VTK_QUADRATIC_TETRA)
    {
      continue; // of lower dimension
    }
    regions.push_back(vertexNumber(
      array->GetComponent(cell, 0), grid->GetNumberOfCells(), "MaterialRegion of cell ", cell));
  }
  if (regions.empty())
  {
    return regions;
  }
  count = *std::max_element(regions.begin(), regions.end()) + 1;
  for (int region = 0; region < count; ++region)
  {
    if (std::find(regions.begin(), regions.end(), region) == regions.end())
    {
      refuse("no cell is of the MaterialRegion ", region, ", but some are of ", count - 1);
    }
  }
  return regions;
}

std::string unitDoubt(vtkPolyData* surface, double youngsModulus)
{
  if (!hasField(surface, arrays::YoungsModulus))
  {
    return {};
  }
  const double own = fieldNumber(surface, arrays::YoungsModulus, "leave it out");
  const double ratio = youngsModulus / own;
  if (!(own > 0) || (ratio <= DoubtfulRatio && ratio >= 1 / DoubtfulRatio))
  {
    return {};
  }
  return sentence("the identified Young's modulus is ", rounded(ratio), " times that of the input, ", own,
    " Pa: check the unit of force");
}

std::string countOf(const Measurements& measurements, const std::string& file)
{
  return sentence(measurements.displacements.size(), " displacements under ", measurements.probes.size(),
    " probes", tableNamed(file));
}

std::string tableNamed(const std::string& file)
{
  return " (" + (file.empty() ? "a table" : file) + ")";
}
} // namespace palpate::convert
