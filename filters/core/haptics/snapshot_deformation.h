// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "greens/greens_functions.h"
#include "haptics/touch_model.h"

namespace palpate {

/// The deformed surface that belongs to a snapshot of its contacts, for the slower thread that
/// draws it: u = sum of Xi f / a over the nodes under a force, at the rows that are asked for
/// ([JP01] section 4.3).
class SnapshotDeformation {
 public:
  /// @param body            its number in the snapshots.
  /// @param orientation     of the body in the scene.
  /// @throws std::invalid_argument without Green's functions.
  explicit SnapshotDeformation(
      std::shared_ptr<const GreensFunctions> greens, int body = 0,
      const Eigen::Quaterniond& orientation = Eigen::Quaterniond::Identity());

  /// Displacements of all nodes.
  /// @param stiffnessScale  by which the model scales its forces: those that deform are without it.
  void computeAll(const ContactSnapshot& snapshot, double stiffnessScale = 1);
  /// Of some nodes; the others are as they were.
  /// @throws std::invalid_argument for a node out of range.
  void computeAt(const std::vector<int>& nodes, const ContactSnapshot& snapshot,
                 double stiffnessScale = 1);
  /// The nodes under a force, without repetition.
  std::vector<int> loadedNodes(const ContactSnapshot& snapshot) const;

  /// 3 by #nodes, m, in the scene's frame; zero until computed.
  const Eigen::Matrix3Xd& displacement() const { return displacement_; }

 private:
  void collect(const ContactSnapshot& snapshot, double stiffnessScale);

  std::shared_ptr<const GreensFunctions> greens_;
  int body_;
  Eigen::Matrix3d orientation_;
  std::vector<int> nodes_;
  Eigen::VectorXd tractions_;  ///< 3 nodes_, in the body's frame, Pa
  Eigen::Matrix3Xd displacement_;
};

}  // namespace palpate
