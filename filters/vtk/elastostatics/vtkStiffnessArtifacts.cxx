// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkStiffnessArtifacts.h"

#include "array_names.h"
#include "contact/stiffness_artifacts.h"
#include "contact/surface_stiffness.h"
#include "conversion.h"
#include "model_arrays.h"

#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <limits>
#include <stdexcept>
#include <vector>

vtkStandardNewMacro(vtkStiffnessArtifacts);

namespace arrays = palpate::arrays;
namespace convert = palpate::convert;

vtkStiffnessArtifacts::vtkStiffnessArtifacts()
{
  this->SetNumberOfInputPorts(2);
}

void vtkStiffnessArtifacts::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SmoothingLength: " << this->SmoothingLength << "\n";
}

int vtkStiffnessArtifacts::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return this->Superclass::FillInputPortInformation(port, info);
}

namespace
{
constexpr double Nothing = std::numeric_limits<double>::quiet_NaN();

/// The elastic stiffnesses that a surface carries, NaN at fixed vertices.
std::vector<Eigen::Matrix3d> elasticStiffnessOf(vtkPolyData* surface)
{
  std::vector<Eigen::Matrix3d> matrices =
    convert::pointMatricesOf(surface, arrays::Stiffness, "compute the reference's stiffness first");
  const std::vector<unsigned char> types = convert::boundaryTypesOf(surface, false);
  for (std::size_t v = 0; v < matrices.size(); ++v)
  {
    if (types[v] != 0)
    {
      matrices[v].setConstant(Nothing);
    }
  }
  return matrices;
}

Eigen::VectorXd normsOf(const std::vector<Eigen::Matrix3d>& matrices)
{
  Eigen::VectorXd norms(matrices.size());
  for (std::size_t v = 0; v < matrices.size(); ++v)
  {
    norms[v] = matrices[v].norm();
  }
  return norms;
}

void setPrincipalStiffnesses(vtkPolyData* output, const palpate::SurfaceMesh& mesh,
  const std::vector<Eigen::Matrix3d>& elastic)
{
  Eigen::VectorXd condition = Eigen::VectorXd::Constant(mesh.vertexCount(), Nothing);
  std::vector<Eigen::Matrix3Xd> axes(3, Eigen::Matrix3Xd::Zero(3, mesh.vertexCount()));
  for (int v = 0; v < mesh.vertexCount(); ++v)
  {
    if (elastic[v].hasNaN())
    {
      continue;
    }
    const auto principal = palpate::principalStiffness(elastic[v], mesh.vertexNormals().col(v));
    condition[v] = principal.condition;
    for (int k = 0; k < 3; ++k)
    {
      axes[k].col(v) = principal.values[k] * principal.directions.col(k);
    }
  }
  convert::setPointNumbers(output, arrays::StiffnessCondition, condition);
  convert::setPointVectors(output, arrays::PrincipalStiffness1, axes[0]);
  convert::setPointVectors(output, arrays::PrincipalStiffness2, axes[1]);
  convert::setPointVectors(output, arrays::PrincipalStiffness3, axes[2]);
}

/// K^H = eta K^E.
void setHapticStiffness(vtkPolyData* output)
{
  std::vector<Eigen::Matrix3d> matrices =
    convert::pointMatricesOf(output, arrays::Stiffness, "it has just been computed");
  vtkDataArray* ratios = output->GetPointData()->GetArray(arrays::HapticRatio);
  for (std::size_t v = 0; v < matrices.size(); ++v)
  {
    matrices[v] *= ratios->GetComponent(v, 0);
  }
  convert::setPointMatrices(output, arrays::HapticStiffness, matrices);
}

void setChange(vtkPolyData* output, const palpate::SurfaceMesh& mesh, const Eigen::VectorXd& norms,
  vtkPolyData* reference)
{
  const std::vector<Eigen::Matrix3d> stiffness = elasticStiffnessOf(reference);
  const palpate::SurfaceLocator locator(
    std::make_shared<const palpate::SurfaceMesh>(convert::meshOf(reference)));
  const palpate::StiffnessChange found =
    palpate::compareStiffness(mesh, norms, locator, stiffness);
  convert::setPointNumbers(output, arrays::StiffnessChange, found.change);
  convert::setFieldNumbers(output, arrays::StiffnessChangeMeasures,
    { found.median, found.variation, found.ninetyFifth, static_cast<double>(found.matched) });
}
} // namespace

void vtkStiffnessArtifacts::Compute(
  vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs)
{
  const convert::ServedModel served = convert::servedModelOf(input);
  const palpate::SurfaceMesh& mesh = *served.mesh;
  for (const char* name : { arrays::StiffnessChange, arrays::StiffnessChangeMeasures })
  {
    output->GetPointData()->RemoveArray(name); // of another reference
    output->GetFieldData()->RemoveArray(name);
  }
  const palpate::SurfaceStiffness single(served.greens, served.mesh, palpate::MaskShape::Linear, 0);
  this->Superclass::Compute(input, output, inputs);

  const std::vector<Eigen::Matrix3d> elastic = elasticStiffnessOf(output);
  Eigen::VectorXd singleNorms(mesh.vertexCount());
  for (int v = 0; v < mesh.vertexCount(); ++v)
  {
    singleNorms[v] = served.greens->isFixed(v) ? Nothing : single.elastic(v).norm();
  }
  const Eigen::VectorXd norms = normsOf(elastic);
  const double length = this->SmoothingLength != 0 ? this->SmoothingLength : 0.1 * mesh.diagonal();
  const palpate::BoundaryConditions& conditions = served.greens->info().conditions;
  const auto bare = palpate::findStiffnessArtifacts(mesh, conditions, singleNorms, length);
  const auto masked = palpate::findStiffnessArtifacts(mesh, conditions, norms, length);

  setHapticStiffness(output);
  setPrincipalStiffnesses(output, mesh, elastic);
  convert::setPointNumbers(output, arrays::SingleVertexStiffnessNorm, singleNorms);
  convert::setPointNumbers(output, arrays::SmoothStiffnessNorm, masked.smooth);
  convert::setPointNumbers(output, arrays::StiffnessArtifact, masked.artifact);
  convert::setPointNumbers(output, arrays::SingleVertexArtifact, bare.artifact);
  convert::setPointNumbers(output, arrays::StiffnessJump, masked.jump);
  convert::setFieldNumbers(
    output, arrays::ArtifactVariation, { bare.variation, masked.variation });
  convert::setFieldNumbers(
    output, arrays::ArtifactAreaCorrelation, { bare.areaCorrelation, masked.areaCorrelation });
  convert::setFieldNumbers(
    output, arrays::ArtifactLargestJump, { bare.largestJump, masked.largestJump });
  convert::setFieldNumber(output, arrays::SmoothingLength, length);
  if (vtkPolyData* reference = vtkPolyData::GetData(inputs[1]))
  {
    setChange(output, mesh, norms, reference);
  }
}
