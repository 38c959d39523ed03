// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkGreensFunctionsAlgorithm.h"

#include "array_names.h"
#include "conversion.h"
#include "model/elastic_model.h"
#include "smooth_patch_arrays.h"

#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <stdexcept>

vtkGreensFunctionsAlgorithm::vtkGreensFunctionsAlgorithm() = default;
vtkGreensFunctionsAlgorithm::~vtkGreensFunctionsAlgorithm() = default;

void vtkGreensFunctionsAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SmoothAngle: " << this->SmoothAngle << "\n"
     << indent << "Reciprocal: " << this->Reciprocal << "\n"
     << indent << "PatchColumns: " << this->PatchColumns << "\n"
     << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}

void vtkGreensFunctionsAlgorithm::SetColumnNodes(vtkIdTypeArray* nodes)
{
  if (this->ColumnNodes != nodes)
  {
    this->ColumnNodes = nodes;
    this->Modified();
  }
}

vtkIdTypeArray* vtkGreensFunctionsAlgorithm::GetColumnNodes()
{
  return this->ColumnNodes;
}

vtkMTimeType vtkGreensFunctionsAlgorithm::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->ColumnNodes ? std::max(own, this->ColumnNodes->GetMTime()) : own;
}

vtkPolyData* vtkGreensFunctionsAlgorithm::Kept(
  std::uint64_t fingerprint, const std::function<void(vtkPolyData*)>& compute)
{
  const vtkMTimeType time = this->GetMTime();
  if (!this->KeptArrays || this->KeptFingerprint != fingerprint || this->KeptTime != time)
  {
    this->KeptArrays = nullptr;
    const auto arrays = vtkSmartPointer<vtkPolyData>::New();
    compute(arrays);
    this->KeptArrays = arrays;
    this->KeptFingerprint = fingerprint;
    this->KeptTime = time;
  }
  return this->KeptArrays;
}

std::vector<int> vtkGreensFunctionsAlgorithm::Columns(vtkIdType vertexCount) const
{
  std::vector<int> columns;
  for (vtkIdType i = 0; this->ColumnNodes && i < this->ColumnNodes->GetNumberOfValues(); ++i)
  {
    columns.push_back(palpate::convert::vertexNumber(
      static_cast<double>(this->ColumnNodes->GetValue(i)), vertexCount, "column ", i));
  }
  if (this->ColumnNodes && columns.empty())
  {
    throw std::invalid_argument("the list of columns to compute is empty");
  }
  return columns;
}

void vtkGreensFunctionsAlgorithm::MarkPatches(
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
