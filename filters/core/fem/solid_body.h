// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/surface_mesh.h"
#include "mesh/tetrahedral_mesh.h"
#include "model/elasticity.h"

namespace palpate {

/// What fills a surface: tetrahedra whose boundary it is, and their materials.
class SolidBody {
 public:
  /// @param surface         its triangles are those of the mesh's boundary, its vertices points of
  ///                        the mesh (to 1e-9 of the diagonal), in any order.
  /// @param materials       at least one, Pa.
  /// @param materialOfCell  #T numbers of materials; empty where there is one.
  /// @throws std::invalid_argument naming the vertex or triangle that differs, or a cell without a
  ///         material.
  SolidBody(const SurfaceMesh& surface, TetrahedralMesh mesh, std::vector<Elasticity> materials,
            std::vector<int> materialOfCell = {});

  const TetrahedralMesh& mesh() const { return mesh_; }
  int pointOfVertex(int vertex) const { return pointOfVertex_[vertex]; }
  int materialCount() const { return static_cast<int>(materials_.size()); }
  int materialNumber(int cell) const { return materialOfCell_.empty() ? 0 : materialOfCell_[cell]; }
  const Elasticity& material(int cell) const { return materials_[materialNumber(cell)]; }
  /// Whether this isotropic material fills it.
  bool isOf(const Material& material) const;
  /// The largest entry of all stiffnesses, Pa.
  double largestStiffness() const;

 private:
  void requireBoundary(const SurfaceMesh& surface) const;

  TetrahedralMesh mesh_;
  std::vector<Elasticity> materials_;
  std::vector<int> materialOfCell_, pointOfVertex_;
};

}  // namespace palpate
