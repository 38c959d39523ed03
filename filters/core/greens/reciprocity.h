// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "greens/greens_functions.h"

namespace palpate {

/// Symmetrises the force compliance S_ij = Xi_ij / a_j between the free nodes that have a column,
/// so that whatever is served comes from one energy (Betti's theorem holds for the exact operator).
///
/// Some sums over the rows are more exact than the rest and lost in a plain mean of S and S^T: the
/// change of volume, which fades as nu approaches 1/2. For each f of `kept` the result S' has f^T
/// S' = f^T S; of all such symmetric matrices it is the one nearest to the mean, in the norm that
/// weights nodes with their areas (the symmetric update of Powell and Broyden). A share below 1
/// goes only that part of the way there.
/// @param matrix        3 #nodes by at least 3 #columnNodes, column-major; changed where
///                      `symmetrise` is set.
/// @param conditions    reference BVP.
/// @param areas         #nodes.
/// @param columnNodes   nodes of the columns.
/// @param kept          forces, 3 by #nodes each, no two at one node; left out where a free node of
///                      theirs has no column.
/// @param keptShare     0..1.
/// @return the defect before, |S - S^T|_F / |S|_F; 0 if there is no free column.
template <class Scalar>
double makeReciprocal(Scalar* matrix, const BoundaryConditions& conditions,
                      const Eigen::VectorXd& areas, const std::vector<int>& columnNodes,
                      bool symmetrise, const std::vector<Eigen::Matrix3Xd>& kept = {},
                      double keptShare = 1);

extern template double makeReciprocal(double*, const BoundaryConditions&, const Eigen::VectorXd&,
                                      const std::vector<int>&, bool,
                                      const std::vector<Eigen::Matrix3Xd>&, double);
extern template double makeReciprocal(float*, const BoundaryConditions&, const Eigen::VectorXd&,
                                      const std::vector<int>&, bool,
                                      const std::vector<Eigen::Matrix3Xd>&, double);

/// For each body the forces of a unit pressure on it: their work is the change of its volume.
std::vector<Eigen::Matrix3Xd> unitPressures(const SurfaceMesh& mesh);

/// Largest rotation of a body's free surface per unit torque spread over it: the work-conjugate
/// rotation under tractions omega x r. It diverges as a support shrinks to a point.
/// @param mesh  in the length unit of the Green's functions.
/// @return rad/(N m), the largest over the bodies all of whose free nodes have a column; -1 if
/// none.
double rockingCompliance(const GreensFunctions& greens, const SurfaceMesh& mesh);

}  // namespace palpate
