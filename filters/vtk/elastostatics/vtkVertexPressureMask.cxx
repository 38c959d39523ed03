// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkVertexPressureMask.h"

#include "array_names.h"
#include "contact/pressure_mask.h"
#include "conversion.h"

#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <stdexcept>
#include <string>

vtkStandardNewMacro(vtkVertexPressureMask);

void vtkVertexPressureMask::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Vertex: " << this->Vertex << "\n";
}

void vtkVertexPressureMask::Compute(
  vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  namespace convert = palpate::convert;
  const palpate::SurfaceMesh mesh(convert::pointsOf(input), convert::trianglesOf(input));
  if (this->Vertex < 0 || this->Vertex >= mesh.vertexCount())
  {
    throw std::invalid_argument("there is no vertex " + std::to_string(this->Vertex) +
      ": the surface has " + std::to_string(mesh.vertexCount()));
  }
  const palpate::BoundaryConditions conditions(convert::boundaryTypesOf(input, false));
  const palpate::PressureMasks masks(mesh, conditions,
    static_cast<palpate::MaskShape>(this->Mask), this->RadiusFor(mesh.meanEdgeLength()));
  const palpate::VertexMask mask = masks.at(static_cast<int>(this->Vertex));
  Eigen::VectorXd density = Eigen::VectorXd::Zero(mesh.vertexCount());
  density(mask.nodes) = mask.density;
  convert::setPointNumbers(output, palpate::arrays::PressureMask, density);
  convert::setPointNumbers(output, palpate::arrays::VertexArea, mesh.vertexAreas());
}
