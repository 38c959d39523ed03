// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>

#include "greens/greens_functions.h"
#include "halfspace/hat_integrals.h"
#include "mesh/surface_mesh.h"
#include "model/plane.h"
#include "progress.h"

namespace palpate {

struct HalfSpaceOptions {
  bool reciprocal = true;    ///< serve the symmetrised force compliance
  std::vector<int> columns;  ///< nodes that may be loaded; empty for all
};

/// Green's functions of the elastic half-space below a flat surface, computed when they are asked
/// for: no matrix is stored. Tractions are linear on the triangles and zero beyond them,
/// displacements are those at the vertices. A force f at y moves the surface at x = y + d by
/// (Boussinesq and Cerruti; K. L. Johnson, "Contact mechanics", 1985, sections 3.2 and 3.6)
///     u = (1 + nu) / (2 pi E r) [2 (1 - nu) f + 2 nu d (d . f) / r^2
///                                + (1 - 2 nu) (d (n . f) - n (d . f)) / r],
/// with the outward normal n and r = |d|, and HatIntegrals has the integrals over the hats.
///
/// A block of one row and one column takes 0.1 us far from a hat and 0.4 us near it (AVX-512, 2
/// GHz; without it three times that), and twice as much where the compliance is made reciprocal.
class HalfSpaceGreensFunctions final : public GreensFunctions {
 public:
  /// @param info  domain HalfSpace, no patch columns. `reciprocal` says what is served: the force
  ///              compliance Xi_ij / a_j symmetrised, or as collocation at the vertices gives it.
  ///              The mean is the harmonic one of both directions' integrals of 1/r, which stays
  ///              positive definite where hats of 1 : 16 meet, the arithmetic one up to 1 : 8.
  /// @param mesh  the surface that it is about.
  /// @throws std::invalid_argument for info of anything else, and as planeOf.
  HalfSpaceGreensFunctions(GreensFunctionsInfo info, const SurfaceMesh& mesh);

  void gather(NodeList rows, NodeList columns, double* out) const override;
  void accumulate(NodeList columns, Values weights, Eigen::Ref<Eigen::VectorXd> out) const override;
  void accumulate(NodeList columns, Values weights, NodeList rows,
                  Eigen::Ref<Eigen::VectorXd> out) const override;
  void accumulatePatches(NodeList, Values, Eigen::Ref<Eigen::VectorXd>) const override {}
  double epsilon() const override;
  std::shared_ptr<const GreensFunctions> withYoungsModulus(double youngsModulus) const override;

  /// Bytes of what the blocks are computed from.
  std::size_t bytes() const { return surface_->hats.bytes(); }

  friend std::shared_ptr<const HalfSpaceGreensFunctions> computeHalfSpaceGreensFunctions(
      const ElasticModel&, const HalfSpaceOptions&, const ProgressCallback&);

 private:
  struct Surface {
    Plane plane;
    HatIntegrals hats;
  };
  HalfSpaceGreensFunctions(GreensFunctionsInfo info, std::shared_ptr<const Surface> surface);
  HatMoments moments(int row, int column) const noexcept;
  Eigen::Matrix3d block(int row, int column) const noexcept;

  std::shared_ptr<const Surface> surface_;
  double straight_, along_, coupled_;  ///< what 1/r, d d^T / r^3 and d / r^2 are multiplied with
};

/// The Green's functions of a model, with the reciprocity defect of the raw ones measured on at
/// most two hundred thousand pairs of nodes, and a warning where two neighbours' compliance is not
/// positive definite.
/// @throws std::invalid_argument for a model of another domain or columns that are no nodes,
///         Aborted if the progress callback asks for it.
std::shared_ptr<const HalfSpaceGreensFunctions> computeHalfSpaceGreensFunctions(
    const ElasticModel& model, const HalfSpaceOptions& options = {},
    const ProgressCallback& progress = {});

}  // namespace palpate
