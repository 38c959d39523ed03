// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "contact/capacitance_matrix.h"
#include "support/synthetic_greens.h"

namespace palpate::test {

// The rounding of a well-conditioned inverse (below 10) of about forty rows.
constexpr double kRounding = 1e-13;

/// Twenty nodes, three of them fixed.
inline SyntheticBody someBody(bool reciprocal = false) {
  SyntheticBody body;
  body.nodes = 20;
  body.fixed = {3, 4, 11};
  body.reciprocal = reciprocal;
  return body;
}

/// That C is -E^T Xi E of its switches and that its inverse is the inverse.
inline void expectConsistent(const CapacitanceMatrix& c, const Eigen::MatrixXd& xi) {
  const Eigen::MatrixXd e = selection(c.switches(), c.greens().nodeCount());
  const Eigen::MatrixXd expected = -e.transpose() * xi * e;
  EXPECT_LE((c.matrix() - expected).norm(), kRounding * expected.norm());
  EXPECT_LE((c.inverse() - expected.inverse()).norm(), kRounding * expected.inverse().norm());
}

}  // namespace palpate::test
