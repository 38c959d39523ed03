// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkVertexPressureMask.h"

#include "array_names.h"
#include "contact/mask_settings.h"
#include "contact/torque_mask.h"
#include "conversion.h"
#include "model_arrays.h"

#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkVertexPressureMask);

void vtkVertexPressureMask::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Vertex: " << this->Vertex << "\n" << indent << "Tensor: " << this->Tensor << "\n";
}

void vtkVertexPressureMask::Compute(
  vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  namespace convert = palpate::convert;
  const palpate::SurfaceMesh mesh = convert::meshOf(input);
  if (this->Vertex < 0 || this->Vertex >= mesh.vertexCount())
  {
    throw std::invalid_argument("there is no vertex " + std::to_string(this->Vertex) +
      ": the surface has " + std::to_string(mesh.vertexCount()));
  }
  const palpate::BoundaryConditions conditions(convert::boundaryTypesOf(input, false));
  const palpate::VertexMask mask =
    palpate::makeMasks(mesh, conditions, this->Settings(mesh.meanEdgeLength()))
      ->at(static_cast<int>(this->Vertex));
  Eigen::VectorXd density = Eigen::VectorXd::Zero(mesh.vertexCount());
  density(mask.nodes) = mask.density;
  convert::setPointNumbers(output, palpate::arrays::PressureMask, density);
  convert::setFieldNumber(output, palpate::arrays::MaskSupportShare, mask.supportShare);
  convert::setFieldNumber(output, palpate::arrays::MaskBeyondShare, mask.beyondShare);
  output->GetPointData()->RemoveArray(palpate::arrays::TorqueMask);
  if (this->Tensor)
  {
    const palpate::TorqueMask torque = palpate::torqueMask(mesh, mask);
    std::vector<Eigen::Matrix3d> tensors(mesh.vertexCount(), Eigen::Matrix3d::Zero());
    for (std::size_t j = 0; j < torque.nodes.size(); ++j)
    {
      tensors[torque.nodes[j]] = torque.tensor(static_cast<int>(j));
    }
    convert::setPointMatrices(output, palpate::arrays::TorqueMask, tensors);
  }
  convert::setPointNumbers(output, palpate::arrays::VertexArea, mesh.vertexAreas());
}
