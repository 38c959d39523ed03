// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "fem/solid_body.h"
#include "model/elastic_model.h"
#include "progress.h"

namespace palpate {

/// What forces do to a solid body whose Young's modulus differs from cell to cell, and how that
/// changes with the modulus: for a change dK of the stiffness by du = -K^-1 dK u. Displacements are
/// those of computeFiniteElementGreensFunctions with quadratic tetrahedra.
class ModulusResponse {
 public:
  /// @param model   its surface is that of the mesh; fixed vertices hold it. Its material is not
  ///                looked at.
  /// @param modes   #T by any: directions of the modulus' logarithm to differentiate along.
  /// @param forces  3 #V by any, N; those on fixed vertices do nothing.
  /// @throws std::invalid_argument for sizes that do not go together, nothing fixed, and as
  ///         SolidBody.
  ModulusResponse(const ElasticModel& model, TetrahedralMesh mesh, Eigen::MatrixXd modes,
                  Eigen::MatrixXd forces);

  const Eigen::MatrixXd& modes() const { return modes_; }
  int loadCount() const { return static_cast<int>(forces_.cols()); }

  struct Answer {
    Eigen::MatrixXd displacements;         ///< 3 #V by #loads, m
    std::vector<Eigen::MatrixXd> byModes;  ///< #loads, 3 #V by #modes, m
  };

  /// @param modulus      #T, Pa.
  /// @param derivatives  whether byModes is wanted, which costs a solution a load and mode.
  /// @throws std::runtime_error if the system is singular, or built without MUMPS; Aborted.
  Answer at(const Eigen::VectorXd& modulus, double poissonRatio, bool derivatives,
            const Progress& progress = {}) const;

  /// The body of these moduli.
  SolidBody body(const Eigen::VectorXd& modulus, double poissonRatio) const;

 private:
  ElasticModel model_;
  TetrahedralMesh mesh_;
  Eigen::MatrixXd modes_, forces_;
};

}  // namespace palpate
