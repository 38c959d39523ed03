// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkRigSimulation.h"

#include "contact/mask_settings.h"
#include "contact/point_load.h"
#include "conversion.h"
#include "identification/rig_simulation.h"
#include "measurement_arrays.h"
#include "model_arrays.h"

#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkRigSimulation);

void vtkRigSimulation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfProbes: " << this->NumberOfProbes << "\n"
     << indent << "NumberOfMarkers: " << this->NumberOfMarkers << "\n"
     << indent << "Radius: " << this->Radius << "\n"
     << indent << "Force: " << this->Force << "\n"
     << indent << "Tilt: " << this->Tilt << "\n"
     << indent << "Noise: " << this->Noise << "\n"
     << indent << "WithDeviations: " << this->WithDeviations << "\n"
     << indent << "PlaceNoise: " << this->PlaceNoise << "\n"
     << indent << "Outliers: " << this->Outliers << "\n"
     << indent << "Missing: " << this->Missing << "\n"
     << indent << "SupportYieldLength: " << this->SupportYieldLength << "\n"
     << indent << "Seed: " << this->Seed << "\n";
}

void vtkRigSimulation::Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  namespace convert = palpate::convert;
  const convert::ServedModel served = convert::servedModelOf(input);
  const palpate::SurfaceMesh& mesh = *served.mesh;
  const palpate::BoundaryConditions& conditions = served.greens->info().conditions;
  palpate::RigSettings rig;
  rig.probes = this->NumberOfProbes;
  rig.markers = this->NumberOfMarkers;
  rig.radius = this->Radius == 0 ? 2 * mesh.meanEdgeLength() : this->Radius;
  rig.force = this->Force;
  rig.tilt = this->Tilt;
  rig.noise = this->Noise;
  rig.withDeviations = this->WithDeviations;
  rig.placeNoise = this->PlaceNoise;
  rig.outliers = this->Outliers;
  rig.missing = this->Missing;
  rig.rotation = Eigen::Vector3d(this->Rotation);
  rig.translation = Eigen::Vector3d(this->Translation);
  rig.foundationLength = this->SupportYieldLength;
  rig.seed = static_cast<unsigned>(this->Seed);
  const palpate::Measurements measurements = palpate::simulateMeasurements(*served.greens, mesh,
    [&](const palpate::SurfacePoint& point, double radius)
    {
      const auto masks = palpate::makeMasks(mesh, conditions, { palpate::MaskKind::Linear, radius });
      return palpate::pointLoad(*masks, mesh, conditions, point);
    },
    rig);
  convert::removeResponses(output);
  convert::removeGreensFunctions(output);
  convert::setMeasurements(output, measurements);
}
