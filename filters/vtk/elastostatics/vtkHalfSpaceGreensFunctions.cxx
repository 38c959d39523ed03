// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkHalfSpaceGreensFunctions.h"

#include "conversion.h"
#include "halfspace/half_space_greens_functions.h"
#include "model_arrays.h"

#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <stdexcept>

vtkStandardNewMacro(vtkHalfSpaceGreensFunctions);

void vtkHalfSpaceGreensFunctions::Compute(
  vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  namespace convert = palpate::convert;
  if (this->PatchColumns)
  {
    throw std::invalid_argument(
      "a flat surface has no sharp edges, whose patches could be loaded apart: leave patch columns out");
  }
  const palpate::ElasticModel model =
    convert::modelOf(input, this->SmoothAngle, palpate::Domain::HalfSpace);
  vtkPolyData* computed = this->Kept(model.fingerprint(),
    [&](vtkPolyData* arrays)
    {
      palpate::HalfSpaceOptions options;
      options.reciprocal = this->Reciprocal;
      options.columns = this->Columns(input->GetNumberOfPoints());
      palpate::ComputedGreensFunctions result;
      result.info = palpate::computeHalfSpaceGreensFunctions(model, options,
        [this](double fraction, const char* stage)
        { return this->ReportProgress(fraction, stage); })->info();
      convert::setGreensFunctions(arrays, model, std::move(result));
    });
  convert::removeResponses(output);
  convert::shareGreensFunctions(computed, output, model.material().youngsModulus());
  this->MarkPatches(input, model, output);
}
