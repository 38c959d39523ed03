// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

#include "greens/greens_functions.h"
#include "mesh/surface_mesh.h"

namespace palpate {

/// How a body answers to its own weight, or to any acceleration that is the same all over it, along
/// each axis: once computed, another direction costs three products a number.
///
/// Methods that know the inside give it with the Green's functions (weightResponse). Else it is
/// found from Green's functions, which answer to loads on the surface alone. With the weight b per
/// volume and c = -(1 - 2 nu) b / E, the field
///     u_p = (c . x) x - |x|^2 c / 2,  stress -(b . x) 1,
/// is in equilibrium with it; what remains is a body without weight that bears the traction
/// (b . x) n where it is free and is displaced by -u_p where it is fixed. What the latter does to a
/// free node j follows by Betti's theorem from the reactions to a force there, so that no fixed
/// node's column is needed:
///     u_j = -1 / a_j  sum over fixed k of a_k Xi_kj^T u_k.
/// Exact but for the discretisation of the surface.
///
/// @param patches  #F, the smooth patches that the Green's functions were made with.
/// @return 3 #nodes by 3: metres per N/m^3 where free; where fixed pascals per N/m^3 if the method
///         gave them, else zero.
/// @throws std::invalid_argument for any but an interior domain, and for a body of several or
///         anisotropic materials, whose method did not give it; for a node whose column is missing,
///         and as solveFaceTractions.
Eigen::MatrixXd weightResponse(const GreensFunctions& greens, const SurfaceMesh& mesh,
                               const Eigen::VectorXi& patches);

/// The same of an unsupported body: its weight balanced as any load is, and below it, 6 #bodies
/// rows, the weight's resultants along rigidMotionsOfBodies, m^3. Springs need both.
/// @return 3 #nodes + 6 #bodies by 3, or nothing where it is not known: of boundary elements with
///         sharp edges.
Eigen::MatrixXd looseWeightResponse(const GreensFunctions& greens, const SurfaceMesh& mesh,
                                    const Eigen::VectorXi& patches);

/// The displacement of a body under its own weight.
/// @param weight  b, density times acceleration, N/m^3 (of several densities in the mean).
/// @return 3 by #nodes, m; zero where fixed.
/// @throws as weightResponse.
Eigen::Matrix3Xd gravityDisplacement(const GreensFunctions& greens, const SurfaceMesh& mesh,
                                     const Eigen::VectorXi& patches, const Eigen::Vector3d& weight);

}  // namespace palpate
