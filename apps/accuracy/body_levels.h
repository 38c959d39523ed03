// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "accuracy/settings.h"
#include "fem/solid_body.h"
#include "mesh/subdivision.h"
#include "model/elastic_model.h"
#include "shell/thin_shell.h"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace palpate::app {

/// A body on a surface, or of tetrahedra, and its refinements. Level 1 is what is given.
class BodyLevels {
 public:
  /// @param surface  with boundary types, material and, if given, smooth patches, of a shell its
  ///                 thickness and held components.
  /// @param volume   tetrahedra whose boundary the surface is, with their materials; or null.
  /// @param levels   how many.
  /// @throws std::invalid_argument with a sentence for a surface that cannot be used.
  BodyLevels(vtkPolyData* surface, vtkUnstructuredGrid* volume, int levels,
             const AccuracyOptions& options);

  int count() const { return static_cast<int>(levels_.size()); }
  const SurfaceMesh& mesh(int level) const { return *at(level).mesh; }
  const std::shared_ptr<const SurfaceMesh>& sharedMesh(int level) const { return at(level).mesh; }
  const BoundaryConditions& conditions(int level) const { return at(level).conditions; }
  const Material& material() const { return material_; }
  /// Whether traction may jump somewhere.
  bool hasSharpEdges(int level) const;
  ElasticModel model(int level, TractionJumps jumps) const;
  /// What makes a level's model one of a shell.
  ThinShell shell(int level, const ElasticModel& model) const;
  /// Whether it is one of solids, and not a shell or a half-space.
  bool isSolid() const { return domain_ == Domain::Interior; }
  /// Whether tetrahedra were given.
  bool isFilled() const { return !materials_.empty(); }
  /// What fills a level's surface, where they were.
  SolidBody filling(int level) const;
  /// Of a material that linear tetrahedra lock in.
  bool isNearlyIncompressible() const;

  /// The points of all levels that a point of the finest descends from, the first of level 1.
  std::vector<SurfacePoint> ancestors(const SurfacePoint& finest) const;

 private:
  struct Level {
    std::shared_ptr<const SurfaceMesh> mesh;
    BoundaryConditions conditions;
    Eigen::VectorXi patches;
    SubdivisionLevel made;            ///< of the level before, without points
    Eigen::Matrix3Xd thickness = {};  ///< of shells, and what is held of them
    HeldComponents held = {};
    std::shared_ptr<const TetrahedralMesh> tetrahedra = {};  ///< where they were given
  };
  void fill(vtkUnstructuredGrid* volume);
  Eigen::VectorXi patches(const Level& level, TractionJumps jumps) const;
  const Level& at(int level) const { return levels_.at(level - 1); }

  Domain domain_;
  Material material_{1, 0};
  std::vector<Level> levels_;
  std::vector<Elasticity> materials_;  ///< of tetrahedra, and which of them those of level 1 have
  std::vector<int> materialOfCell_;
};

}  // namespace palpate::app
