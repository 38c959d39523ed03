// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imported/response.h"

#include <Eigen/LU>

#include "imported/definiteness.h"

namespace palpate::imported {

Response responseOfStiffness(Eigen::MatrixXd stiffness, Eigen::Index free, int& row,
                             const Progress& progress) {
  const Eigen::Index fixed = stiffness.rows() - free;
  Response response;
  const Eigen::MatrixXd coupling = stiffness.bottomLeftCorner(fixed, free);
  response.holding = stiffness.bottomRightCorner(fixed, fixed);
  stiffness.conservativeResize(free, free);
  row = invertDefinite(stiffness, progress) - 1;
  if (row >= 0) return {};
  response.compliance = std::move(stiffness);
  response.reactions = coupling * response.compliance;
  response.moved = -response.reactions.transpose();
  response.holding += coupling * response.moved;
  return response;
}

Response responseOfCompliance(Eigen::MatrixXd compliance, Eigen::Index free, bool symmetric,
                              int& row) {
  const Eigen::Index fixed = compliance.rows() - free;
  Response response;
  row = -1;
  if (fixed == 0) {
    response.compliance = std::move(compliance);
    response.moved.resize(free, 0);
    response.reactions.resize(0, free);
    response.holding.resize(0, 0);
    return response;
  }
  response.holding = compliance.bottomRightCorner(fixed, fixed);
  if (symmetric)
    row = invertDefinite(response.holding) - 1;
  else
    response.holding = response.holding.partialPivLu().inverse().eval();
  if (row >= 0) return {};
  response.moved = compliance.topRightCorner(free, fixed) * response.holding;
  response.reactions = -response.holding * compliance.bottomLeftCorner(fixed, free);
  response.compliance = compliance.topLeftCorner(free, free) +
                        compliance.topRightCorner(free, fixed) * response.reactions;
  return response;
}

}  // namespace palpate::imported
