// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkIsotropicRemeshing.h"

#include "array_names.h"
#include "conversion.h"
#include "mesh/remeshing.h"
#include "mesh/smooth_patches.h"
#include "mesh/surface_mesh.h"
#include "model_arrays.h"
#include "original_arrays.h"
#include "smooth_patch_arrays.h"

#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <memory>

vtkStandardNewMacro(vtkIsotropicRemeshing);

namespace arrays = palpate::arrays;
namespace convert = palpate::convert;

void vtkIsotropicRemeshing::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "EdgeLength: " << this->EdgeLength << "\n"
     << indent << "NumberOfIterations: " << this->NumberOfIterations << "\n"
     << indent << "SmoothAngle: " << this->SmoothAngle << "\n"
     << indent << "KeepOriginal: " << this->KeepOriginal << "\n";
}

void vtkIsotropicRemeshing::Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  const palpate::SurfaceMesh mesh(convert::pointsOf(input), convert::trianglesOf(input));
  const bool hasTypes = input->GetPointData()->HasArray(arrays::BoundaryType);
  const bool hasPatches =
    input->GetCellData()->HasArray(arrays::SmoothPatch) && convert::hasGivenPatches(input, mesh);
  const Eigen::VectorXi patches =
    hasPatches ? convert::storedPatches(input) : palpate::findSmoothPatches(mesh, this->SmoothAngle);
  const palpate::RemeshedSurface remeshed = palpate::remeshIsotropic(mesh.points(), mesh.triangles(),
    convert::boundaryTypesOf(input, true), patches,
    this->EdgeLength != 0 ? this->EdgeLength : mesh.meanEdgeLength(), this->NumberOfIterations,
    [this](double fraction, const char* stage) { return this->ReportProgress(fraction, stage); });

  output->Initialize();
  output->GetFieldData()->ShallowCopy(input->GetFieldData());
  convert::removeMeshResults(output);
  output->GetFieldData()->RemoveArray(arrays::SmoothAngle);
  convert::setSurface(output, remeshed.points, remeshed.triangles);
  if (hasTypes)
  {
    convert::setBoundaryTypes(output, remeshed.boundaryTypes);
  }
  if (hasPatches)
  {
    convert::setSmoothPatches(output, remeshed.smoothPatches);
  }
  if (this->KeepOriginal)
  {
    convert::setOriginal(output,
      std::make_shared<const palpate::SurfaceMesh>(remeshed.points, remeshed.triangles),
      convert::hasOriginal(input) ? convert::originalOf(input) : mesh);
  }
}
