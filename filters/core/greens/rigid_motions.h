// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "mesh/surface_mesh.h"

namespace palpate {

/// The six rigid motions of each body, at its vertices: 3 #V by 6 #bodies, zero at other bodies.
/// Translations, then turns about the mesh's middle by one over its diagonal.
Eigen::MatrixXd rigidMotionsOfBodies(const SurfaceMesh& mesh);

/// The same at points inside: 13 #points by 6 #bodies, ProbeValues.
/// @param points  3 by any; each is of the body whose surface is nearest.
Eigen::MatrixXd rigidMotionsInside(const std::shared_ptr<const SurfaceMesh>& mesh,
                                   const Eigen::Matrix3Xd& points);

/// What of a field is rigid motion, in the mean over the surface: (M^T A M)^-1 M^T A, #motions by
/// 3 #V.
/// @param areas    #V.
/// @param motions  M, 3 #V by #motions.
Eigen::MatrixXd meanRigidMotion(const Eigen::VectorXd& areas, const Eigen::MatrixXd& motions);

/// @throws std::invalid_argument if some columns, or patch columns, are asked for: loads on an
///         unsupported body are balanced at all of its vertices.
void requireAllColumns(const std::vector<int>& columns, bool patchColumns);

/// Makes the Green's functions of bodies that are held anyhow those of bodies that nothing holds:
///     Xi' = P Xi Q,  P = 1 - R (R^T A R)^-1 R^T A,  Q = 1 - T (T^T A T)^-1 T^T A.
/// Each load is balanced by tractions over the whole surface that vary like a rigid motion (Q), and
/// displacements are counted from the body's own mean motion (P), so that with R = T force
/// compliances stay symmetric. Loads that balance each other deform the body as they should and put
/// nothing on whatever held it, if that is held where six numbers determine it; other ones deform
/// it as if its surface had all of its mass.
/// @param matrix     3 #V by 3 #V, column-major, all columns in the nodes' order; changed.
/// @param areas      #V.
/// @param displaced  R, rigidMotionsOfBodies as displacements show them.
/// @param loaded     T, the same as the loads' resultants have it: for nodal forces R.
template <class Scalar>
void removeRigidMotions(Scalar* matrix, const Eigen::VectorXd& areas,
                        const Eigen::MatrixXd& displaced, const Eigen::MatrixXd& loaded);

/// The weight's part of that, and what springs need besides to bear it.
/// @param held        3 #V by 3 #V, as before.
/// @param weight      3 #V by any: what it does to the bodies that are held.
/// @param resultants  6 #bodies by as many, by rigidMotionsOfBodies.
/// @return what it does where it is balanced as any load is, and below it the resultants.
Eigen::MatrixXd balancedWeight(const Eigen::Ref<const Eigen::MatrixXd>& held,
                               const Eigen::MatrixXd& weight, const Eigen::MatrixXd& resultants,
                               const Eigen::VectorXd& areas, const Eigen::MatrixXd& displaced,
                               const Eigen::MatrixXd& loaded);

extern template void removeRigidMotions(double*, const Eigen::VectorXd&, const Eigen::MatrixXd&,
                                        const Eigen::MatrixXd&);
extern template void removeRigidMotions(float*, const Eigen::VectorXd&, const Eigen::MatrixXd&,
                                        const Eigen::MatrixXd&);

}  // namespace palpate
