// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fem/solid_probes.h"

#include "fem/solid_elements.h"
#include "sentence.h"

namespace palpate::fem {

std::vector<SolidProbe> locateProbes(const SolidBody& body, const Eigen::Matrix3Xd& points) {
  constexpr double rounding = 1e-9;
  std::vector<SolidProbe> probes(points.cols(), {-1, Eigen::Vector4d::Constant(-1)});
  for (int cell = 0; cell < body.mesh().cellCount(); ++cell) {
    const Eigen::Matrix<double, 3, 4> corners =
        body.mesh().points()(Eigen::all, body.mesh().tetrahedra().col(cell));
    const Eigen::Matrix<double, 3, 4> gradients = barycentricGradients(corners);
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      Eigen::Vector4d place = gradients.transpose() * (points.col(i) - corners.col(0));
      place[0] += 1;
      if (place.minCoeff() > -rounding && place.minCoeff() > probes[i].barycentric.minCoeff())
        probes[i] = {cell, place};
    }
  }
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (probes[i].cell < 0)
      refuse("probe ", i, " at (", points(0, i), ", ", points(1, i), ", ", points(2, i),
             ") is not inside the body");
  return probes;
}

}  // namespace palpate::fem
