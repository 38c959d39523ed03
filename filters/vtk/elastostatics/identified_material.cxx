// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identified_material.h"

#include "array_names.h"
#include "conversion.h"
#include "sentence.h"

#include "vtkPolyData.h"

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
