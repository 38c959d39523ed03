// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "haptics/hand_tool.h"
#include "mesh/surface_mesh.h"
#include "model/boundary_conditions.h"

namespace palpate {

/// Shapes a hand to a body before any force is known: joints bend until a bone presses into the
/// undeformed free surface as deep as is asked, or meets a fixed vertex.
class HandGrip {
 public:
  /// @throws std::invalid_argument without a surface, or for conditions of another size.
  HandGrip(const HandModel& hand, std::shared_ptr<const SurfaceMesh> mesh,
           const BoundaryConditions& conditions);

  /// The deepest that vertices of one kind are inside bones, m; negative: the nearest is so far.
  /// @param first, count  bones as HandModel numbers them.
  double depth(const ToolPose& pose, int first, int count, bool fixed = false) const;

  /// Moves the hand until its four metacarpals press.
  /// @param way       unit, which way to move.
  /// @param farthest  m, to move in any case no farther.
  /// @param depth     m, >= 0.
  ToolPose lowered(ToolPose pose, const Eigen::Vector3d& way, double farthest, double depth) const;

  /// Bends thumb and fingers from where they are. Each joint bends until its bone, or one beyond
  /// it, presses; then those beyond bend on. The thumb's first joint swings it towards the fingers.
  /// @param depth  m, >= 0.
  ToolPose closed(ToolPose pose, double depth) const;

 private:
  bool presses(const ToolPose& pose, int first, int count, double depth) const;

  HandTool tool_;
  std::shared_ptr<const SurfaceMesh> mesh_;
  std::vector<char> fixed_;
};

}  // namespace palpate
