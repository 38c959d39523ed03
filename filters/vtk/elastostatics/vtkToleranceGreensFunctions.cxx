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
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkToleranceGreensFunctions);

namespace
{
/// A surface of the hierarchy and its model.
struct Level
{
  vtkSmartPointer<vtkPolyData> Surface;
  palpate::ElasticModel Model;
};

double volumeOf(const palpate::SurfaceMesh& mesh)
{
  const std::vector<double> volumes = palpate::findShells(mesh.points(), mesh.triangles()).volume;
  return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}
} // namespace

/// What was chosen, and for what but for Young's modulus, which only scales Green's functions.
struct vtkToleranceGreensFunctions::Chosen
{
  std::uint64_t Fingerprint; // of the surface as given
  vtkMTimeType Time;         // of the filter's settings
  int Level;
  std::vector<std::string> Steps;
  vtkNew<vtkPolyData> Arrays;
};

vtkToleranceGreensFunctions::~vtkToleranceGreensFunctions() = default;

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
  std::vector<Level> levels;
  const auto at = [&](int level) -> const Level&
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
  const std::uint64_t fingerprint = at(0).Model.fingerprint();
  const vtkMTimeType time = this->GetMTime();
  if (!this->Kept || this->Kept->Fingerprint != fingerprint || this->Kept->Time != time)
  {
    this->Kept.reset();
    std::unique_ptr<Chosen> chosen(new Chosen{ fingerprint, time, 0, {}, {} });
    palpate::ToleranceResult result = this->Search([&](int level) { return at(level).Model; });
    chosen->Level = result.level;
    chosen->Steps = std::move(result.steps);
    this->WarnOfVolume(at(0).Model, at(result.level).Model, result.greens.info.diagnostics.warnings);
    convert::setGreensFunctions(chosen->Arrays, at(result.level).Model, std::move(result.greens));
    this->Kept = std::move(chosen);
  }
  const Level& level = at(this->Kept->Level);
  output->ShallowCopy(level.Surface);
  convert::removeMeshResults(output);
  convert::shareGreensFunctions(
    this->Kept->Arrays, output, level.Model.material().youngsModulus());
  this->MarkPatches(level.Surface, level.Model, output);
  convert::setFieldStrings(output, palpate::arrays::ToleranceSteps, this->Kept->Steps);
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
