// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vector>

#include "greens/computed_greens_functions.h"
#include "model/elastic_model.h"
#include "progress.h"
#include "shell/thin_shell.h"

namespace palpate {

struct ShellOptions {
  /// Nodes whose Green's functions are computed; empty for all free nodes.
  std::vector<int> columns;
  /// Take off what rounding leaves of the compliance's asymmetry.
  bool reciprocal = true;
  /// Also estimate the error on a finer mesh (estimateShellError).
  bool estimateError = false;
};

/// Computes the discrete Green's functions of a thin shell (Kirchhoff and Love: lines across it
/// stay straight and normal to its middle) by flat triangles with six degrees of freedom a vertex,
/// shellStiffness. A traction p at a vertex is the force a p there, and rotations bear no torque,
/// so that with the elements' stiffness K a column is
///     u = K^-1 (a p)  where free,     a p = K_h u  where fixed,
/// and by Betti's theorem the force compliance is symmetric, to rounding and without more ado. The
/// sparse K is factored once (SparseFactorization), and each column solved for.
///
/// A shell may have rims, folds, closed and several pieces. Contact is with its middle, from the
/// side of its normals; it bends and stretches, and is not squeezed through its thickness.
/// @param model  of Domain::Shell; its smooth patches play no part.
/// @throws std::invalid_argument for columns out of range; Aborted; std::bad_alloc;
///         std::runtime_error if the system is singular, if rounding leaves rigid motions wrong by
///         a twentieth, or if the library was built without MUMPS.
ComputedGreensFunctions computeShellGreensFunctions(const ElasticModel& model,
                                                    const ThinShell& shell,
                                                    const ShellOptions& options = {},
                                                    const ProgressCallback& progress = {});

/// Those of a shell that nothing holds: of one that is clamped at a single vertex a piece, which
/// bears nothing under loads that balance each other, without its rigid motions
/// (removeRigidMotions).
/// @param model      likewise, nothing of it fixed.
/// @param thickness  3 by #F, as of ThinShell.
/// @throws also for columns, which all are needed, and for an estimate of the error.
ComputedGreensFunctions computeFreeShellGreensFunctions(const ElasticModel& model,
                                                        const Eigen::Matrix3Xd& thickness,
                                                        const ShellOptions& options = {},
                                                        const ProgressCallback& progress = {});

}  // namespace palpate
