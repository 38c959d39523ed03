// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>
#include <vector>

#include "greens/greens_functions.h"
#include "linear_algebra/aligned_buffer.h"
#include "model/elastic_model.h"

namespace palpate {

/// Dense Green's functions as those who make them hand them over: in doubles, or all in floats.
struct ComputedGreensFunctions {
  GreensFunctionsInfo info;
  AlignedBuffer<double> matrix, patchMatrix;  ///< 3 #V by 3 #columns, by 3 #patch columns
  AlignedBuffer<float> floatMatrix, floatPatchMatrix;

  /// As the interface that consumers use, while this lives and stays as it is.
  std::shared_ptr<const GreensFunctions> view() const;
  /// The same for good. Leaves this empty.
  std::shared_ptr<const GreensFunctions> take();
};

/// The nodes whose Green's functions are to be computed, each once and in order ([JP01] section
/// 3.6).
/// @param columns  nodes as asked for; empty for all free nodes.
/// @throws std::invalid_argument naming a node that the model does not have.
std::vector<int> checkedColumns(const ElasticModel& model, const std::vector<int>& columns);

/// Takes columns from a system's own units to those of the model: displacements of free nodes to
/// metres, forces of fixed ones to pascals.
/// @param length, stiffness  units of the system, m and Pa.
/// @param perGiven           #columns / 3: the system's units of what is given per pascal or metre.
/// @param columns            3 #nodes by any.
void scaleToModel(const GreensFunctionsInfo& info, double length, double stiffness,
                  const std::vector<double>& perGiven, Eigen::Ref<Eigen::MatrixXd> columns);

/// That unit for columnNodes: of forces over a free node's area, or displacements of a fixed one.
std::vector<double> perGivenOfNodes(const GreensFunctionsInfo& info, double length,
                                    double stiffness);

/// What Green's functions say of the model that they belong to, with checkedColumns.
/// @throws as checkedColumns.
GreensFunctionsInfo infoOf(const ElasticModel& model, const std::vector<int>& columns);

}  // namespace palpate
