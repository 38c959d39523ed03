// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "conversion.h"

#include "array_names.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>

// Point and field data.

namespace palpate::convert
{
namespace
{
vtkFieldData* fieldsOf(vtkDataObject* data)
{
  if (!data->GetFieldData())
  {
    vtkNew<vtkFieldData> fields;
    data->SetFieldData(fields);
  }
  return data->GetFieldData();
}

void requireFinite(const Eigen::Matrix3Xd& result, const std::string& name)
{
  if (!result.allFinite())
  {
    throw std::invalid_argument(
      "the result '" + name + "' would not be finite: what is prescribed is too large");
  }
}
} // namespace

int vertexNumber(double value, vtkIdType count, const std::string& what, vtkIdType index)
{
  if (!(value >= 0 && value < count && value == std::floor(value)))
  {
    std::ostringstream text;
    text << what << index << " names vertex " << std::setprecision(17) << value
         << ", but the surface has " << count;
    throw std::invalid_argument(text.str());
  }
  return static_cast<int>(value);
}

int wholeNumber(double value, const std::string& what, vtkIdType index)
{
  if (!(std::abs(value) <= std::numeric_limits<int>::max() && value == std::floor(value)))
  {
    std::ostringstream text;
    text << what << index << " must be a whole number of at most "
         << std::numeric_limits<int>::max() << ", not " << std::setprecision(17) << value;
    throw std::invalid_argument(text.str());
  }
  return static_cast<int>(value);
}

bool hasField(vtkDataObject* data, const char* name)
{
  return data->GetFieldData() && data->GetFieldData()->GetAbstractArray(name);
}

double fieldNumber(vtkDataObject* data, const char* name, const std::string& cure)
{
  vtkDataArray* array = data->GetFieldData() ? data->GetFieldData()->GetArray(name) : nullptr;
  if (!array || array->GetNumberOfValues() < 1)
  {
    throw std::invalid_argument(
      "the surface carries no field data '" + std::string(name) + "': " + cure);
  }
  return array->GetComponent(0, 0);
}

void setFieldNumber(vtkDataObject* data, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  fieldsOf(data)->AddArray(array);
}

void setFieldNumbers(vtkDataObject* data, const char* name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(values.size()));
  array->InsertNextTuple(values.data());
  fieldsOf(data)->AddArray(array);
}

void setFieldVector(vtkDataObject* data, const char* name, const Eigen::Vector3d& value)
{
  setFieldVectors(data, name, value);
}

void setFieldVectors(vtkDataObject* data, const char* name, const Eigen::Matrix3Xd& values)
{
  requireFinite(values, name);
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  for (Eigen::Index i = 0; i < values.cols(); ++i)
  {
    array->InsertNextTuple(values.col(i).data());
  }
  fieldsOf(data)->AddArray(array);
}

void setFieldStrings(
  vtkDataObject* data, const char* name, const std::vector<std::string>& values)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& value : values)
  {
    array->InsertNextValue(value);
  }
  fieldsOf(data)->AddArray(array);
}

std::string fieldString(vtkDataObject* data, const char* name)
{
  vtkStringArray* array = data->GetFieldData()
    ? vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name))
    : nullptr;
  return array && array->GetNumberOfValues() > 0 ? array->GetValue(0) : std::string();
}

void setPointVectors(vtkPolyData* surface, const char* name, const Eigen::Matrix3Xd& values)
{
  requireFinite(values, name);
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(values.cols());
  Eigen::Map<Eigen::Matrix3Xd>(array->GetPointer(0), 3, values.cols()) = values;
  surface->GetPointData()->AddArray(array);
}

void setPointNumbers(vtkPolyData* surface, const char* name, const Eigen::VectorXd& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(values.size());
  Eigen::Map<Eigen::VectorXd>(array->GetPointer(0), values.size()) = values;
  surface->GetPointData()->AddArray(array);
}

std::vector<Eigen::Matrix3d> pointMatricesOf(
  vtkPolyData* surface, const char* name, const std::string& cure)
{
  vtkDataArray* array = surface->GetPointData()->GetArray(name);
  if (!array || array->GetNumberOfComponents() != 9 ||
    array->GetNumberOfTuples() != surface->GetNumberOfPoints())
  {
    throw std::invalid_argument(
      std::string("there is no point array '") + name + "' of nine components: " + cure);
  }
  std::vector<Eigen::Matrix3d> matrices(surface->GetNumberOfPoints());
  for (vtkIdType v = 0; v < surface->GetNumberOfPoints(); ++v)
  {
    Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows;
    array->GetTuple(v, rows.data());
    matrices[v] = rows;
  }
  return matrices;
}

std::vector<unsigned char> boundaryTypesOf(vtkPolyData* surface, bool optional)
{
  const vtkIdType count = surface->GetNumberOfPoints();
  vtkDataArray* array = surface->GetPointData()->GetArray(arrays::BoundaryType);
  if (!array && optional)
  {
    return std::vector<unsigned char>(count, 0);
  }
  if (!array || array->GetNumberOfTuples() != count || array->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument(std::string("the surface has no point array '") +
      arrays::BoundaryType + "' with a value a point: say which vertices are fixed "
                             "(vtkReferenceBoundaryConditions, `palpate precompute --fix-...`)");
  }
  std::vector<unsigned char> types;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double value = array->GetComponent(i, 0);
    if (value != 0 && value != 1)
    {
      throw std::invalid_argument("the boundary type of node " + std::to_string(i) +
        " must be 0 (free) or 1 (fixed), not " + std::to_string(value));
    }
    types.push_back(static_cast<unsigned char>(value));
  }
  return types;
}

void setBoundaryTypes(vtkPolyData* surface, const std::vector<unsigned char>& types)
{
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName(arrays::BoundaryType);
  for (unsigned char type : types)
  {
    array->InsertNextValue(type);
  }
  surface->GetPointData()->AddArray(array);
}

void setPointMatrices(
  vtkPolyData* surface, const char* name, const std::vector<Eigen::Matrix3d>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(9);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t v = 0; v < values.size(); ++v)
  {
    const Eigen::Matrix3d columns = values[v].transpose(); // whose columns are rows
    array->SetTypedTuple(static_cast<vtkIdType>(v), columns.data());
  }
  surface->GetPointData()->AddArray(array);
}

void removeGreensFunctions(vtkDataObject* data)
{
  for (const char* name : arrays::GreensFunctionResults)
  {
    fieldsOf(data)->RemoveArray(name);
  }
}

void removeContact(vtkPolyData* surface)
{
  for (const char* name : arrays::ContactResults)
  {
    surface->GetPointData()->RemoveArray(name);
    fieldsOf(surface)->RemoveArray(name);
  }
  for (const char* name : arrays::ContactCellResults)
  {
    surface->GetCellData()->RemoveArray(name);
  }
}

void removeResponses(vtkPolyData* surface)
{
  removeContact(surface);
  for (const char* name : arrays::StiffnessResults)
  {
    surface->GetPointData()->RemoveArray(name);
    fieldsOf(surface)->RemoveArray(name);
  }
}

void removeMeshResults(vtkPolyData* surface)
{
  removeGreensFunctions(surface);
  removeResponses(surface);
  surface->GetPointData()->RemoveArray(arrays::VertexArea);
  for (const char* name : arrays::OriginalSurface)
  {
    fieldsOf(surface)->RemoveArray(name);
  }
}
} // namespace palpate::convert
