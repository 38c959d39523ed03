// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkFiniteElementGreensFunctions.h"

#include "conversion.h"
#include "fem/finite_element_method.h"
#include "filled_surface.h"
#include "held_arrays.h"
#include "inside_arrays.h"
#include "model_arrays.h"
#include "volume_arrays.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <optional>
#include <string>

vtkStandardNewMacro(vtkFiniteElementGreensFunctions);

vtkFiniteElementGreensFunctions::vtkFiniteElementGreensFunctions()
{
  this->SetNumberOfInputPorts(2);
}

void vtkFiniteElementGreensFunctions::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Element: " << this->Element << "\n"
     << indent << "CellSize: " << this->CellSize << "\n"
     << indent << "Unsupported: " << this->Unsupported << "\n"
     << indent << "Probes: " << this->Probes.size() / 3 << "\n"
     << indent << "EstimateError: " << this->EstimateError << "\n";
}

void vtkFiniteElementGreensFunctions::AddProbe(double x, double y, double z)
{
  this->Probes.insert(this->Probes.end(), { x, y, z });
  this->Modified();
}

void vtkFiniteElementGreensFunctions::ClearProbes()
{
  this->Probes.clear();
  this->Modified();
}

int vtkFiniteElementGreensFunctions::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

void vtkFiniteElementGreensFunctions::Compute(
  vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs)
{
  namespace convert = palpate::convert;
  const palpate::Domain domain =
    this->Unsupported ? palpate::Domain::Unsupported : palpate::Domain::Interior;
  const auto modelOf = [&](vtkPolyData* surface)
  { return convert::modelOf(surface, this->SmoothAngle, domain); };
  const palpate::ElasticModel given = modelOf(input);
  palpate::FiniteElementOptions options;
  options.element = static_cast<palpate::SolidElement>(this->Element);
  options.patchColumns = this->PatchColumns;
  options.reciprocal = this->Reciprocal;
  options.estimateError = this->EstimateError;
  options.held = convert::heldDisplacementsOf(input, given.conditions());
  options.probes = Eigen::Map<const Eigen::Matrix3Xd>(
    this->Probes.data(), 3, static_cast<Eigen::Index>(this->Probes.size() / 3));
  const palpate::Progress progress([this](double fraction, const char* stage)
    { return this->ReportProgress(fraction, stage); });
  const auto compute = [&](const palpate::ElasticModel& model, const palpate::SolidBody& body,
                         const std::string& warning, vtkPolyData* arrays)
  {
    palpate::ComputedGreensFunctions result = palpate::computeFiniteElementGreensFunctions(
      model, body, options, progress.part(0.2, 1).callback());
    if (!warning.empty())
    {
      result.info.diagnostics.warnings.push_back(warning);
    }
    const bool isHomogeneous = result.info.homogeneous;
    convert::setGreensFunctions(arrays, model, std::move(result));
    if (!isHomogeneous && options.held.cols() == 0)
    {
      convert::setSurfaceElasticity(arrays, body.materialsBehind(model.mesh()));
    }
  };

  const std::uint64_t ofHeld = palpate::heldFingerprint(options.held, given.fingerprint());
  std::optional<palpate::ElasticModel> ofFilled;
  vtkPolyData* computed = nullptr;
  if (vtkUnstructuredGrid* grid = vtkUnstructuredGrid::GetData(inputs[1]))
  {
    options.columns = this->Columns(input->GetNumberOfPoints());
    palpate::TetrahedralMesh mesh = convert::tetrahedraOf(grid);
    convert::CellMaterials materials = convert::materialsOf(grid, given.material());
    // Where cells have their own, the surface's Young's modulus is but a unit, and none that scales them.
    const double unit = materials.ofCell.empty() ? 0 : given.material().youngsModulus();
    const std::uint64_t parts[] = { ofHeld, convert::gridFingerprint(mesh, materials) };
    const std::uint64_t fingerprint =
      palpate::Fingerprint().add(parts, sizeof parts).add(&unit, sizeof unit).value();
    computed = this->Kept(fingerprint,
      [&](vtkPolyData* arrays)
      {
        const palpate::SolidBody body(given.mesh(), std::move(mesh), std::move(materials.materials),
          std::move(materials.ofCell), std::move(materials.densities));
        this->Filled = nullptr;
        compute(given, body, "", arrays);
      });
  }
  else
  {
    computed = this->Kept(ofHeld,
      [&](vtkPolyData* arrays)
      {
        const convert::FilledSurface filled = convert::fillSurface(
          input, given.sharedMesh(), this->CellSize, progress.part(0, 0.2).callback());
        this->Filled = filled.boundary;
        if (this->Filled)
        {
          ofFilled.emplace(modelOf(this->Filled));
        }
        options.columns = this->Columns(input->GetNumberOfPoints());
        const palpate::ElasticModel& model = ofFilled ? *ofFilled : given;
        compute(model,
          palpate::SolidBody(
            model.mesh(), filled.mesh, { palpate::Elasticity(model.material()) }),
          filled.warning, arrays);
      });
  }
  if (this->Filled)
  {
    if (!ofFilled)
    {
      ofFilled.emplace(modelOf(this->Filled));
    }
    convert::setBoundary(output, input, this->Filled, ofFilled->sharedMesh());
  }
  convert::removeResponses(output);
  convert::shareGreensFunctions(computed, output, given.material().youngsModulus());
  this->MarkPatches(this->Filled ? this->Filled.Get() : input, ofFilled ? *ofFilled : given, output);
}
