// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>

#include "contact/point_contact.h"

namespace palpate::test {

/// Mean of a field under the mask of a point: the barycentric average of its free corners' masks.
inline Eigen::Vector3d meanUnderMask(const SurfaceStiffness& stiffness, const SurfacePoint& point,
                                     const Eigen::Matrix3Xd& field) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const VertexMask& mask = stiffness.mask(stiffness.mesh().triangles()(k, point.triangle));
    for (std::size_t m = 0; m < mask.nodes.size(); ++m)
      mean += point.barycentric[k] * mask.density[m] *
              stiffness.greens().vertexArea(mask.nodes[m]) * field.col(mask.nodes[m]);
  }
  return mean;
}

/// Mean displacement at one point under a unit force at another, by the whole body's deformation.
inline Eigen::Matrix3d meanCompliance(const std::shared_ptr<const SurfaceStiffness>& stiffness,
                                      const SurfacePoint& to, const SurfacePoint& from) {
  const PointContact contact(stiffness, from);
  Eigen::Matrix3d compliance;
  Eigen::Matrix3Xd displacement, traction;
  for (int c = 0; c < 3; ++c) {
    contact.deform(Eigen::Vector3d::Unit(c), displacement, traction);
    compliance.col(c) = meanUnderMask(*stiffness, to, displacement);
  }
  return compliance;
}

}  // namespace palpate::test
