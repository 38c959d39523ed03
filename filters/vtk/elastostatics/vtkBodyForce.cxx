// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkBodyForce.h"

#include "array_names.h"
#include "conversion.h"
#include "greens/gravity.h"
#include "greens/surface_fields.h"
#include "model_arrays.h"

#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <cmath>
#include <stdexcept>

vtkStandardNewMacro(vtkBodyForce);

/// A model and what its weight does.
struct vtkBodyForce::Prepared
{
  vtkPolyData* Input;
  vtkMTimeType Time;
  palpate::convert::ServedModel Served;
  Eigen::MatrixXd Response;
};

vtkBodyForce::vtkBodyForce() = default;
vtkBodyForce::~vtkBodyForce() = default;

void vtkBodyForce::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Acceleration: " << this->Acceleration[0] << " " << this->Acceleration[1] << " "
     << this->Acceleration[2] << "\n"
     << indent << "Density: " << this->Density << "\n";
}

void vtkBodyForce::Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  namespace convert = palpate::convert;
  namespace arrays = palpate::arrays;
  const Eigen::Vector3d acceleration(this->Acceleration);
  if (!acceleration.allFinite())
  {
    throw std::invalid_argument("the acceleration is not a finite number");
  }
  if (!this->Kept || this->Kept->Input != input || this->Kept->Time != input->GetMTime())
  {
    this->Kept.reset();
    convert::ServedModel served = convert::servedModelOf(input);
    this->Kept.reset(new Prepared{ input, input->GetMTime(), std::move(served), {} });
  }
  const palpate::GreensFunctions& greens = *this->Kept->Served.greens;
  const double density = this->Density != 0 ? this->Density : greens.info().density;
  if (!(density > 0 && std::isfinite(density)))
  {
    throw std::invalid_argument(this->Density == 0
        ? "the model does not know its density: give one, kg/m^3"
        : "the density must be a positive number, not " + std::to_string(this->Density));
  }
  if (this->Kept->Response.size() == 0)
  {
    this->Kept->Response =
      palpate::weightResponse(greens, *this->Kept->Served.mesh, this->Kept->Served.smoothPatches);
  }
  const Eigen::Matrix3Xd answer =
    (this->Kept->Response * (density * acceleration)).reshaped(3, greens.nodeCount());
  Eigen::Matrix3Xd displacement = answer, traction = Eigen::Matrix3Xd::Zero(3, answer.cols());
  for (int node : greens.info().conditions.fixedNodes())
  {
    traction.col(node) = answer.col(node);
    displacement.col(node).setZero();
  }
  convert::removeContact(output);
  convert::setPointVectors(output, arrays::Displacement, displacement);
  convert::setPointVectors(output, arrays::Traction, traction);
  convert::setFieldNumber(output, arrays::LargestDisplacementGradient,
    palpate::surfaceGradients(*this->Kept->Served.mesh, displacement).largest);
}
