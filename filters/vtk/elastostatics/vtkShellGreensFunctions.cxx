// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkShellGreensFunctions.h"

#include "array_names.h"
#include "conversion.h"
#include "model_arrays.h"
#include "shell/shell_greens_functions.h"
#include "shell_arrays.h"

#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <stdexcept>

vtkStandardNewMacro(vtkShellGreensFunctions);

void vtkShellGreensFunctions::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Thickness: " << this->Thickness << "\n"
     << indent << "Clamped: " << this->Clamped << "\n"
     << indent << "Unsupported: " << this->Unsupported << "\n"
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
  if (this->Unsupported && input->GetPointData()->HasArray(palpate::arrays::HeldComponents))
  {
    throw std::invalid_argument(
      "nothing holds an unsupported shell: take the point array 'HeldComponents' away");
  }
  const palpate::ElasticModel posed =
    convert::modelOf(input, this->SmoothAngle, palpate::Domain::Shell);
  const palpate::ElasticModel model = this->Unsupported
    ? palpate::ElasticModel(posed.sharedMesh(), posed.material(),
        palpate::BoundaryConditions(std::vector<unsigned char>(input->GetNumberOfPoints(), 0)),
        posed.smoothPatches(), posed.domain())
    : posed;
  const Eigen::Matrix3Xd thickness =
    convert::shellThicknessOf(input, model.mesh(), this->Thickness);
  const palpate::HeldComponents held =
    convert::heldComponentsOf(input, model.conditions(), this->Clamped);
  const auto compute = [&](const palpate::ShellOptions& options)
  {
    const palpate::ProgressCallback progress = [this](double fraction, const char* stage)
    { return this->ReportProgress(fraction, stage); };
    return this->Unsupported
      ? palpate::computeFreeShellGreensFunctions(model, thickness, options, progress)
      : palpate::computeShellGreensFunctions(
          model, palpate::ThinShell(model, thickness, held), options, progress);
  };
  vtkPolyData* computed = this->Kept(palpate::shellFingerprint(model.fingerprint(), thickness, held),
    [&](vtkPolyData* arrays)
    {
      palpate::ShellOptions options;
      options.reciprocal = this->Reciprocal;
      options.columns = this->Columns(input->GetNumberOfPoints());
      options.estimateError = this->EstimateError;
      convert::setGreensFunctions(arrays, model, compute(options));
    });
  convert::removeResponses(output);
  convert::shareGreensFunctions(computed, output, model.material().youngsModulus());
  convert::setShellArrays(output, this->Thickness, this->Clamped);
}
