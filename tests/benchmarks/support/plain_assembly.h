// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "bem/collocation_scheme.h"
#include "bem/exchanged_system.h"
#include "bem/triangle_quadrature.h"

namespace palpate::bench {

/// The assembly as one would write it down with Eigen: the same collocation points, quadrature
/// rules and tolerance, a loop over points, triangles and quadrature points. It leaves out what
/// would only slow it down: triangles so near that they are integrated in closed form, the diagonal
/// and the identities. So what it is compared with does more work, not less.
class PlainAssembly {
 public:
  /// Keeps references.
  PlainAssembly(const bem::BodySurface& body, const bem::CollocationScheme& scheme,
                double tolerance);

  using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic>;
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// Three rows of H and G at a collocation point, 3 by 3 #v and 3 by 3 #traction nodes.
  void integrate(const Eigen::Vector3d& x, Rows& h, Rows& g) const;

  /// The system with its columns exchanged. @return a number that depends on all of it.
  double assemble(const bem::SystemColumns& wanted) const;

  /// Three rows of H and G of an equation.
  void equation(int e, Rows& h, Rows& g) const;

 private:
  const bem::BodySurface& body_;
  const bem::CollocationScheme& scheme_;
  bem::TriangleRule seven_, three_;
  double nearDistance_, farDistance_;
  Eigen::VectorXd radius_;  // #f
  Eigen::Matrix3Xd centroid_;
  std::vector<Eigen::Matrix3Xd> sevenPoints_, threePoints_;  // #f
};

}  // namespace palpate::bench
