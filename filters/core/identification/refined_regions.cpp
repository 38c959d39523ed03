// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/refined_regions.h"

#include <cmath>
#include <memory>

#include "mesh/subdivision.h"
#include "mesh/tetrahedral_refinement.h"

namespace palpate {
namespace {

constexpr double kSupportedOrder = 1.25;  // as of estimateError

ElasticModel halved(const ElasticModel& coarse) {
  SubdivisionLevel level = subdivide(coarse.mesh(), coarse.smoothPatches(), Subdivision::Flat);
  BoundaryConditions conditions(refineBoundaryTypes(level, coarse.conditions().types()));
  Eigen::VectorXi patches = refineSmoothPatches(level, coarse.smoothPatches());
  return {std::make_shared<SurfaceMesh>(std::move(level.points), std::move(level.triangles)),
          coarse.material(), std::move(conditions), std::move(patches), coarse.domain()};
}

}  // namespace

RefinedRegions::RefinedRegions(const ElasticModel& coarse, const TetrahedralMesh& cells,
                               const std::vector<int>& regions)
    : model(halved(coarse)), mesh(refineTetrahedra(cells)) {
  for (int region : regions) regionOfCell.insert(regionOfCell.end(), 8, region);
}

Eigen::VectorXd RefinedRegions::modulus(const std::vector<Material>& materials) const {
  Eigen::VectorXd modulus(mesh.cellCount());
  for (int cell = 0; cell < mesh.cellCount(); ++cell)
    modulus[cell] = materials[regionOfCell[cell]].youngsModulus();
  return modulus;
}

Eigen::VectorXd continued(const Eigen::VectorXd& seen, const Eigen::Matrix3Xd& predicted) {
  const double gain = std::pow(2, kSupportedOrder);
  return gain / (gain - 1) * (seen - predicted.reshaped());
}

}  // namespace palpate
