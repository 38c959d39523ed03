// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkSurfaceStiffness.h"

#include "array_names.h"
#include "contact/mask_settings.h"
#include "contact/surface_stiffness.h"
#include "contact/torque_mask.h"
#include "conversion.h"
#include "model_arrays.h"

#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <vector>

vtkStandardNewMacro(vtkSurfaceStiffness);

void vtkSurfaceStiffness::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RigidStiffness: " << this->RigidStiffness << "\n"
     << indent << "Measure: " << this->Measure << "\n"
     << indent << "Rotational: " << this->Rotational << "\n";
}

void vtkSurfaceStiffness::Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  namespace convert = palpate::convert;
  namespace arrays = palpate::arrays;
  const convert::ServedModel served = convert::servedModelOf(input);
  const auto masks = palpate::makeMasks(*served.mesh, served.greens->info().conditions,
    this->Settings(served.mesh->meanEdgeLength()));
  const auto report = [this](double fraction, const char* stage)
  { return this->ReportProgress(fraction, stage); };
  const palpate::SurfaceStiffness stiffness(served.greens, served.mesh, *masks,
    { this->RigidStiffness, static_cast<palpate::DisplacementMeasure>(this->Measure) }, report);

  const int count = served.mesh->vertexCount();
  std::vector<Eigen::Matrix3d> matrices;
  Eigen::VectorXd norm(count), asymmetry(count), limited(count), ratio(count), held(count),
    beyond(count);
  for (int v = 0; v < count; ++v)
  {
    matrices.push_back(stiffness.elastic(v));
    norm[v] = stiffness.elastic(v).norm();
    asymmetry[v] = stiffness.asymmetry(v);
    limited[v] = stiffness.isLimited(v);
    ratio[v] = stiffness.hapticRatio(v);
    held[v] = stiffness.mask(v).supportShare;
    beyond[v] = stiffness.mask(v).beyondShare;
  }
  output->GetPointData()->RemoveArray(arrays::RotationalStiffness);
  if (this->Rotational)
  {
    convert::setPointMatrices(
      output, arrays::RotationalStiffness, palpate::rotationalStiffnesses(stiffness, report));
  }
  convert::setPointMatrices(output, arrays::Stiffness, matrices);
  convert::setPointNumbers(output, arrays::StiffnessNorm, norm);
  convert::setPointNumbers(output, arrays::StiffnessAsymmetry, asymmetry);
  convert::setPointNumbers(output, arrays::StiffnessLimited, limited);
  convert::setPointNumbers(output, arrays::HapticRatio, ratio);
  convert::setPointNumbers(output, arrays::MaskSupportShare, held);
  convert::setPointNumbers(output, arrays::MaskBeyondShare, beyond);
  convert::setPointNumbers(output, arrays::VertexArea, served.mesh->vertexAreas());
}
