// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "measurement_arrays.h"

#include "array_names.h"
#include "conversion.h"
#include "identification/measurement_file.h"
#include "sentence.h"
#include "units.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace palpate::convert
{
namespace
{
vtkDataArray* optionalArray(vtkPolyData* table, const char* name, int components, vtkIdType tuples)
{
  vtkDataArray* array = table->GetFieldData()->GetArray(name);
  if (array && (array->GetNumberOfComponents() != components || array->GetNumberOfTuples() != tuples))
  {
    refuse("the field array ", name, " has ", array->GetNumberOfTuples(), " tuples of ",
      array->GetNumberOfComponents(), " components, but ", tuples, " of ", components,
      " go with the others");
  }
  return array;
}

vtkDataArray* requiredArray(vtkPolyData* table, const char* name, int components, vtkIdType tuples)
{
  vtkDataArray* array = optionalArray(table, name, components, tuples);
  if (!array)
  {
    refuse("the table of measurements has no field array ", name);
  }
  return array;
}

vtkIdType tupleCount(vtkPolyData* table, const char* name)
{
  vtkDataArray* array = table->GetFieldData()->GetArray(name);
  if (!array)
  {
    refuse("the table of measurements has no field array ", name);
  }
  return array->GetNumberOfTuples();
}

Eigen::Vector3d vectorAt(vtkDataArray* array, vtkIdType tuple)
{
  Eigen::Vector3d value;
  array->GetTuple(tuple, value.data());
  return value;
}

int indexAt(vtkDataArray* array, vtkIdType tuple, vtkIdType count, const std::string& what)
{
  const double value = array->GetComponent(tuple, 0);
  if (!(value >= 0 && value < count && value == std::floor(value)))
  {
    refuse(array->GetName(), ", tuple ", tuple, ": there is no ", what, " ", value);
  }
  return static_cast<int>(value);
}

/// Places by vertices, by points, or by both where the vertex is -1 for a point.
class Places
{
public:
  Places(vtkPolyData* table, const char* vertices, const char* points, vtkIdType count, double unit)
    : Vertices(optionalArray(table, vertices, 1, count))
    , Points(optionalArray(table, points, 3, count))
    , Unit(unit)
  {
    if (!this->Vertices && !this->Points)
    {
      refuse("the table of measurements has neither a field array ", vertices, " nor ", points);
    }
  }
  RestPlace operator[](vtkIdType i) const
  {
    RestPlace place;
    if (this->Vertices && (!this->Points || this->Vertices->GetComponent(i, 0) != -1))
    {
      place.vertex = indexAt(this->Vertices, i, VTK_INT_MAX, "vertex");
    }
    else
    {
      place.point = this->Unit * vectorAt(this->Points, i);
    }
    return place;
  }

private:
  vtkDataArray *Vertices, *Points;
  double Unit;
};

void setPlaces(vtkPolyData* table, const char* vertexName, const char* pointName,
  const std::vector<RestPlace>& places)
{
  vtkNew<vtkIdTypeArray> vertices;
  vertices->SetName(vertexName);
  Eigen::Matrix3Xd points(3, places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    vertices->InsertNextValue(places[i].vertex);
    points.col(i) = places[i].point;
  }
  table->GetFieldData()->AddArray(vertices);
  setFieldVectors(table, pointName, points);
}

void readProbes(vtkPolyData* table, double length, double force, Measurements& result)
{
  const vtkIdType count = tupleCount(table, arrays::ProbeForce);
  vtkDataArray* forces = requiredArray(table, arrays::ProbeForce, 3, count);
  vtkDataArray* radii = optionalArray(table, arrays::ProbeRadius, 1, count);
  const Places contacts(table, arrays::ProbeVertex, arrays::ProbePoint, count, length);
  auto* names = vtkStringArray::SafeDownCast(table->GetFieldData()->GetAbstractArray(arrays::ProbeNames));
  for (vtkIdType p = 0; p < count; ++p)
  {
    Probe probe;
    probe.name =
      names && names->GetNumberOfValues() == count ? std::string(names->GetValue(p)) : std::to_string(p);
    probe.contact = contacts[p];
    probe.radius = radii ? length * radii->GetComponent(p, 0) : 0;
    probe.force = force * vectorAt(forces, p);
    result.probes.push_back(probe);
  }
}

void requireOne(vtkPolyData* table, const std::string& file, const char* what)
{
  if (!table == file.empty())
  {
    refuse(what, " come from a file or from the input of their table: give one of the two");
  }
}

/// Displacements of the probes that are there; without any all are of one.
void readDisplacements(vtkPolyData* table, double length, Measurements& result)
{
  const vtkIdType count = tupleCount(table, arrays::MeasuredDisplacement);
  vtkDataArray* probes = result.probes.empty()
    ? optionalArray(table, arrays::MeasurementProbe, 1, count)
    : requiredArray(table, arrays::MeasurementProbe, 1, count);
  vtkDataArray* displacements = requiredArray(table, arrays::MeasuredDisplacement, 3, count);
  vtkDataArray* deviations = table->GetFieldData()->GetArray(arrays::MeasurementDeviation);
  if (deviations)
  {
    optionalArray(
      table, arrays::MeasurementDeviation, deviations->GetNumberOfComponents() == 3 ? 3 : 1, count);
  }
  const Places markers(table, arrays::MeasurementVertex, arrays::MeasurementPoint, count, length);
  const vtkIdType known = result.probes.empty() ? VTK_INT_MAX : result.probes.size();
  for (vtkIdType i = 0; i < count; ++i)
  {
    MeasuredDisplacement measured;
    measured.row = static_cast<int>(i);
    if (probes)
    {
      measured.probe = indexAt(probes, i, known, "probe");
    }
    measured.marker = markers[i];
    measured.displacement = length * vectorAt(displacements, i);
    for (int c = 0; deviations && c < 3; ++c)
    {
      measured.deviation[c] =
        length * deviations->GetComponent(i, deviations->GetNumberOfComponents() == 3 ? c : 0);
    }
    result.displacements.push_back(measured);
  }
}
} // namespace

void setVectorsWithGaps(vtkPolyData* table, const char* name, const Eigen::Matrix3Xd& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(values.cols());
  std::copy_n(values.data(), values.size(), array->GetPointer(0));
  table->GetFieldData()->AddArray(array);
}

void setColumn(vtkPolyData* table, const char* name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (double value : values)
  {
    array->InsertNextValue(value);
  }
  table->GetFieldData()->AddArray(array);
}

Measurements measurementsOf(vtkPolyData* table, double length, double force)
{
  Measurements result;
  result.source = "the table of measurements";
  result.rowWord = "tuple";
  readProbes(table, length, force, result);
  if (result.probes.empty())
  {
    refuse("the table of measurements has no probe");
  }
  readDisplacements(table, length, result);
  requireSound(result);
  return result;
}

Measurements observationsOf(vtkPolyData* table, double length)
{
  Measurements result;
  result.source = "the table of displacements";
  result.rowWord = "tuple";
  result.hasForces = false;
  readDisplacements(table, length, result);
  auto* names = vtkStringArray::SafeDownCast(table->GetFieldData()->GetAbstractArray(arrays::ProbeNames));
  std::map<int, int> numbers; // of the probes that there are
  for (MeasuredDisplacement& measured : result.displacements)
  {
    const auto [found, isNew] =
      numbers.emplace(measured.probe, static_cast<int>(result.probes.size()));
    if (isNew)
    {
      Probe probe;
      probe.name = names && measured.probe < names->GetNumberOfValues()
        ? std::string(names->GetValue(measured.probe))
        : std::to_string(measured.probe);
      result.probes.push_back(probe);
    }
    measured.probe = found->second;
  }
  requireSound(result);
  return result;
}

Measurements measurementsFrom(vtkPolyData* table, const std::string& file,
  const std::string& lengthUnit, const std::string& forceUnit)
{
  requireOne(table, file, "measurements");
  const MeasurementUnits units{ lengthUnitNamed(lengthUnit), forceUnitNamed(forceUnit) };
  return table ? measurementsOf(table, units.length, units.force) : readMeasurementFile(file, units);
}

Measurements observationsFrom(
  vtkPolyData* table, const std::string& file, const std::string& lengthUnit)
{
  requireOne(table, file, "displacements");
  const double length = lengthUnitNamed(lengthUnit);
  return table ? observationsOf(table, length) : readObservationFile(file, length);
}

void setMeasurements(vtkPolyData* table, const Measurements& measurements)
{
  for (const char* name : arrays::MeasurementTable)
  {
    table->GetFieldData()->RemoveArray(name);
  }
  const Eigen::Index count = measurements.displacements.size(), probes = measurements.probes.size();
  std::vector<RestPlace> markers, contacts;
  std::vector<double> probeOf, rows, radii;
  std::vector<std::string> names;
  Eigen::Matrix3Xd displacements(3, count), deviations(3, count), forces(3, probes);
  for (Eigen::Index i = 0; i < count; ++i)
  {
    const MeasuredDisplacement& measured = measurements.displacements[i];
    probeOf.push_back(measured.probe);
    rows.push_back(measured.row);
    markers.push_back(measured.marker);
    displacements.col(i) = measured.displacement;
    deviations.col(i) = measured.deviation;
  }
  for (Eigen::Index p = 0; p < probes; ++p)
  {
    const Probe& probe = measurements.probes[p];
    names.push_back(probe.name);
    contacts.push_back(probe.contact);
    radii.push_back(probe.radius);
    forces.col(p) = probe.force;
  }
  setColumn(table, arrays::MeasurementProbe, probeOf);
  setColumn(table, arrays::MeasurementRow, rows);
  setPlaces(table, arrays::MeasurementVertex, arrays::MeasurementPoint, markers);
  setVectorsWithGaps(table, arrays::MeasuredDisplacement, displacements);
  if (measurements.hasDeviations())
  {
    setFieldVectors(table, arrays::MeasurementDeviation, deviations);
  }
  setFieldStrings(table, arrays::ProbeNames, names);
  setPlaces(table, arrays::ProbeVertex, arrays::ProbePoint, contacts);
  setColumn(table, arrays::ProbeRadius, radii);
  setFieldVectors(table, arrays::ProbeForce, forces);
}
} // namespace palpate::convert
