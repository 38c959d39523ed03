// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "imported/definiteness.h"
#include "imported/given_matrix.h"
#include "imported/node_places.h"

/// What can be told of a matrix that should be an elastic body's. Doubts are added to `warnings`.
namespace palpate::imported {

/// @throws std::invalid_argument if a loose body's stiffness resists translations in this order of
///         its rows, and in the other does not.
void requireOrder(const GivenMatrix& stiffness, const NodePlaces& places, DofOrder order);

/// @throws std::invalid_argument for what is plainly a loose body's stiffness.
void requireNoStiffness(const GivenMatrix& compliance, const NodePlaces& places);

/// @param stiffness    of free points, then of fixed ones, N/m, symmetric.
/// @param free, fixed  3 by any, m.
/// @param pieces       #free, the piece of the surface that each is on, from 0.
/// @throws std::invalid_argument naming a rigid motion of a piece that nothing resists, or if the
/// points are
///         not in the order of the stiffness: translations do no work, but rotations do.
void requireHeld(const Eigen::MatrixXd& stiffness, const Eigen::Matrix3Xd& free,
                 const Eigen::VectorXi& pieces, const Eigen::Matrix3Xd& fixed,
                 std::vector<std::string>& warnings);

/// @param stiffness  likewise, of a surface in one piece.
/// @throws std::invalid_argument if it resists a rigid motion.
void requireLoose(const Eigen::MatrixXd& stiffness, const Eigen::Matrix3Xd& points);

/// @param compliance  m/N, as it will be served.
/// @param defect      its relative asymmetry, which eigenvalues are uncertain by.
/// @return how negative it is, beyond rounding and defect.
Negativity requireCompliance(const Eigen::MatrixXd& compliance, double defect,
                             std::vector<std::string>& warnings, const Progress& progress);

/// Young's modulus of a body whose mean displacement under a force spread over all its points is
/// this one: 1 / (c L) with the compliance c, mean of three directions, and the size L.
/// @throws std::invalid_argument if there is none.
double apparentModulus(const Eigen::MatrixXd& compliance, double size);

/// The same of a loose body, by how far a point of it yields to a force on itself: 1 / (c h) with
/// the mean c and the distance h of points.
double looseModulus(const Eigen::MatrixXd& compliance, double edge);

/// Warns of a modulus that no material has.
void warnOfUnits(double modulus, std::vector<std::string>& warnings);

}  // namespace palpate::imported
