// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>
#include <vector>

#include "greens/computed_greens_functions.h"
#include "imported/given_matrix.h"
#include "imported/node_places.h"
#include "model/elastic_model.h"
#include "progress.h"

namespace palpate {

/// What a matrix gives per what.
enum class MatrixKind {
  Compliance,  ///< displacements per force, of a body that is held: row i is that of node i
  Stiffness,   ///< forces per displacement, of a body that is held or of a loose one
};

struct ImportOptions {
  DofOrder order = DofOrder::ByNode;  ///< of a matrix that does not say what its rows are
  double lengthUnit = 1;              ///< of the matrix and of its nodes, in the surface's (metres)
  double forceUnit = 1;               ///< of the matrix, in newtons
  double nodeTolerance = 1e-5;        ///< a node is at a vertex this near, over the diagonal
  /// Symmetrise a compliance; else it is served as it is, however far from symmetric. A stiffness
  /// always is symmetrised.
  bool reciprocal = true;
  /// Nodes whose Green's functions are wanted; empty for all free nodes that can move.
  std::vector<int> columns;
  /// What Young's modulus the matrix holds for, Pa: scaling it scales the matrix. 0 for the one
  /// that a body of the surface's size and compliance would have.
  double youngsModulus = 0;
  /// A loose body's stiffness stays that of a body that nothing holds: rigid motions are taken out
  /// (removeRigidMotions).
  bool unsupported = false;
};

/// Up to which relative defect |M - M^T| / |M| a matrix is taken for symmetric.
constexpr double kMostAsymmetry = 1e-3;

/// Green's functions, and the model that they are of.
struct ImportedGreensFunctions {
  ElasticModel model;
  ComputedGreensFunctions greens;
};

/// Green's functions from a matrix that somebody else computed or measured. With forces f and
/// displacements u of the free nodes F and the fixed ones X,
///     stiffness:   C = K_FF^-1,                        f_X = K_XF u_F + K_XX u_X,
///     compliance:  C = C_FF - C_FX C_XX^-1 C_XF,       f_X = C_XX^-1 (u_X - C_XF f_F),
/// and tractions p = f / a. Nodes beside the surface, inner coordinates and rotations bear no
/// force: of a stiffness they are condensed out, of a compliance left out.
///
/// Vertices that the model fixes but the matrix does not have are held where it is from: they do
/// not move, but how much force they bear is not known, so they are free nodes without a Green's
/// function, on which no force can act. So are those that a compliance does not move at all.
///
/// Checked are shape, symmetry, definiteness (the least eigenvalue of the compliance against
/// rounding; rigid motions that nothing resists), and whether the compliance is one of a body of
/// this size in these units.
/// @param model  domain Given. Its material is not read.
/// @param nodes  places of the nodes, in the matrix' unit; if empty those that the matrix has, and
///               if it has none either its nodes are the vertices in their order, or the free ones.
/// @throws std::invalid_argument in a sentence that says what is wrong; Aborted; std::bad_alloc.
ImportedGreensFunctions importGreensFunctions(const ElasticModel& model, MatrixKind kind,
                                              const GivenMatrix& matrix, const NodeTable& nodes,
                                              const ImportOptions& options = {},
                                              const ProgressCallback& progress = {});

}  // namespace palpate
