// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkBoundaryElementGreensFunctions.h"

#include "array_names.h"
#include "conversion.h"
#include "model_arrays.h"
#include "smooth_patch_arrays.h"

#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

vtkStandardNewMacro(vtkBoundaryElementGreensFunctions);

/// Green's functions, and what they were computed from but for Young's modulus, which only scales them.
struct vtkBoundaryElementGreensFunctions::Computed
{
  std::uint64_t Fingerprint;
  vtkMTimeType Time; // of the filter's settings
  vtkNew<vtkPolyData> Arrays;
};

vtkBoundaryElementGreensFunctions::vtkBoundaryElementGreensFunctions() = default;
vtkBoundaryElementGreensFunctions::~vtkBoundaryElementGreensFunctions() = default;

void vtkBoundaryElementGreensFunctions::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Precision: " << this->Precision << "\n"
     << indent << "Solver: " << this->Solver << "\n"
     << indent << "Collocation: " << this->Collocation << "\n"
     << indent << "Domain: " << this->Domain << "\n"
     << indent << "Tolerance: " << this->Tolerance << "\n"
     << indent << "SmoothAngle: " << this->SmoothAngle << "\n"
     << indent << "SupportPatch: " << this->SupportPatch << "\n"
     << indent << "EstimateError: " << this->EstimateError << "\n"
     << indent << "Reciprocal: " << this->Reciprocal << "\n"
     << indent << "PatchColumns: " << this->PatchColumns << "\n"
     << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}

void vtkBoundaryElementGreensFunctions::SetColumnNodes(vtkIdTypeArray* nodes)
{
  if (this->ColumnNodes != nodes)
  {
    this->ColumnNodes = nodes;
    this->Modified();
  }
}

vtkIdTypeArray* vtkBoundaryElementGreensFunctions::GetColumnNodes()
{
  return this->ColumnNodes;
}

vtkMTimeType vtkBoundaryElementGreensFunctions::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->ColumnNodes ? std::max(own, this->ColumnNodes->GetMTime()) : own;
}

void vtkBoundaryElementGreensFunctions::Compute(
  vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  namespace convert = palpate::convert;
  const palpate::ElasticModel model = this->ModelOf(input);
  const vtkMTimeType time = this->GetMTime();
  if (!this->Kept || this->Kept->Fingerprint != model.fingerprint() || this->Kept->Time != time)
  {
    this->Kept.reset();
    std::unique_ptr<Computed> computed(new Computed{ model.fingerprint(), time, {} });
    convert::setGreensFunctions(computed->Arrays, model,
      palpate::computeBoundaryElementGreensFunctions(model,
        this->OptionsFor(input->GetNumberOfPoints()), [this](double fraction, const char* stage)
        { return this->ReportProgress(fraction, stage); }));
    this->Kept = std::move(computed);
  }
  convert::removeResponses(output);
  convert::shareGreensFunctions(this->Kept->Arrays, output, model.material().youngsModulus());
  this->MarkPatches(input, model, output);
}

palpate::ElasticModel vtkBoundaryElementGreensFunctions::ModelOf(vtkPolyData* surface) const
{
  const palpate::ElasticModel model = palpate::convert::modelOf(surface, this->SmoothAngle,
    this->Domain == EXTERIOR ? palpate::Domain::Exterior : palpate::Domain::Interior);
  return this->SupportPatch ? palpate::withSupportPatch(model) : model;
}

void vtkBoundaryElementGreensFunctions::MarkPatches(
  vtkPolyData* surface, const palpate::ElasticModel& model, vtkPolyData* output) const
{
  namespace arrays = palpate::arrays;
  if (palpate::convert::hasGivenPatches(surface, model.mesh()))
  {
    output->GetFieldData()->RemoveArray(arrays::SmoothAngle);
  }
  else
  {
    palpate::convert::setFieldNumber(output, arrays::SmoothAngle, this->SmoothAngle);
  }
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
  options.reciprocal = this->Reciprocal;
  options.estimateError = this->EstimateError;
  options.patchColumns = this->PatchColumns;
  options.threads = this->NumberOfThreads;
  for (vtkIdType i = 0; this->ColumnNodes && i < this->ColumnNodes->GetNumberOfValues(); ++i)
  {
    options.columns.push_back(palpate::convert::vertexNumber(
      static_cast<double>(this->ColumnNodes->GetValue(i)), vertexCount, "column ", i));
  }
  if (this->ColumnNodes && options.columns.empty())
  {
    throw std::invalid_argument("the list of columns to compute is empty");
  }
  return options;
}
