// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/tetrahedral_mesh.h"
#include "model/elastic_model.h"

namespace palpate {

/// A body of several regions in tetrahedra of half as long edges: what it is off by tells what its
/// mesh makes of their moduli.
struct RefinedRegions {
  RefinedRegions(const ElasticModel& coarse, const TetrahedralMesh& cells,
                 const std::vector<int>& regionOfCell);

  ElasticModel model;
  TetrahedralMesh mesh;
  std::vector<int> regionOfCell;

  /// #T, Pa.
  Eigen::VectorXd modulus(const std::vector<Material>& materials) const;
};

/// What the body itself would add to displacements that a mesh predicts: the difference from those
/// with half as long edges, continued with the order at which they converge (estimateError).
/// @param seen       with half as long edges, 3 #markers, m.
/// @param predicted  3 by #markers, m.
Eigen::VectorXd continued(const Eigen::VectorXd& seen, const Eigen::Matrix3Xd& predicted);

}  // namespace palpate
