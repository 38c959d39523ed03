// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <algorithm>
#include <cmath>

#include "support/shapes.h"

namespace palpate::test {

constexpr double kMaskRadius = 0.3, kClampHeight = -0.8;

/// The support of the clamped sphere.
inline bool clamped(const Eigen::Vector3d& x) {
  return x.z() < kClampHeight + 1e-9;
}

/// Compliance at the pole of a clamped sphere, from hp finite elements, error <= 1e-5, of the
/// exactly normalised linear mask; E = 1, radius 1.
struct ClampedSphereReference {
  double poissonRatio, normal, tangential;
};
constexpr ClampedSphereReference kClampedSphereReferences[] = {{0.3, 3.137999, 15.631981},
                                                               {0.0, 3.519960, 15.122070}};

/// Edges fine under the mask, finer still at the edge of the support, where the traction is
/// singular, and coarse between; a ring of vertices on the mask's rim and one on the clamp line.
inline Shape gradedMesh(double underMask, double atClamp) {
  const double rim = 2 * std::asin(kMaskRadius / 2), clamp = std::acos(kClampHeight);
  return ringedSphere(
      [=](double angle) {
        return std::min({0.3, underMask + 0.4 * std::max(0.0, angle - rim),
                         atClamp + 0.5 * std::abs(angle - clamp)});
      },
      {rim, clamp});
}

}  // namespace palpate::test
