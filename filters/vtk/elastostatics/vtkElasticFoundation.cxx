// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkElasticFoundation.h"

#include "array_names.h"
#include "bem/interior_probes.h"
#include "conversion.h"
#include "greens/elastic_foundation.h"
#include "model_arrays.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <stdexcept>
#include <string>
#include <utility>

vtkStandardNewMacro(vtkElasticFoundation);

void vtkElasticFoundation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NormalStiffness: " << this->NormalStiffness << "\n"
     << indent << "ShearStiffness: " << this->ShearStiffness << "\n"
     << indent << "Probes: " << this->Probes.size() / 3 << "\n";
}

void vtkElasticFoundation::AddProbe(double x, double y, double z)
{
  this->Probes.insert(this->Probes.end(), { x, y, z });
  this->Modified();
}

void vtkElasticFoundation::ClearProbes()
{
  this->Probes.clear();
  this->Modified();
}

namespace
{
/// Adds those of the surface's array, if it has one.
void addSprings(vtkPolyData* surface, Eigen::Matrix3Xd& springs)
{
  const char* name = palpate::arrays::SpringStiffness;
  vtkDataArray* array = surface->GetPointData()->GetArray(name);
  if (!array)
  {
    return;
  }
  const int components = array->GetNumberOfComponents();
  if (components != 1 && components != 9)
  {
    throw std::invalid_argument(std::string("the point array '") + name +
      "' must have 1 component or 9, not " + std::to_string(components));
  }
  for (vtkIdType v = 0; v < array->GetNumberOfTuples(); ++v)
  {
    double values[9] = { 0 };
    array->GetTuple(v, values);
    springs.middleCols<3>(3 * v) += components == 9
      ? Eigen::Matrix3d(Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values))
      : Eigen::Matrix3d(values[0] * Eigen::Matrix3d::Identity());
  }
}

/// Rows of these places without the springs; null, for those that the model has, if there are none.
std::shared_ptr<const palpate::ProbeRows> rowsOf(const palpate::GreensFunctions& greens,
  const palpate::ElasticModel& model, const std::vector<double>& places,
  const palpate::ProgressCallback& progress)
{
  if (places.empty())
  {
    return nullptr;
  }
  const Eigen::Map<const Eigen::Matrix3Xd> points(
    places.data(), 3, static_cast<Eigen::Index>(places.size() / 3));
  if (const auto& known = greens.info().probes)
  {
    constexpr double tolerance = 1e-6; // of the diagonal
    return std::make_shared<const palpate::ProbeRows>(
      known->at(points, tolerance * model.mesh().diagonal()));
  }
  return std::make_shared<const palpate::ProbeRows>(
    palpate::probeRows(greens, model, points, progress));
}
} // namespace

void vtkElasticFoundation::Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  namespace convert = palpate::convert;
  const convert::ServedModel served = convert::servedModelOf(input);
  const palpate::GreensFunctionsInfo& info = served.greens->info();
  const palpate::ElasticModel model(
    served.mesh, info.material, info.conditions, served.smoothPatches, info.domain);
  if (this->NormalStiffness > 0 && this->ShearStiffness == 0)
  {
    throw std::invalid_argument("a foundation without shear stiffness lets the body slide away: give "
                                "one above 0, however small");
  }
  Eigen::Matrix3Xd springs = palpate::foundationSprings(*served.mesh,
    this->NormalStiffness == 0 ? std::vector<int>{} : info.conditions.fixedNodes(),
    this->NormalStiffness,
    this->ShearStiffness < 0 ? this->NormalStiffness : this->ShearStiffness);
  if (this->NormalStiffness != 0 && info.conditions.fixedNodes().empty())
  {
    throw std::invalid_argument(
      "a foundation lies under what is fixed, and no vertex of this model is: give its vertices springs");
  }
  addSprings(input, springs);
  const palpate::Progress progress([this](double fraction, const char* stage)
    { return this->ReportProgress(fraction, stage); });
  auto probes = rowsOf(*served.greens, model, this->Probes, progress.part(0, 0.5).callback());
  palpate::FoundedGreensFunctions founded = palpate::onElasticFoundation(
    *served.greens, model, springs, std::move(probes), progress.part(0.5, 1).callback());
  vtkNew<vtkPolyData> arrays;
  convert::setGreensFunctions(arrays, founded.model, std::move(founded.greens));
  convert::removeResponses(output);
  convert::shareGreensFunctions(arrays, output, info.material.youngsModulus());
}
