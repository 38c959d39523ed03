// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkImportedGreensFunctions.h"

#include "array_names.h"
#include "conversion.h"
#include "imported/imported_greens_functions.h"
#include "imported/matrix_file.h"
#include "units.h"
#include "model_arrays.h"

#include "vtkDoubleArray.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <stdexcept>

vtkStandardNewMacro(vtkImportedGreensFunctions);

namespace
{
Eigen::MatrixXd rowsOf(vtkDoubleArray* array)
{
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(
    array->GetPointer(0), array->GetNumberOfTuples(), array->GetNumberOfComponents());
}
} // namespace

vtkImportedGreensFunctions::vtkImportedGreensFunctions() = default;
vtkImportedGreensFunctions::~vtkImportedGreensFunctions() = default;

void vtkImportedGreensFunctions::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Kind: " << this->Kind << "\n"
     << indent << "MatrixFileName: " << this->MatrixFileName << "\n"
     << indent << "NodeFileName: " << this->NodeFileName << "\n"
     << indent << "MappingFileName: " << this->MappingFileName << "\n"
     << indent << "MatrixName: " << this->MatrixName << "\n"
     << indent << "Matrix: " << this->Matrix.Get() << "\n"
     << indent << "Nodes: " << this->Nodes.Get() << "\n"
     << indent << "DofOrder: " << this->DofOrder << "\n"
     << indent << "LengthUnit: " << this->LengthUnit << "\n"
     << indent << "ForceUnit: " << this->ForceUnit << "\n"
     << indent << "NodeTolerance: " << this->NodeTolerance << "\n"
     << indent << "YoungsModulus: " << this->YoungsModulus << "\n"
     << indent << "Unsupported: " << this->Unsupported << "\n";
}

void vtkImportedGreensFunctions::SetMatrixFileName(const char* name)
{
  this->SetName(this->MatrixFileName, name);
}

void vtkImportedGreensFunctions::SetNodeFileName(const char* name)
{
  this->SetName(this->NodeFileName, name);
}

void vtkImportedGreensFunctions::SetMappingFileName(const char* name)
{
  this->SetName(this->MappingFileName, name);
}

void vtkImportedGreensFunctions::SetMatrixName(const char* name)
{
  this->SetName(this->MatrixName, name);
}

void vtkImportedGreensFunctions::SetLengthUnit(const char* unit)
{
  this->SetName(this->LengthUnit, unit);
}

void vtkImportedGreensFunctions::SetForceUnit(const char* unit)
{
  this->SetName(this->ForceUnit, unit);
}

void vtkImportedGreensFunctions::SetMatrix(vtkDoubleArray* matrix)
{
  if (this->Matrix != matrix)
  {
    this->Matrix = matrix;
    this->Modified();
  }
}

void vtkImportedGreensFunctions::SetNodes(vtkDoubleArray* nodes)
{
  if (this->Nodes != nodes)
  {
    this->Nodes = nodes;
    this->Modified();
  }
}

vtkMTimeType vtkImportedGreensFunctions::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (vtkDoubleArray* array : { this->Matrix.Get(), this->Nodes.Get() })
  {
    time = array ? std::max(time, array->GetMTime()) : time;
  }
  return time;
}

void vtkImportedGreensFunctions::Compute(
  vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  namespace convert = palpate::convert;
  if (this->PatchColumns)
  {
    throw std::invalid_argument("a matrix of nodes says nothing of single patches of theirs: leave patch "
                                "columns out");
  }
  if (!this->Matrix == this->MatrixFileName.empty() || (this->Nodes && !this->NodeFileName.empty()))
  {
    throw std::invalid_argument(
      "a matrix is imported from a file or an array, its nodes likewise: give one of the two");
  }
  palpate::ImportOptions options;
  options.order = static_cast<palpate::DofOrder>(this->DofOrder);
  options.lengthUnit = palpate::lengthUnitNamed(this->LengthUnit);
  options.forceUnit = palpate::forceUnitNamed(this->ForceUnit);
  options.nodeTolerance = this->NodeTolerance;
  options.reciprocal = this->Reciprocal;
  options.columns = this->Columns(input->GetNumberOfPoints());
  options.youngsModulus = this->YoungsModulus;
  options.unsupported = this->Unsupported;
  const palpate::Progress progress(
    [this](double fraction, const char* stage) { return this->ReportProgress(fraction, stage); });
  const palpate::ElasticModel model =
    convert::modelOf(input, this->SmoothAngle, palpate::Domain::Given);
  vtkPolyData* computed = this->Kept(model.fingerprint(),
    [&](vtkPolyData* arrays)
    {
      progress.report(0, "read");
      const palpate::NodeTable nodes = this->Nodes
        ? palpate::nodesOf(rowsOf(this->Nodes), "the array of nodes")
        : this->NodeFileName.empty() ? palpate::NodeTable()
                                     : palpate::readNodeFile(this->NodeFileName);
      const palpate::GivenMatrix matrix = this->Matrix
        ? palpate::GivenMatrix(rowsOf(this->Matrix), "an array", "the array")
        : palpate::readMatrixFile(this->MatrixFileName, { this->MatrixName, this->MappingFileName });
      palpate::ImportedGreensFunctions result = palpate::importGreensFunctions(model,
        static_cast<palpate::MatrixKind>(this->Kind), matrix, nodes, options,
        progress.part(0.2, 1).callback());
      convert::setGreensFunctions(arrays, result.model, std::move(result.greens));
    });
  const double modulus = convert::fieldNumber(computed, palpate::arrays::GreensFunctionYoungsModulus, "");
  convert::removeResponses(output);
  convert::shareGreensFunctions(computed, output, modulus);
  convert::setFieldNumber(output, palpate::arrays::YoungsModulus, modulus);
  convert::setFieldNumber(output, palpate::arrays::PoissonRatio, 0);
  this->MarkPatches(input, model, output);
}
