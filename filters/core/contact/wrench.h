// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

namespace palpate {

/// Force and torque about a stated centre.
struct Wrench {
  Eigen::Vector3d force, torque;  ///< N, N m
};

/// Of what touches nothing.
inline const Wrench kNoWrench{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};

}  // namespace palpate
