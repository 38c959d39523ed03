// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/measured_data.h"

#include <conversion.h>
#include <measurement_arrays.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>

#include "mesh/surface_locator.h"
#include "terminal.h"

namespace palpate::app {
namespace {

Eigen::Vector3d vectorAt(vtkPolyData* model, const char* name, std::size_t tuple) {
  Eigen::Vector3d value;
  model->GetFieldData()->GetArray(name)->GetTuple(static_cast<vtkIdType>(tuple), value.data());
  return value;
}

double numberAt(vtkPolyData* model, const char* name, std::size_t tuple) {
  return model->GetFieldData()->GetArray(name)->GetComponent(static_cast<vtkIdType>(tuple), 0);
}

PlaceOnSurface placeOf(const SurfacePlaces& places, const RestPlace& place) {
  return place.vertex >= 0 ? places.atVertex(place.vertex) : places.at(place.point);
}

}  // namespace

struct SurfacePlaces::Parts {
  SurfaceLocator locator;
};

SurfacePlaces::SurfacePlaces(vtkPolyData* model)
    : parts_(new Parts{SurfaceLocator(std::make_shared<const SurfaceMesh>(
          convert::pointsOf(model), convert::trianglesOf(model), Rims::Allowed))}) {}

SurfacePlaces::~SurfacePlaces() = default;

PlaceOnSurface SurfacePlaces::at(const Eigen::Vector3d& place) const {
  const SurfaceMesh& mesh = parts_->locator.mesh();
  const SurfacePoint nearest = parts_->locator.nearest(place);
  return {palpate::placeOf(mesh, nearest), mesh.triangleNormals().col(nearest.triangle)};
}

PlaceOnSurface SurfacePlaces::atVertex(int vertex) const {
  const SurfaceMesh& mesh = parts_->locator.mesh();
  return {mesh.points().col(vertex), mesh.vertexNormals().col(vertex)};
}

double SurfacePlaces::diagonal() const {
  return parts_->locator.mesh().diagonal();
}

MeasuredData measuredDataOf(vtkPolyData* model) {
  const Measurements table = convert::measurementsOf(model);
  const SurfacePlaces places(model);
  MeasuredData data{{}, {}, places.diagonal()};
  for (std::size_t p = 0; p < table.probes.size(); ++p) {
    const Probe& probe = table.probes[p];
    data.probes.push_back({probe.name, placeOf(places, probe.contact), probe.force, probe.radius, 0,
                           static_cast<int>(numberAt(model, "ProbeOutliers", p)),
                           numberAt(model, "ProbeResidual", p),
                           numberAt(model, "ProbeRelativeResidual", p)});
  }
  const double noise = fieldNumber(model, "MeasurementNoise", 0),
               factor = std::max(1.0, fieldNumber(model, "MeasurementMisfit", 1));
  for (std::size_t i = 0; i < table.displacements.size(); ++i) {
    const MeasuredDisplacement& seen = table.displacements[i];
    const Eigen::Vector3d deviation = table.hasDeviations()
                                          ? Eigen::Vector3d(factor * seen.deviation)
                                          : Eigen::Vector3d::Constant(noise);
    const int row = static_cast<int>(numberAt(model, "MeasurementRow", i));
    data.readings.push_back({seen.probe, row, placeOf(places, seen.marker), seen.displacement,
                             vectorAt(model, "MeasurementResidual", i), deviation,
                             numberAt(model, "MeasurementOutlier", i) != 0});
    ++data.probes[seen.probe].markers;
  }
  return data;
}

MeasuredData observedDataOf(vtkPolyData* model) {
  const SurfacePlaces places(model);
  MeasuredData data{{}, {}, places.diagonal()};
  const Eigen::Vector3d deviation =
      Eigen::Vector3d::Constant(fieldNumber(model, "ObservationNoise", 0));
  vtkDataArray* points = model->GetFieldData()->GetArray("ObservedPoint");
  for (vtkIdType i = 0; i < points->GetNumberOfTuples(); ++i)
    data.readings.push_back({0, static_cast<int>(i), places.at(vectorAt(model, "ObservedPoint", i)),
                             vectorAt(model, "ObservedDisplacement", i),
                             vectorAt(model, "ObservedResidual", i), deviation, false});
  return data;
}

LengthUnit unitFor(double largest) {
  if (largest >= 0.1) return {1, "m"};
  return largest >= 1e-4 ? LengthUnit{1e3, "mm"} : LengthUnit{1e6, "µm"};
}

}  // namespace palpate::app
