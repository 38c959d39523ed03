// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkSurfaceStiffness.h"

#include "array_names.h"
#include "contact/surface_stiffness.h"
#include "conversion.h"
#include "model_arrays.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkSurfaceStiffness);

void vtkSurfaceStiffness::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RigidStiffness: " << this->RigidStiffness << "\n";
}

void vtkSurfaceStiffness::Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  namespace convert = palpate::convert;
  namespace arrays = palpate::arrays;
  const convert::ServedModel served = convert::servedModelOf(input);
  const palpate::SurfaceStiffness stiffness(served.greens, served.mesh,
    static_cast<palpate::MaskShape>(this->Mask), this->RadiusFor(served.mesh->meanEdgeLength()),
    this->RigidStiffness,
    [this](double fraction, const char* stage) { return this->ReportProgress(fraction, stage); });

  const int count = served.mesh->vertexCount();
  vtkNew<vtkDoubleArray> matrices;
  matrices->SetName(arrays::Stiffness);
  matrices->SetNumberOfComponents(9);
  matrices->SetNumberOfTuples(count);
  Eigen::VectorXd norm(count), asymmetry(count), limited(count), ratio(count);
  for (int v = 0; v < count; ++v)
  {
    const Eigen::Matrix3d& k = stiffness.elastic(v);
    matrices->SetTypedTuple(v, k.data()); // symmetric: rows are columns
    norm[v] = k.norm();
    asymmetry[v] = stiffness.asymmetry(v);
    limited[v] = stiffness.isLimited(v);
    ratio[v] = stiffness.hapticRatio(v);
  }
  output->GetPointData()->AddArray(matrices);
  convert::setPointNumbers(output, arrays::StiffnessNorm, norm);
  convert::setPointNumbers(output, arrays::StiffnessAsymmetry, asymmetry);
  convert::setPointNumbers(output, arrays::StiffnessLimited, limited);
  convert::setPointNumbers(output, arrays::HapticRatio, ratio);
  convert::setPointNumbers(output, arrays::VertexArea, served.mesh->vertexAreas());
}
