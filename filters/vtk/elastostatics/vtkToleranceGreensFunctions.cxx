// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkToleranceGreensFunctions.h"

#include "array_names.h"
#include "bem/tolerance_search.h"
#include "conversion.h"
#include "mesh/shells.h"
#include "model_arrays.h"
#include "vtkSurfaceRefinement.h"

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
  std::vector<SurfaceLevel> levels;
  const auto at = [&](int level) -> const SurfaceLevel&
  {
    while (static_cast<int>(levels.size()) <= level)
    {
      if (!levels.empty())
      {
        raw = this->Refined(raw);
      }
      levels.push_back({ raw, this->ModelOf(raw) });
    }
    return levels[level];
  };
  vtkPolyData* computed = this->Kept(at(0).Model.fingerprint(),
    [&](vtkPolyData* arrays)
    {
      palpate::ToleranceResult result = this->Search([&](int level) { return at(level).Model; });
      const palpate::ElasticModel& chosen = at(result.level).Model;
      this->WarnOfVolume(at(0).Model, chosen, result.greens.info.diagnostics.warnings);
      convert::setGreensFunctions(arrays, chosen, std::move(result.greens));
      this->Level = result.level;
      this->Steps = std::move(result.steps);
    });
  const SurfaceLevel& level = at(this->Level);
  output->ShallowCopy(level.Surface);
  convert::removeMeshResults(output);
  convert::shareGreensFunctions(computed, output, level.Model.material().youngsModulus());
  this->MarkPatches(level.Surface, level.Model, output);
  convert::setFieldStrings(output, palpate::arrays::ToleranceSteps, this->Steps);
}

palpate::ToleranceResult vtkToleranceGreensFunctions::Search(
  const std::function<palpate::ElasticModel(int)>& level)
{
  palpate::ToleranceLimits limits;
  limits.levels = this->MaximumNumberOfLevels;
  limits.vertices = this->MaximumNumberOfVertices;
  return palpate::computeToTolerance(level, this->ErrorTolerance, limits, this->OptionsFor(0),
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

vtkSmartPointer<vtkPolyData> vtkToleranceGreensFunctions::Refined(vtkPolyData* surface)
{
  vtkNew<vtkSurfaceRefinement> refinement;
  refinement->SetInputData(surface);
  refinement->SetSubdivision(this->Subdivision);
  refinement->SetSmoothAngle(this->GetSmoothAngle());
  refinement->Update();
  if (refinement->GetFailureMessage()[0])
  {
    throw std::runtime_error(refinement->GetFailureMessage());
  }
  return refinement->GetOutput();
}
