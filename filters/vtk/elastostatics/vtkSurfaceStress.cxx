// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkSurfaceStress.h"

#include "greens/surface_fields.h"
#include "stress_arrays.h"

#include "vtkCellData.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkSurfaceStress);

void vtkSurfaceStress::Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  std::vector<palpate::Elasticity> materials;
  const palpate::convert::DeformedBody body = palpate::convert::deformedSurfaceOf(input, materials);
  const palpate::SurfaceFields fields = materials.empty()
    ? palpate::surfaceFields(body.model, body.displacement, body.traction)
    : palpate::surfaceFields(body.model, materials, body.displacement, body.traction);
  palpate::convert::setStresses(output->GetCellData(), fields.gradient, fields.stress);
}
