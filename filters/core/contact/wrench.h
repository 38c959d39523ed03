// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

namespace palpate {

/// Force and torque about a stated centre.
struct Wrench {
  Eigen::Vector3d force, torque;  ///< N, N m
};

}  // namespace palpate
