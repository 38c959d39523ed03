// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkToleranceGreensFunctions.h"

#include "array_names.h"
#include "bem/tolerance_search.h"
#include "conversion.h"
#include "model_arrays.h"
#include "smooth_patch_arrays.h"
#include "vtkLoopRefinement.h"

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkToleranceGreensFunctions);

namespace
{
/// A surface and what Loop's scheme makes of it, level by level.
class Hierarchy
{
public:
  explicit Hierarchy(vtkPolyData* surface)
  {
    this->Levels.push_back(vtkSmartPointer<vtkPolyData>::New());
    this->Levels.front()->ShallowCopy(surface);
  }

  vtkPolyData* Level(int level)
  {
    while (static_cast<int>(this->Levels.size()) <= level)
    {
      vtkNew<vtkLoopRefinement> refinement;
      refinement->SetInputData(this->Levels.back());
      refinement->Update();
      if (refinement->GetFailureMessage()[0])
      {
        throw std::runtime_error(refinement->GetFailureMessage());
      }
      this->Levels.push_back(refinement->GetOutput());
    }
    return this->Levels[level];
  }

private:
  std::vector<vtkSmartPointer<vtkPolyData>> Levels;
};

double volumeOf(const palpate::SurfaceMesh& mesh)
{
  double volume = 0;
  for (int f = 0; f < mesh.triangleCount(); ++f)
  {
    const Eigen::Vector3d corner = mesh.points().col(mesh.triangles()(0, f));
    volume += mesh.triangleAreas()[f] * mesh.triangleNormals().col(f).dot(corner) / 3;
  }
  return volume;
}
} // namespace

vtkToleranceGreensFunctions::vtkToleranceGreensFunctions()
{
  this->SetSupportPatch(true);
}

void vtkToleranceGreensFunctions::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ErrorTolerance: " << this->ErrorTolerance << "\n"
     << indent << "MaximumNumberOfLevels: " << this->MaximumNumberOfLevels << "\n"
     << indent << "MaximumNumberOfVertices: " << this->MaximumNumberOfVertices << "\n";
}

void vtkToleranceGreensFunctions::Compute(
  vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  namespace convert = palpate::convert;
  if (this->GetColumnNodes())
  {
    throw std::invalid_argument("columns cannot be chosen together with a tolerance: the levels that "
                                "it chooses from have other vertices");
  }
  Hierarchy hierarchy(input);
  const auto posed = [&](int level)
  {
    auto surface = vtkSmartPointer<vtkPolyData>::New();
    surface->ShallowCopy(hierarchy.Level(level));
    if (this->GetSupportPatch())
    {
      convert::splitPatchesAtSupport(surface, this->GetSmoothAngle());
    }
    return surface;
  };
  const auto modelOf = [&](vtkPolyData* surface)
  {
    return convert::modelOf(surface, this->GetSmoothAngle(),
      this->GetDomain() == EXTERIOR ? palpate::Domain::Exterior : palpate::Domain::Interior);
  };
  palpate::ToleranceLimits limits;
  limits.levels = this->MaximumNumberOfLevels;
  limits.vertices = this->MaximumNumberOfVertices;
  palpate::ToleranceResult result = palpate::computeToTolerance(
    [&](int level) { return modelOf(posed(level)); }, this->ErrorTolerance, limits,
    this->OptionsFor(input->GetNumberOfPoints()), [this](double fraction, const char* stage)
    { return this->ReportProgress(fraction, stage); });

  const auto surface = posed(result.level);
  const palpate::ElasticModel model = modelOf(surface);
  const double change = volumeOf(model.mesh()) / volumeOf(modelOf(posed(0)).mesh()) - 1;
  if (std::abs(change) > this->ErrorTolerance)
  {
    result.greens.info.diagnostics.warnings.push_back(
      "Loop's refinement has changed the volume by " + std::to_string(std::lround(100 * change)) +
      " %, as the surface was taken to control a smooth one: where it is meant as it stands, give it "
      "finer, or forbid levels");
  }
  output->ShallowCopy(surface);
  convert::removeMeshResults(output);
  convert::setGreensFunctions(output, model, std::move(result.greens));
  if (convert::hasGivenPatches(surface, model.mesh()))
  {
    output->GetFieldData()->RemoveArray(palpate::arrays::SmoothAngle);
  }
  else
  {
    convert::setFieldNumber(output, palpate::arrays::SmoothAngle, this->GetSmoothAngle());
  }
  convert::setFieldStrings(output, palpate::arrays::ToleranceSteps, result.steps);
}
