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
  /// @param densities       #T, kg/m^3; empty where they are not known, and are all the same.
  /// @throws std::invalid_argument naming the vertex or triangle that differs, or a cell without a
  ///         material or with a density that is not positive.
  SolidBody(const SurfaceMesh& surface, TetrahedralMesh mesh, std::vector<Elasticity> materials,
            std::vector<int> materialOfCell = {}, Eigen::VectorXd densities = {});

  const TetrahedralMesh& mesh() const { return mesh_; }
  int pointOfVertex(int vertex) const { return pointOfVertex_[vertex]; }
  int materialCount() const { return static_cast<int>(materials_.size()); }
  int materialNumber(int cell) const { return materialOfCell_.empty() ? 0 : materialOfCell_[cell]; }
  const Elasticity& material(int cell) const { return materials_[materialNumber(cell)]; }
  /// Of the cells behind a surface's triangles.
  /// @param surface  that of the constructor.
  std::vector<Elasticity> materialsBehind(const SurfaceMesh& surface) const;
  /// Whether this isotropic material fills it.
  bool isOf(const Material& material) const;
  /// In the mean over its volume, kg/m^3; 0 where it is not known.
  double density() const { return density_; }
  /// A cell's density over the mean one.
  double relativeDensity(int cell) const { return density_ > 0 ? densities_[cell] / density_ : 1; }
  /// The largest entry of all stiffnesses, Pa.
  double largestStiffness() const;

 private:
  void requireBoundary(const SurfaceMesh& surface) const;
  void weigh();

  TetrahedralMesh mesh_;
  std::vector<Elasticity> materials_;
  std::vector<int> materialOfCell_, pointOfVertex_;
  Eigen::VectorXd densities_;
  double density_ = 0;
};

}  // namespace palpate
