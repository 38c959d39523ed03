// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>
#include <vector>

#include "identification/observed_response.h"

namespace palpate {

struct RecoveryOptions {
  double friction = 0.5;        ///< largest tangential over normal force; 0 for normal ones alone
  double radius = -1;           ///< of the patches that forces are spread over, m; -1: as data tell
  bool yieldingSupport = true;  ///< where data tell, the support gives way more or less
  int samples = 50;             ///< of noise, from which the deviations are found; 0 for none
  unsigned seed = 1;            ///< of these
};

/// What bears on one piece of the surface.
struct RecoveredContact {
  std::vector<int> nodes;                                    ///< that bear, ascending
  Eigen::Vector3d force = Eigen::Vector3d::Zero();           ///< on the body, N
  Eigen::Vector3d forceDeviation = Eigen::Vector3d::Zero();  ///< standard, by noise and radius
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of pressure, on the surface at rest, m
  double centreDeviation = 0;                        ///< of its place, standard, by noise, m
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< about the centre, N m
  int peak = -1;                                     ///< the node of the largest pressure
  double pressure = 0;                               ///< there, Pa
  double area = 0;                                   ///< of the nodes, m^2
};

struct ContactRecovery {
  Eigen::Matrix3Xd traction;          ///< 3 by #nodes, Pa; zero where fixed
  Eigen::VectorXd pressure;           ///< #nodes: the traction's part into the body, Pa
  Eigen::VectorXd pressureDeviation;  ///< #nodes, standard, by noise
  Eigen::Matrix3Xd displacement;      ///< 3 by #nodes, m, that it causes; with a yielding support
  std::vector<RecoveredContact> contacts;                    ///< the strongest first
  Eigen::Vector3d force = Eigen::Vector3d::Zero();           ///< all together, N
  Eigen::Vector3d forceDeviation = Eigen::Vector3d::Zero();  ///< standard, by noise
  Eigen::Matrix3Xd residuals;  ///< observed less explained, m; NaN where not seen
  double noise = 0;            ///< standard deviation of a residual's component, m
  double misfit = -1;          ///< residuals over the deviations given; -1: not given
  double radius = 0;           ///< of the patches, m; 0: single nodes
  SupportYield yield;          ///< zero where the support is as modelled
  double yieldShare = 0;       ///< of its rigid motion in the displacements observed
  std::vector<std::string> warnings;
};

/// Recovers contacts from the displacements that they cause: u = Xi p at the points, for nodal
/// forces in the cones of contact (compressive, within friction).
///
/// The problem is ill-posed: displacements are smoother than tractions. What makes it tell forces
/// and places is that contacts push and are compact and few. Forces are therefore spread over
/// patches of one radius about a few sites (ContactSearch); the radius that explains most with
/// the fewest numbers is taken. Patches of unit force do not shrink what they regularise.
/// Deviations are of noise, by recovering again, and of the radius, by what others tell as far as
/// Schwarz's criterion makes them probable (Kass and Raftery, Bayes factors, 1995).
/// @param patches  #F, smooth patches as the model's: contacts do not reach across their borders,
///                 and push along each one's normal.
/// @throws std::invalid_argument for displacements that tell no contact: too few, all at one place,
///         none that move, larger than the body, not finite; no free node with a column; options
///         out of range; Aborted.
ContactRecovery recoverContacts(const GreensFunctions& greens, const SurfaceMesh& mesh,
                                const Eigen::VectorXi& patches,
                                const ObservedDisplacements& observed,
                                const RecoveryOptions& options = {}, const Progress& progress = {});

}  // namespace palpate
