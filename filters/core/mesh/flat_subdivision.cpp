// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/flat_subdivision.h"

namespace palpate {

LoopLevel subdivideFlat(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles) {
  LoopLevel level = subdivideLoop(points, triangles);
  for (Eigen::Index v = 0; v < level.points.cols(); ++v)
    level.points.col(v) = 0.5 * (points.col(level.parents(0, v)) + points.col(level.parents(1, v)));
  return level;
}

SurfacePoint parentPoint(const LoopLevel& level, const Eigen::Matrix3Xi& coarse,
                         const SurfacePoint& point) {
  SurfacePoint parent{level.parentTriangle[point.triangle], Eigen::Vector3d::Zero()};
  for (int k = 0; k < 3; ++k)
    for (int ancestor : level.parents.col(level.triangles(k, point.triangle)))
      for (int corner = 0; corner < 3; ++corner)
        if (coarse(corner, parent.triangle) == ancestor)
          parent.barycentric[corner] += 0.5 * point.barycentric[k];
  return parent;
}

}  // namespace palpate
