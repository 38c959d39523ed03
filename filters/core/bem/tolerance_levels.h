// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <map>
#include <optional>
#include <utility>

#include "bem/tolerance_search.h"
#include "greens/error_estimate.h"
#include "greens/load_differences.h"

namespace palpate {

constexpr double kEdgeGrowth = 2;   ///< edges of a level over those of the next
constexpr double kLevelGrowth = 4;  ///< vertices of the next over those of a level

/// A mesh of a hierarchy: how often refined, then how many layers along the rim of its support.
/// The level -1 is that of a coarsened mesh (coarsenedModel).
struct MeshSetting {
  int level = 0, layers = 0;

  bool operator<(const MeshSetting& other) const {
    return std::pair(level, layers) < std::pair(other.level, other.layers);
  }
};

/// Meshes of a hierarchy, each solved once, and what they tell of each other's errors. These have
/// two parts: that of the rim of the support, where stresses are singular, goes with the width of
/// the triangles there, which a level halves and a layer cuts fourfold; the rest goes with the
/// square of the edges, which a level halves.
class ToleranceLevels {
 public:
  /// @param options  of all; double precision takes the place of single where a system asks for it.
  ToleranceLevels(const MeshHierarchy& hierarchy, int mostVertices, BoundaryElementOptions options);

  /// A mesh of the hierarchy, solved.
  struct Solved {
    ElasticModel model;
    ComputedGreensFunctions result;

    int vertices() const { return model.mesh().vertexCount(); }
  };

  bool isAllowed(MeshSetting setting) const {
    return model(setting).mesh().vertexCount() <= mostVertices_;
  }
  /// Whether the level 0, which is solved, can be coarsened; the level -1 is only to be asked for
  /// if so.
  bool hasCoarsened();
  /// Solves it if it is not yet.
  /// @throws std::runtime_error if the mesh has more vertices than allowed; as
  ///         computeBoundaryElementGreensFunctions.
  const Solved& solve(MeshSetting setting, const Progress& progress);
  const Solved& at(MeshSetting setting) const { return solved_.at(setting); }
  bool isSolved(MeshSetting setting) const { return solved_.count(setting) > 0; }
  /// Solves what estimateByParts goes by, and the mesh.
  const Solved& solveWithCoarser(MeshSetting setting, const Progress& progress);
  ComputedGreensFunctions take(MeshSetting setting) {
    return std::move(solved_.at(setting).result);
  }
  const BoundaryElementOptions& options() const { return options_; }

  /// How the answers of two that are solved differ at the vertices of the coarser level before it
  /// got layers.
  LoadDifferences differences(MeshSetting finer, MeshSetting coarser,
                              const SpreadLoads& loads) const;

  /// Edges of the level before over a level's.
  double edgeRatio(int level) const;

  /// A level's loads, from the level without layers.
  SpreadLoads loads(int level) const { return errorLoads(at({level, 0}).model); }

  /// The rim's part of the error of a level without layers, by that level with some.
  LoadDifferences rimErrors(MeshSetting layered, const SpreadLoads& loads) const;

  /// The error of a level, by the level before with as many layers, with none and with some.
  ErrorEstimate estimateByParts(MeshSetting setting) const;

 private:
  ElasticModel model(MeshSetting setting) const;
  /// The numbers that vertices of a level without layers have in a mesh of the same or a finer one.
  std::vector<int> verticesOf(int level, MeshSetting finer) const;
  /// What is left of the difference between levels without the rim's part.
  LoadDifferences restOfDifference(MeshSetting setting, const SpreadLoads& loads) const;

  const MeshHierarchy& hierarchy_;
  int mostVertices_;
  BoundaryElementOptions options_;
  std::map<MeshSetting, Solved> solved_;
  std::optional<OtherMesh> coarsened_;
  bool isCoarsened_ = false;  ///< whether that was tried
};

/// What 95 % of loads do not exceed in displacements and compliances.
double mostOf(const LoadDifferences& differences);

}  // namespace palpate
