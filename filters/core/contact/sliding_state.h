// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <memory>

#include "mesh/surface_locator.h"
#include "mesh/surface_walk.h"

namespace palpate {

/// What all contacts with one surface share.
struct TouchedSurface {
  explicit TouchedSurface(const std::shared_ptr<const SurfaceMesh>& mesh)
      : locator(mesh), walk(mesh) {}
  SurfaceLocator locator;
  SurfaceWalk walk;
};

/// All of a SlidingContact that a tick changes.
struct SlidingState {
  enum class Phase { Unknown, Unserved, Outside, Touching };

  Phase phase_ = Phase::Unknown;
  bool hasPlace_ = false;
  Eigen::Vector3d probe_ = Eigen::Vector3d::Zero();    ///< x^H
  Eigen::Vector3d place_ = Eigen::Vector3d::Zero();    ///< x^H less the shift
  Eigen::Vector3d outside_ = Eigen::Vector3d::Zero();  ///< a place out of the material
  SurfacePoint point_{0, Eigen::Vector3d::UnitX()};
  Eigen::Vector3d staticPoint_ = Eigen::Vector3d::Zero(), normal_ = Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d here_ = Eigen::Matrix3d::Zero();  ///< K^H(x^C)
  double norm_ = 0;                                 ///< of here_, when the tick began
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
  int blendLeft_ = 0;  ///< ticks in which what is left of the former stiffness fades

  int slides_ = 0;
  double excess_ = 0;
  bool isHeldBack_ = false, isStuck_ = false, isUnserved_ = false, startedInside_ = false;
};

}  // namespace palpate
