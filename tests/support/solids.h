// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <functional>

#include "fem/finite_element_method.h"
#include "mesh/tetrahedral_mesh.h"
#include "support/problems.h"

namespace palpate::test {

/// Tetrahedra on their way to a TetrahedralMesh.
struct Solid {
  Eigen::Matrix3Xd points;
  Eigen::Matrix4Xi tetrahedra;

  TetrahedralMesh mesh() const { return {points, tetrahedra}; }
  Solid mapped(const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map) const;
};

/// The corner (0,0,0), (1,0,0), (0,1,0), (0,0,1).
Solid cornerTetrahedron();

/// Of edge length sqrt 8 around the origin.
Solid regularTetrahedron();

/// Unit cube of a regular tetrahedron and four corners.
Solid cubeOfFive();

/// Box [0, size] of cubes, each of six tetrahedra around its diagonal (Kuhn 1960): a vertex inside
/// a side has a hat that is symmetric about it.
Solid kuhnBox(const Eigen::Vector3d& size, const Eigen::Vector3i& divisions);

/// The boundary, its vertices the points that lie on it in their order.
Shape boundaryOf(const TetrahedralMesh& mesh);

/// A body of tetrahedra and the reference problem of its boundary.
struct SolidProblem {
  ElasticModel model;
  SolidBody body;

  std::shared_ptr<const GreensFunctions> greens(const FiniteElementOptions& options = {}) const {
    return computeFiniteElementGreensFunctions(model, body, options).take();
  }
};

/// A body of one isotropic material, fixed where `fixed` says.
SolidProblem solidProblem(const TetrahedralMesh& mesh, const Place& fixed, double youngsModulus,
                          double poissonRatio);

/// Options with the columns of all nodes.
FiniteElementOptions allColumns(const ElasticModel& model);

}  // namespace palpate::test
