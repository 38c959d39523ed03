// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "greens/greens_functions.h"
#include "haptics/touch_model.h"

namespace palpate {

/// The tractions of a snapshot on one body.
struct SnapshotTractions {
  std::vector<int> nodes;  ///< free ones under a force, ascending, each once
  Eigen::VectorXd values;  ///< 3 nodes, in the body's frame, Pa
};
/// @param stiffnessScale  by which the model scales its forces: those that deform are without it.
SnapshotTractions snapshotTractions(const GreensFunctions& greens, const ContactSnapshot& snapshot,
                                    int body, const Eigen::Matrix3d& orientation,
                                    double stiffnessScale);

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
  /// Lets nodes be where they are undeformed.
  /// @throws std::invalid_argument for a node out of range.
  void clearAt(const std::vector<int>& nodes);
  /// The nodes under a force, without repetition.
  std::vector<int> loadedNodes(const ContactSnapshot& snapshot) const;

  /// 3 by #nodes, m, in the scene's frame; zero until computed.
  const Eigen::Matrix3Xd& displacement() const { return displacement_; }

 private:
  void requireNodes(const std::vector<int>& nodes) const;

  std::shared_ptr<const GreensFunctions> greens_;
  int body_;
  Eigen::Matrix3d orientation_;
  Eigen::Matrix3Xd displacement_;
};

}  // namespace palpate
