// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "linear_algebra/sparse_factorization.h"
#include "model/elastic_model.h"
#include "shell/thin_shell.h"

namespace palpate::shell {

/// The equations of a shell's degrees of freedom, six a vertex, in lengths of its diagonal and
/// Young's modulus: forces are in E L^2, torques in E L^3.
///     [ K    K_h^T ] [ u ]   [ f ]      u: what is not held
///     [ K_h  K_hh  ] [ h ] = [ r ]      h: what is held, r its reaction
struct ShellSystem {
  ShellSystem(const ElasticModel& model, const ThinShell& shell);

  int freeCount() const { return entries.size; }
  int heldCount() const { return static_cast<int>(heldFree.rows()); }

  double length;  ///< unit, m
  /// 6 by #V: the place of a component among the free, or -1 - that among the held.
  Eigen::Matrix<int, 6, Eigen::Dynamic> place;
  SymmetricEntries entries;              ///< K
  Eigen::SparseMatrix<double> heldFree;  ///< K_h
  Eigen::SparseMatrix<double> heldHeld;  ///< K_hh
  Eigen::VectorXd volumes;               ///< #V, what of the shell's volume is a vertex', L^3
};

}  // namespace palpate::shell
