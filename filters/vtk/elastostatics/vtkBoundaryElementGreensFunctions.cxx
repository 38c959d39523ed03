// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkBoundaryElementGreensFunctions.h"

#include "array_names.h"
#include "bem/boundary_element_method.h"
#include "conversion.h"
#include "model_arrays.h"

#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <stdexcept>

vtkStandardNewMacro(vtkBoundaryElementGreensFunctions);

void vtkBoundaryElementGreensFunctions::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Precision: " << this->Precision << "\n"
     << indent << "Solver: " << this->Solver << "\n"
     << indent << "Collocation: " << this->Collocation << "\n"
     << indent << "Domain: " << this->Domain << "\n"
     << indent << "Tolerance: " << this->Tolerance << "\n"
     << indent << "SupportPatch: " << this->SupportPatch << "\n"
     << indent << "EstimateError: " << this->EstimateError << "\n";
}

void vtkBoundaryElementGreensFunctions::Compute(
  vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  namespace convert = palpate::convert;
  const palpate::ElasticModel model = this->ModelOf(input);
  vtkPolyData* computed = this->Kept(model.fingerprint(),
    [&](vtkPolyData* arrays)
    {
      convert::setGreensFunctions(arrays, model,
        palpate::computeBoundaryElementGreensFunctions(model,
          this->OptionsFor(input->GetNumberOfPoints()), [this](double fraction, const char* stage)
          { return this->ReportProgress(fraction, stage); }));
    });
  convert::removeResponses(output);
  convert::shareGreensFunctions(computed, output, model.material().youngsModulus());
  this->MarkPatches(input, model, output);
}

palpate::ElasticModel vtkBoundaryElementGreensFunctions::ModelOf(vtkPolyData* surface) const
{
  if (surface->GetPointData()->HasArray(palpate::arrays::HeldComponents))
  {
    throw std::invalid_argument("the point array 'HeldComponents' holds single components, which boundary "
                                "elements cannot: choose finite elements, or take the array away");
  }
  const palpate::ElasticModel model = palpate::convert::modelOf(surface, this->SmoothAngle,
    this->Domain == EXTERIOR       ? palpate::Domain::Exterior
      : this->Domain == UNSUPPORTED ? palpate::Domain::Unsupported
                                    : palpate::Domain::Interior);
  return this->SupportPatch ? palpate::withSupportPatch(model) : model;
}

palpate::BoundaryElementOptions vtkBoundaryElementGreensFunctions::OptionsFor(
  vtkIdType vertexCount) const
{
  palpate::BoundaryElementOptions options;
  options.precision = static_cast<palpate::Precision>(this->Precision);
  options.solver =
    this->Solver == ITERATIVE ? palpate::LinearSolver::Iterative : palpate::LinearSolver::Direct;
  options.collocation =
    this->Collocation == VERTEX ? palpate::Collocation::Vertex : palpate::Collocation::Averaged;
  options.tolerance = this->Tolerance;
  options.columns = this->Columns(vertexCount);
  options.reciprocal = this->Reciprocal;
  options.estimateError = this->EstimateError;
  options.patchColumns = this->PatchColumns;
  options.threads = this->NumberOfThreads;
  return options;
}
