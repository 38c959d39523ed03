// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/LU>

#include "contact/pressure_mask.h"
#include "contact/surface_stiffness.h"
#include "support/problems.h"

namespace palpate::test {

/// Served compliance under a linear mask around the vertex nearest to the north pole, m/N.
inline Eigen::Matrix3d poleCompliance(const ElasticModel& model, double radius = 0.6) {
  Eigen::Index pole;
  model.mesh().points().row(2).maxCoeff(&pole);
  const PressureMasks masks(model.mesh(), model.conditions(), MaskShape::Linear, radius);
  const VertexMask mask = masks.at(static_cast<int>(pole));
  BoundaryElementOptions options;
  options.columns = mask.nodes;
  return maskedVertexStiffness(*computeGreens(model, options), static_cast<int>(pole), mask)
      .stiffness.inverse();
}

inline double complianceChange(const Eigen::Matrix3d& compliance,
                               const Eigen::Matrix3d& reference) {
  return (compliance - reference).norm() / reference.norm();
}

}  // namespace palpate::test
