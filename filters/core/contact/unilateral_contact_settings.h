// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <algorithm>
#include <memory>

#include "contact/frictional_contact_solver.h"
#include "contact/rigid_shape.h"
#include "mesh/surface_mesh.h"

namespace palpate {

/// What an elastic surface meets.
struct Obstacle {
  std::shared_ptr<const RigidShape> shape;
  double friction = 0;  ///< Coulomb's mu between the two
  /// Of a second elastic body, whose undeformed surface is `shape` in its own frame, with the
  /// proximity's triangles those of `mesh`: both null for a rigid tool.
  std::shared_ptr<const GreensFunctions> greens = nullptr;
  std::shared_ptr<const SurfaceMesh> mesh = nullptr;
  /// Obstacles of the same number, >= 0, are parts of one tool and may overlap: a vertex meets the
  /// nearest of them only. -1: by itself.
  int tool = -1;
};

struct UnilateralContactSettings {
  /// Most points watched at a time, over all obstacles; 0 for as many as the surface has vertices,
  /// but at least kLeastChosen and at most kMostChosen, whose matrices take 54 MB. Who touches may
  /// ask for up to kMostContacts.
  int capacity = 0;
  static constexpr int kLeastChosen = 128, kMostChosen = 500, kMostContacts = 2000;
  int capacityFor(int vertices) const {
    return capacity != 0 ? capacity : std::clamp(vertices, kLeastChosen, kMostChosen);
  }
  /// m: a vertex is watched from this distance of its undeformed place to an obstacle on, and no
  /// longer beyond twice that; 0 for half the mean edge.
  double margin = 0;
  double rigidStiffness = 0;  ///< N/m, what fixed vertices yield by; 0 for 10 E times the mean edge
  int linearisations = 1;     ///< of the gaps at the deformed place, a step
  ContactSolverSettings solver;
};

}  // namespace palpate
