// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/SparseCore>
#include <utility>
#include <vector>

#include "fem/solid_elements.h"
#include "fem/solid_probes.h"
#include "linear_algebra/sparse_factorization.h"
#include "model/elastic_model.h"
#include "progress.h"

namespace palpate::fem {

/// A traction that varies like the hat of a free vertex, on all its triangles or on those of one
/// smooth patch.
struct LoadHat {
  int vertex;
  int patch;  ///< -1 for all its patches
};

/// The equations of a solid body without its surface eliminated, in lengths of the body and its
/// largest stiffness. Unknowns are the displacements u of the nodes that are not held and, in
/// nearly incompressible cells, the pressures q (Taylor and Hood 1973: quadratic displacements,
/// pressures linear and continuous within a material); kept, and last, are the tractions t on the
/// load hats and the displacements w of fixed vertices. A held middle of an edge moves as the mean
/// of its ends. Single components that are held are left out, and hats along them are empty rows.
///     [ K    .       -       - ] [ u ]                       K u = L t - K_w w
///     [ D   -M/lambda        - ] [ q ]      with
///     [ L^T  .       0       - ] [-t ]      mean displacements m = L^T u + L_w^T w, m^2 m
///     [ K_w  D_w    L_w   K_ww ] [ w ]      reactions        f = K_w^T u + K_ww w - L_w t
/// so that the Schur complement of what is kept maps (-t, w) to (m, f).
///
/// Kept after these are factors of loads on all nodes, whose columns tell what they do: of the
/// body's weight along the three axes. Unsupported bodies are held
/// by six springs each, no more than determine where a rigid body is, so that loads that balance
/// each other put no force on them; before the weight, the loads are those that displace the bodies
/// rigidly.
struct SolidSystem {
  /// @param hats  of free vertices.
  /// @param held  3 by #V, or empty for none.
  SolidSystem(const ElasticModel& model, const SolidBody& body, SolidElement element,
              std::vector<LoadHat> hats, HeldDisplacements held,
              const std::vector<SolidProbe>& probes, const Progress& progress);

  int keptCount() const { return probeRow() + 13 * probeCount; }
  /// The kept row of the first probe: minus its ProbeValues, in the system's units.
  int probeRow() const { return loadRow() + loadCount; }
  /// The kept row of the weight along the first axis.
  int weightRow() const { return probeRow() - 3; }
  int rigidLoadCount() const { return loadCount - 3; }
  /// The kept row of the first load.
  int loadRow() const { return 3 * static_cast<int>(hats.size() + fixedVertices.size()); }
  int unknownCount() const { return entries.size - keptCount(); }
  bool isHeldAlong(int axis, int vertex) const { return held.cols() > 0 && held(axis, vertex); }

  double length, stiffness;        ///< units, m and Pa
  std::vector<LoadHat> hats;       ///< kept first, three numbers each
  std::vector<int> fixedVertices;  ///< then these, ascending, likewise
  HeldDisplacements held;          ///< of free vertices
  int pressureCount = 0;
  int loadCount = 0, probeCount = 0;
  SymmetricEntries entries;  ///< unknowns, then what is kept
  /// #V by #V: integrals of the products of two vertices' hats, in squared lengths of the body.
  Eigen::SparseMatrix<double> hatProducts;

  /// Where a component of a node's displacement stands: nowhere where it is held, at one place, or
  /// in parts at two.
  struct NodePlace {
    int place[2] = {-1, -1};
    double weight = 1;
    int count() const { return place[0] < 0 ? 0 : place[1] < 0 ? 1 : 2; }
  };
  const NodePlace& placeOf(int node, int axis) const { return places_[3 * node + axis]; }
  /// Of the pressure at a corner of a nearly incompressible cell.
  int pressurePlace(const SolidBody& body, int cell, int corner) const;

 private:
  void placeNodes(const ElasticModel& model, const SolidBody& body, const SolidNodes& nodes);
  void placePressures(const SolidBody& body);
  void addCells(const SolidBody& body, const SolidNodes& nodes, SolidElement element,
                const Progress& progress);
  void addWeight(const SolidBody& body, const SolidNodes& nodes, SolidElement element);
  void addProbes(const SolidBody& body, const SolidNodes& nodes, SolidElement element,
                 const std::vector<SolidProbe>& probes);
  void addSprings(const SurfaceMesh& mesh, const SolidBody& body);
  void addHats(const ElasticModel& model, const SolidBody& body, const SolidNodes& nodes);

  std::vector<NodePlace> places_;               // three a node
  std::vector<std::pair<int, int>> pressures_;  // (point, group), ascending
  int firstPressure_ = 0, firstHat_ = 0;
};

/// A symmetric matrix in parts.
struct SplitEntries {
  /// @param first  how many of the places are unknowns, not kept.
  SplitEntries(const SymmetricEntries& all, int first);

  SymmetricEntries own;                  ///< of the unknowns
  Eigen::SparseMatrix<double> coupling;  ///< #kept by #unknowns
  Eigen::SparseMatrix<double> corner;    ///< of what is kept, lower triangle
};

/// Pressures count as one negative pivot each; a body that is held has no other.
/// @throws std::runtime_error if it is not held.
void requireHeld(const SparseFactorization& factored, int pressureCount);

}  // namespace palpate::fem
