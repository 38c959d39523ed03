// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkShellGreensFunctions.h"

#include "conversion.h"
#include "model_arrays.h"
#include "shell/shell_greens_functions.h"
#include "shell_arrays.h"

#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <stdexcept>

vtkStandardNewMacro(vtkShellGreensFunctions);

void vtkShellGreensFunctions::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Thickness: " << this->Thickness << "\n"
     << indent << "Clamped: " << this->Clamped << "\n"
     << indent << "EstimateError: " << this->EstimateError << "\n";
}

void vtkShellGreensFunctions::Compute(
  vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  namespace convert = palpate::convert;
  if (this->PatchColumns)
  {
    throw std::invalid_argument(
      "a shell takes one traction a vertex, on folds, too: leave patch columns out");
  }
  const palpate::ElasticModel model =
    convert::modelOf(input, this->SmoothAngle, palpate::Domain::Shell);
  const palpate::ThinShell shell(model,
    convert::shellThicknessOf(input, model.mesh(), this->Thickness),
    convert::heldComponentsOf(input, model.conditions(), this->Clamped));
  vtkPolyData* computed = this->Kept(shell.fingerprint(model),
    [&](vtkPolyData* arrays)
    {
      palpate::ShellOptions options;
      options.reciprocal = this->Reciprocal;
      options.columns = this->Columns(input->GetNumberOfPoints());
      options.estimateError = this->EstimateError;
      convert::setGreensFunctions(arrays, model,
        palpate::computeShellGreensFunctions(model, shell, options,
          [this](double fraction, const char* stage)
          { return this->ReportProgress(fraction, stage); }));
    });
  convert::removeResponses(output);
  convert::shareGreensFunctions(computed, output, model.material().youngsModulus());
  convert::setShellArrays(output, this->Thickness, this->Clamped);
}
