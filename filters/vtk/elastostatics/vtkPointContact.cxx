// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkPointContact.h"

#include "array_names.h"
#include "contact/mask_settings.h"
#include "contact/point_contact.h"
#include "conversion.h"
#include "greens/surface_fields.h"
#include "model_arrays.h"

#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <stdexcept>

vtkStandardNewMacro(vtkPointContact);

/// Masks and stiffnesses, and what they were made of.
struct vtkPointContact::Prepared
{
  vtkPolyData* Input;
  vtkMTimeType InputTime;
  palpate::MaskSettings Mask;
  int Measure;
  double RigidStiffness;
  std::shared_ptr<const palpate::SurfaceStiffness> Stiffness;
};

vtkPointContact::vtkPointContact() = default;
vtkPointContact::~vtkPointContact() = default;

void vtkPointContact::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&](const char* name, const double* v)
  { os << indent << name << ": " << v[0] << ", " << v[1] << ", " << v[2] << "\n"; };
  print("Point", this->Point);
  print("Displacement", this->Displacement);
  print("Force", this->Force);
  print("Torque", this->Torque);
  os << indent << "Measure: " << this->Measure << "\n"
     << indent << "ForcePrescribed: " << this->ForcePrescribed << "\n"
     << indent << "RigidStiffness: " << this->RigidStiffness << "\n";
}

void vtkPointContact::SetDisplacement(double x, double y, double z)
{
  const double value[3] = { x, y, z };
  if (this->ForcePrescribed || !std::equal(value, value + 3, this->Displacement))
  {
    std::copy_n(value, 3, this->Displacement);
    this->ForcePrescribed = false;
    this->Modified();
  }
}

void vtkPointContact::SetForce(double x, double y, double z)
{
  const double value[3] = { x, y, z };
  if (!this->ForcePrescribed || !std::equal(value, value + 3, this->Force))
  {
    std::copy_n(value, 3, this->Force);
    this->ForcePrescribed = true;
    this->Modified();
  }
}

const vtkPointContact::Prepared& vtkPointContact::Prepare(vtkPolyData* input)
{
  const auto isSame = [](const palpate::MaskSettings& a, const palpate::MaskSettings& b)
  { return a.kind == b.kind && a.radius == b.radius && a.distance == b.distance; };
  const bool fits = this->Kept && this->Kept->Input == input &&
    this->Kept->InputTime == input->GetMTime() && this->Kept->Measure == this->Measure &&
    this->Kept->RigidStiffness == this->RigidStiffness;
  if (!fits ||
    !isSame(this->Kept->Mask, this->Settings(this->Kept->Stiffness->mesh().meanEdgeLength())))
  {
    this->Kept.reset();
    const palpate::convert::ServedModel served = palpate::convert::servedModelOf(input);
    const palpate::MaskSettings mask = this->Settings(served.mesh->meanEdgeLength());
    const auto masks = palpate::makeMasks(*served.mesh, served.greens->info().conditions, mask);
    const palpate::StiffnessOptions options{ this->RigidStiffness,
      static_cast<palpate::DisplacementMeasure>(this->Measure) };
    auto stiffness = std::make_shared<const palpate::SurfaceStiffness>(served.greens, served.mesh,
      *masks, options,
      [this](double fraction, const char* stage)
      { return this->ReportProgress(fraction, stage); });
    this->Kept.reset(new Prepared{
      input, input->GetMTime(), mask, this->Measure, this->RigidStiffness, std::move(stiffness) });
  }
  return *this->Kept;
}

void vtkPointContact::Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  namespace convert = palpate::convert;
  namespace arrays = palpate::arrays;
  const Eigen::Vector3d prescribed(this->ForcePrescribed ? this->Force : this->Displacement);
  const Eigen::Vector3d torque(this->Torque);
  if (!prescribed.allFinite() || !torque.allFinite())
  {
    throw std::invalid_argument(prescribed.allFinite()
        ? "the torque is not a finite number"
        : "the prescribed displacement or force is not a finite number");
  }
  const Prepared& prepared = this->Prepare(input);
  const palpate::SurfaceMesh& mesh = prepared.Stiffness->mesh();
  const palpate::SurfacePoint point =
    palpate::nearestSurfacePoint(mesh, Eigen::Vector3d(this->Point));
  const palpate::PointContact contact(prepared.Stiffness, point);
  palpate::ContactResponse response =
    this->ForcePrescribed ? contact.push(prescribed) : contact.displace(prescribed);
  Eigen::Matrix3Xd displacement, traction;
  convert::removeContact(output);
  if (torque.isZero(0))
  {
    contact.deform(response.force, displacement, traction);
  }
  else
  {
    convert::setFieldVector(output, arrays::ContactRotation,
      contact.deform(response.force, torque, displacement, traction));
    convert::setFieldVector(output, arrays::ContactTorque, torque);
    response.elasticPoint = response.staticPoint +
      displacement(Eigen::all, mesh.triangles().col(point.triangle)) * point.barycentric;
  }

  convert::setPointVectors(output, arrays::Displacement, displacement);
  convert::setPointVectors(output, arrays::Traction, traction);
  convert::setFieldNumber(output, arrays::LargestDisplacementGradient,
    palpate::surfaceGradients(mesh, displacement).largest);
  convert::setFieldVector(output, arrays::ContactForce, response.force);
  convert::setFieldVector(output, arrays::ContactPoint, response.staticPoint);
  convert::setFieldVector(output, arrays::ElasticContactPoint, response.elasticPoint);
  convert::setFieldVector(output, arrays::HapticContactPoint, response.hapticPoint);
}
