// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkPointContact.h"

#include "array_names.h"
#include "contact/point_contact.h"
#include "conversion.h"
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
  int Mask;
  double Radius, RigidStiffness;
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
  os << indent << "ForcePrescribed: " << this->ForcePrescribed << "\n"
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
  const bool fits = this->Kept && this->Kept->Input == input &&
    this->Kept->InputTime == input->GetMTime() && this->Kept->Mask == this->Mask &&
    this->Kept->RigidStiffness == this->RigidStiffness;
  if (!fits || this->Kept->Radius != this->RadiusFor(this->Kept->Stiffness->mesh().meanEdgeLength()))
  {
    this->Kept.reset();
    const palpate::convert::ServedModel served = palpate::convert::servedModelOf(input);
    const double radius = this->RadiusFor(served.mesh->meanEdgeLength());
    auto stiffness = std::make_shared<const palpate::SurfaceStiffness>(served.greens, served.mesh,
      static_cast<palpate::MaskShape>(this->Mask), radius, this->RigidStiffness,
      [this](double fraction, const char* stage)
      { return this->ReportProgress(fraction, stage); });
    this->Kept.reset(new Prepared{
      input, input->GetMTime(), this->Mask, radius, this->RigidStiffness, std::move(stiffness) });
  }
  return *this->Kept;
}

void vtkPointContact::Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  namespace convert = palpate::convert;
  namespace arrays = palpate::arrays;
  const Eigen::Vector3d prescribed(this->ForcePrescribed ? this->Force : this->Displacement);
  if (!prescribed.allFinite())
  {
    throw std::invalid_argument("the prescribed displacement or force is not a finite number");
  }
  const Prepared& prepared = this->Prepare(input);
  const palpate::PointContact contact(prepared.Stiffness,
    palpate::nearestSurfacePoint(prepared.Stiffness->mesh(), Eigen::Vector3d(this->Point)));
  const palpate::ContactResponse response =
    this->ForcePrescribed ? contact.push(prescribed) : contact.displace(prescribed);
  Eigen::Matrix3Xd displacement, traction;
  contact.deform(response.force, displacement, traction);

  convert::removeContact(output);
  convert::setPointVectors(output, arrays::Displacement, displacement);
  convert::setPointVectors(output, arrays::Traction, traction);
  convert::setFieldVector(output, arrays::ContactForce, response.force);
  convert::setFieldVector(output, arrays::ContactPoint, response.staticPoint);
  convert::setFieldVector(output, arrays::ElasticContactPoint, response.elasticPoint);
  convert::setFieldVector(output, arrays::HapticContactPoint, response.hapticPoint);
}
