// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

#include "greens/computed_greens_functions.h"
#include "model/elastic_model.h"
#include "progress.h"

namespace palpate {

/// Springs of vertices that a foundation of this stiffness holds (E. Winkler 1867): area times
/// stiffness, along the normal and across it, of the triangles all of whose corners it holds; where
/// there is none at a vertex, of all.
/// @param vertices       which it holds.
/// @param normal, shear  Pa/m.
/// @return 3 by 3 #V, a block a vertex, N/m; zero for others.
/// @throws std::invalid_argument for a stiffness that is negative or not finite.
Eigen::Matrix3Xd foundationSprings(const SurfaceMesh& mesh, const std::vector<int>& vertices,
                                   double normal, double shear);

/// Green's functions, and the model that they are of.
struct FoundedGreensFunctions {
  ElasticModel model;
  ComputedGreensFunctions greens;
};

/// A body that springs hold, from its Green's functions without them. With a spring S at fixed
/// vertices X these are no longer fixed: their reactions are -S u_X, so that
///     (A_X Xi_XX + S) u_X = f_X - A_X v_X,      v' = v + Xi_.X u_X
/// for any answer v of the fixed body. At free vertices s springs take part of the force,
///     (1 + Xi_ss A_s^-1 S) u_s = v_s,           v' = v - Xi_.s A_s^-1 S u_s.
/// An unsupported body moves rigidly besides, R alpha, until R^T S u is the resultant of the load.
/// Exact for the Green's functions given; costs a factorisation and a product of their size.
///
/// The result is of domain Given: springs are part of what it is of. Another Young's modulus scales
/// them, too. What the body's weight does goes with it where it was known, and its probes.
/// @param model    its domain, and surface, conditions and patches that the Green's functions are
/// of.
/// Where a homogeneous body's surface tells its weight, that of an unsupported one is found, too.
/// @param springs  3 by 3 #V, symmetric blocks, N/m: positive definite at vertices that are
///                 released, zero at fixed ones that stay fixed, positive semidefinite at free
///                 ones.
/// @param probes   of the body without the springs; null for those that its Green's functions have.
/// @throws std::invalid_argument for springs that are none, no springs at all, a missing column of
///         a free vertex or a released one, and where a motion remains that nothing resists;
///         Aborted; std::bad_alloc.
FoundedGreensFunctions onElasticFoundation(const GreensFunctions& greens, const ElasticModel& model,
                                           const Eigen::Matrix3Xd& springs,
                                           std::shared_ptr<const ProbeRows> probes = nullptr,
                                           const ProgressCallback& progress = {});

}  // namespace palpate
