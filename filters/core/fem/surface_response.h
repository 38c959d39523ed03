// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstddef>
#include <Eigen/Core>
#include <vector>

#include "fem/solid_system.h"

namespace palpate::fem {

/// What is given at a vertex: three columns, one a component.
struct WantedColumn {
  enum Kind {
    Force,         ///< of a free vertex
    Traction,      ///< on one load hat
    Displacement,  ///< of a fixed vertex
    Load,          ///< on all nodes: the body's weight, which has to be the last
  };
  Kind kind;
  int index;  ///< of the vertex, or of the hat; 0 for the load
};

/// How a solid body answers at the vertices of its surface, in the units of its system.
struct SurfaceResponse {
  /// 3 #V by 3 #wanted: displacements where free, reactions where fixed, per unit of what is given.
  Eigen::MatrixXd columns;
  /// 13 #probes by 3 #wanted: ProbeValues.
  Eigen::MatrixXd probes;
  /// The largest relative error of displacements where the fixed vertices, or the springs of
  /// unsupported bodies, move rigidly: of the solution's rounding.
  double rigidMotionDefect = -1;
  /// 3 #V by 6 #bodies where nothing is fixed, rigidMotionsOfBodies as displacements show them and
  /// as the resultants of forces have them.
  Eigen::MatrixXd displacedMotions, loadedMotions;
  /// 6 #bodies by 3 where nothing is fixed: resultants of the weight, by rigidMotionsOfBodies.
  Eigen::MatrixXd weightResultants;
  std::size_t peakBytes = 0;
};

/// How much of M^-1, the rest being 1 / a, takes forces to tractions and means under the hats to
/// displacements. Equal shares are conjugate.
struct MortarShares {
  double load, displacement;
};

/// @param system  its entries are taken.
/// @throws as SparseFactorization; Aborted.
SurfaceResponse surfaceResponse(SolidSystem system, const ElasticModel& model,
                                const std::vector<WantedColumn>& wanted, const MortarShares& shares,
                                const Progress& progress);

}  // namespace palpate::fem
