// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstddef>
#include <Eigen/Core>
#include <vector>

#include "progress.h"
#include "shell/shell_system.h"

namespace palpate::shell {

/// How the vertices of a shell answer, in the units of its system.
struct ShellResponse {
  /// The largest relative error of displacements where all that is held moves rigidly: of the
  /// solution's rounding, which grows as the shell gets thinner.
  double rigidMotionDefect = -1;
  /// 3 #V by 3, displacements where free and reactions where fixed under its own weight, one a
  /// volume along each axis.
  Eigen::MatrixXd ofWeight;
  std::size_t peakBytes = 0;
};

/// Solves for the displacements of free vertices and the reactions of fixed ones, per unit force on
/// a free vertex or unit displacement of a fixed one.
/// @param system  its entries are taken.
/// @param nodes   whose columns are wanted.
/// @param out     3 #V by 3 #nodes.
/// @throws as SparseFactorization; Aborted.
ShellResponse shellResponse(ShellSystem system, const ElasticModel& model,
                            const std::vector<int>& nodes, Eigen::Ref<Eigen::MatrixXd> out,
                            const Progress& progress);

}  // namespace palpate::shell
