// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkToleranceGreensFunctions.h"

#include "array_names.h"
#include "bem/tolerance_search.h"
#include "conversion.h"
#include "mesh/loop_limit.h"
#include "mesh/shells.h"
#include "model_arrays.h"
#include "vtkSurfaceRefinement.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkToleranceGreensFunctions);

namespace
{
/// A surface of the hierarchy and its model.
struct SurfaceLevel
{
  vtkSmartPointer<vtkPolyData> Surface;
  palpate::ElasticModel Model;
};
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
     << indent << "MaximumNumberOfLayers: " << this->MaximumNumberOfLayers << "\n"
     << indent << "MaximumNumberOfVertices: " << this->MaximumNumberOfVertices << "\n"
     << indent << "Subdivision: " << this->Subdivision << "\n";
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
  auto raw = vtkSmartPointer<vtkPolyData>::New();
  raw->ShallowCopy(input);
  std::vector<vtkSmartPointer<vtkPolyData>> levels{ raw };
  std::map<std::pair<int, int>, SurfaceLevel> meshes;
  const double share = this->MaximumNumberOfLevels > 0 ? palpate::kVolumeShare : 0;
  const auto at = [&](int level, int layers) -> const SurfaceLevel&
  {
    while (static_cast<int>(levels.size()) <= level)
    {
      levels.push_back(this->Refined(levels.back(), 1, 0, 0));
    }
    const auto found = meshes.find({ level, layers });
    if (found != meshes.end())
    {
      return found->second;
    }
    const auto surface = this->Refined(levels[level], 0, layers, share);
    const auto key = std::make_pair(level, layers);
    return meshes.emplace(key, SurfaceLevel{ surface, this->ModelOf(surface) }).first->second;
  };
  vtkPolyData* computed = this->Kept(at(0, 0).Model.fingerprint(),
    [&](vtkPolyData* arrays)
    {
      palpate::ToleranceResult result = this->Search(
        [&](int level, int layers) { return at(level, layers).Model; });
      const palpate::ElasticModel& chosen = at(result.level, result.layers).Model;
      this->WarnOfVolume(this->ModelOf(raw), chosen, result.greens.info.diagnostics.warnings);
      convert::setGreensFunctions(arrays, chosen, std::move(result.greens));
      this->Level = result.level;
      this->Layers = result.layers;
      this->Steps = std::move(result.steps);
    });
  const SurfaceLevel& level = at(this->Level, this->Layers);
  output->ShallowCopy(level.Surface);
  convert::removeMeshResults(output);
  convert::shareGreensFunctions(computed, output, level.Model.material().youngsModulus());
  this->MarkPatches(level.Surface, level.Model, output);
  convert::setFieldStrings(output, palpate::arrays::ToleranceSteps, this->Steps);
}

palpate::ToleranceResult vtkToleranceGreensFunctions::Search(
  const std::function<palpate::ElasticModel(int, int)>& mesh)
{
  palpate::ToleranceLimits limits;
  limits.levels = this->MaximumNumberOfLevels;
  limits.vertices = this->MaximumNumberOfVertices;
  limits.layers = this->MaximumNumberOfLevels > 0 ? this->MaximumNumberOfLayers : 0;
  return palpate::computeToTolerance(mesh, this->ErrorTolerance, limits, this->OptionsFor(0),
    [this](double fraction, const char* stage) { return this->ReportProgress(fraction, stage); });
}

void vtkToleranceGreensFunctions::WarnOfVolume(const palpate::ElasticModel& given,
  const palpate::ElasticModel& refined, std::vector<std::string>& warnings) const
{
  const auto volumeOf = [](const palpate::SurfaceMesh& mesh)
  { return palpate::enclosedVolume(mesh.points(), mesh.triangles()); };
  const double change = volumeOf(refined.mesh()) / volumeOf(given.mesh()) - 1;
  if (std::abs(change) <= this->ErrorTolerance)
  {
    return;
  }
  warnings.push_back("refinement has changed the volume by " +
    std::to_string(std::lround(100 * change)) + " %: where the surface is meant as it stands, choose the " +
    (this->Subdivision == vtkSurfaceRefinement::LOOP ? "curved or the flat" : "flat") +
    " subdivision, or give the surface finer");
}

vtkSmartPointer<vtkPolyData> vtkToleranceGreensFunctions::Refined(
  vtkPolyData* surface, int levels, int layers, double limitShare)
{
  vtkNew<vtkSurfaceRefinement> refinement;
  refinement->SetInputData(surface);
  refinement->SetNumberOfLevels(levels);
  refinement->SetSupportLayers(layers);
  refinement->SetSubdivision(this->Subdivision);
  refinement->SetLimitShare(limitShare);
  refinement->SetSmoothAngle(this->GetSmoothAngle());
  refinement->Update();
  if (refinement->GetFailureMessage()[0])
  {
    throw std::runtime_error(refinement->GetFailureMessage());
  }
  return refinement->GetOutput();
}
