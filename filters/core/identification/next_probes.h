// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/material_identification.h"

namespace palpate {

/// What each probe would tell of the unknowns: J^T J of its markers over the noise.
/// @param parameters  where the response is linearised, in the order of what is identified.
/// @param noise       standard deviation of a component, m.
/// @return #probes matrices, #unknowns by #unknowns.
std::vector<Eigen::MatrixXd> informationOfProbes(const MaterialIdentifier& identifier,
                                                 const Eigen::VectorXd& parameters,
                                                 const Measurements& probes, double noise);

/// A candidate that was chosen.
struct ChosenProbe {
  int candidate;
  Eigen::MatrixXd information;  ///< of what was there, the probes chosen before, and this one
};

/// Chooses probes D-optimally, one after the other: each the one with which the determinant of the
/// information is largest, at a place where none was chosen yet; at any again once all are.
/// @param present     information that is there already.
/// @param candidates  at least one.
/// @param places      #candidates: a number for where each is, the same for the same place.
std::vector<ChosenProbe> chooseProbes(const Eigen::MatrixXd& present,
                                      const std::vector<Eigen::MatrixXd>& candidates,
                                      const std::vector<int>& places, int count);

/// Such numbers: the vertices of contacts.
std::vector<int> contactVertices(const Measurements& probes);

/// Probes that could be made: normal and tilted forces at places far from each other, each seen by
/// the markers of the probe that has most.
/// @param places  how many places; five forces at each.
/// @return with displacements of zero.
Measurements candidateProbes(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                             const Measurements& measurements, int places);

}  // namespace palpate
