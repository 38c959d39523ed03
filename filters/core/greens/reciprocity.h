// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "greens/greens_functions.h"

namespace palpate {

/// Symmetrises the force compliance S_ij = Xi_ij / a_j between the free nodes that have a column,
/// so that whatever is served comes from one energy (Betti's theorem holds for the exact operator).
/// @param matrix        3 #nodes by at least 3 #columnNodes, column-major; changed where
///                      `symmetrise` is set.
/// @param conditions    reference BVP.
/// @param areas         #nodes.
/// @param columnNodes   nodes of the columns.
/// @return the defect before, |S - S^T|_F / |S|_F; 0 if there is no free column.
template <class Scalar>
double makeReciprocal(Scalar* matrix, const BoundaryConditions& conditions,
                      const Eigen::VectorXd& areas, const std::vector<int>& columnNodes,
                      bool symmetrise);

extern template double makeReciprocal(double*, const BoundaryConditions&, const Eigen::VectorXd&,
                                      const std::vector<int>&, bool);
extern template double makeReciprocal(float*, const BoundaryConditions&, const Eigen::VectorXd&,
                                      const std::vector<int>&, bool);

/// Largest rotation of a body's free surface per unit torque spread over it: the work-conjugate
/// rotation under tractions omega x r. It diverges as a support shrinks to a point.
/// @param mesh  in the length unit of the Green's functions.
/// @return rad/(N m), the largest over the bodies all of whose free nodes have a column; -1 if
/// none.
double rockingCompliance(const GreensFunctions& greens, const SurfaceMesh& mesh);

}  // namespace palpate
