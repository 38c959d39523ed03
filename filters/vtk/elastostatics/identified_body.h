// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_identified_body_h
#define palpate_identified_body_h

#include "vtkGreensFunctionIdentification.h"

#include "bem/boundary_element_method.h"
#include "fem/finite_element_method.h"
#include "fem/modulus_response.h"
#include "identification/material_identification.h"
#include "identification/refined_regions.h"
#include "identification/registration_changes.h"
#include "probed_surface.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// The body and how its Green's functions are computed for a material.
struct vtkGreensFunctionIdentification::Body
{
  static constexpr int MostRefined = 50000; // cells of which eight each are made for an estimate
  const vtkGreensFunctionIdentification& Filter;
  palpate::ElasticModel Given;
  vtkSmartPointer<vtkPolyData> Boundary; // in place of the surface, null where that stays
  std::optional<palpate::TetrahedralMesh> Mesh;
  std::vector<int> RegionOfCell;
  int Regions = 1;
  std::vector<int> Columns; // empty for all free nodes
  std::string Warning;      // of the filling

  palpate::ElasticModel ModelOf(const palpate::Material& material) const
  {
    return { this->Given.sharedMesh(), material, this->Given.conditions(), this->Given.smoothPatches() };
  }

  /// By how much the mesh makes parameters too large, by the body of half as long edges; empty
  /// where that was not made.
  Eigen::VectorXd OffByMesh(const palpate::MaterialIdentifier& identifier,
    const palpate::Measurements& measurements, const palpate::MaterialIdentification& found,
    const palpate::Progress& progress) const
  try
  {
    if (this->Mesh->cellCount() > MostRefined)
    {
      return {};
    }
    const palpate::RefinedRegions refined(this->Given, *this->Mesh, this->RegionOfCell);
    const palpate::convert::ProbedSurface probed = palpate::convert::probedSurface(refined.model,
      measurements, this->Filter.PlaceTolerance * this->Given.mesh().diagonal());
    Eigen::VectorXd parameters(found.parameters.size());
    for (std::size_t i = 0; i < found.parameters.size(); ++i)
    {
      parameters[i] = found.parameters[i].value;
    }
    const palpate::ModulusResponse response(refined.model, refined.mesh,
      Eigen::MatrixXd(refined.mesh.cellCount(), 0),
      palpate::nodalForces(probed.setup, measurements, refined.model.mesh().vertexAreas()));
    const Eigen::VectorXd seen = palpate::seenAtMarkers(probed.setup,
      response.at(refined.modulus(found.materials), found.materials.front().poissonRatio(), false, progress)
        .displacements);
    return identifier.parametersOff(found, measurements,
      palpate::continued(seen, identifier.predict(parameters, measurements)));
  }
  catch (const palpate::Aborted&)
  {
    throw;
  }
  catch (const std::runtime_error&)
  {
    return {}; // singular, too large, or without MUMPS
  }

  /// What residuals change by what the registration leaves open.
  Eigen::MatrixXd Changes(const palpate::Measurements& measurements,
    const palpate::Registration& registration, const palpate::MaterialIdentification& found,
    const palpate::Progress& progress) const
  {
    const auto greens = this->Compute(found.materials, false, progress).take();
    return palpate::changesByRegistration(measurements, registration,
      [&](const palpate::Measurements& moved)
      {
        const palpate::convert::ProbedSurface probed = palpate::convert::probedSurface(
          this->Given, moved, this->Filter.PlaceTolerance * this->Given.mesh().diagonal());
        return palpate::MeasuredResponse(*greens, probed.setup, this->Filter.YieldingSupport)
          .residuals(moved, found.foundationLength);
      });
  }

  palpate::ComputedGreensFunctions Compute(const std::vector<palpate::Material>& materials,
    bool estimate, const palpate::Progress& progress) const
  {
    const palpate::ElasticModel model = this->ModelOf(materials.front());
    if (!this->Mesh)
    {
      palpate::BoundaryElementOptions options;
      options.columns = this->Columns;
      options.reciprocal = this->Filter.Reciprocal;
      options.threads = this->Filter.NumberOfThreads;
      options.estimateError = estimate;
      return palpate::computeBoundaryElementGreensFunctions(model, options, progress.callback());
    }
    palpate::FiniteElementOptions options;
    options.columns = this->Columns;
    options.reciprocal = this->Filter.Reciprocal;
    options.estimateError = estimate && this->Regions == 1;
    std::vector<palpate::Elasticity> elasticities;
    for (const palpate::Material& material : materials)
    {
      elasticities.emplace_back(material);
    }
    const bool isEstimatedApart = estimate && this->Regions > 1;
    const palpate::SolidBody body(
      model.mesh(), *this->Mesh, std::move(elasticities), this->RegionOfCell);
    palpate::ComputedGreensFunctions greens = palpate::computeFiniteElementGreensFunctions(
      model, body, options, progress.part(0, isEstimatedApart ? 0.5 : 1).callback());
    if (isEstimatedApart)
    {
      // By the same body of one material: what the mesh does.
      options.estimateError = true;
      greens.info.diagnostics.error =
        palpate::computeFiniteElementGreensFunctions(model,
          palpate::SolidBody(model.mesh(), *this->Mesh, { palpate::Elasticity(materials.front()) }),
          options, progress.part(0.5, 1).callback())
          .info.diagnostics.error;
    }
    return greens;
  }
};

#endif
