// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "haptics/scene.h"
#include "haptics/snapshot_deformation.h"
#include "haptics/touch_model.h"
#include "mesh/surface_mesh.h"

namespace palpate {

/// One of a scene's models, loaded.
struct SceneBody {
  std::shared_ptr<const GreensFunctions> greens;
  std::shared_ptr<const SurfaceMesh> mesh;
  Eigen::VectorXi smoothPatches = {};  ///< #F, as the Green's functions were made with; for gravity
  /// Of the scene's probes inside, in its order; null without any.
  std::shared_ptr<const ProbeRows> probeRows = nullptr;
};

/// 3 by #points, m: where a scene's probes inside the first model are.
Eigen::Matrix3Xd placesInside(const Scene& scene);

/// @throws std::invalid_argument for a body that no tool can touch: of an exterior domain, whose
///         material is where tools are, or without Green's functions of any free node.
void requireTouchable(const SceneBody& body);

/// What a user should know of a scene before relying on its forces, a sentence each: Green's
/// functions that are missing, bodies that overlap, tools and masks that the mesh is too coarse for.
std::vector<std::string> warningsOf(const Scene& scene, const std::vector<SceneBody>& bodies);

/// A scene at work: the model that a servo loop steps, and the displacements that a slower thread
/// draws. It holds what the scene's effects need and nothing else.
class TouchSession {
 public:
  /// @param bodies      one for each of the scene's models, in its order.
  /// @param toolMeshes  one for each of its tools, null but for meshes; may be empty without them.
  /// @throws std::invalid_argument if a body or a tool's mesh is missing, for a probe that is not
  ///         on the first model, or without rows of those inside it; and as requireTouchable,
  ///         gravityDisplacement, PointTouch, SurfaceStiffness and ToolTouch.
  TouchSession(const Scene& scene, const std::vector<SceneBody>& bodies,
               const std::vector<std::shared_ptr<const SurfaceMesh>>& toolMeshes = {});

  /// For ServoLoop.
  const std::shared_ptr<TouchModel>& model() const { return model_; }
  /// What of it touches: PointTouch or ToolTouch.
  TouchModel& contact() const { return *contact_; }

  /// A body before it is touched: as it was given, or as it hangs under its weight. From there on
  /// displacements are counted.
  const std::shared_ptr<const SurfaceMesh>& mesh(int body) const { return bodies_[body].mesh; }

  /// Computes the rows that the scene asks for. Rows that were computed before and are not now are
  /// zero again.
  /// @param visible  nodes in view, a list for each body; needed for DeformationRows::Visible only,
  ///                 and lists at the end may be missing.
  /// @throws std::invalid_argument for a node out of range.
  void computeFrame(const ContactSnapshot& snapshot,
                    const std::vector<std::vector<int>>& visible = {});

  /// Tells by what the model scales its forces from now on: they deform without it.
  void setStiffnessScale(double scale) noexcept;

  /// Whether displacements are computed at all, beyond those of probes.
  bool deforms() const { return !deformations_.empty(); }
  /// 3 by #nodes of a body, m, in the scene's frame; zero where not computed.
  /// @throws std::out_of_range unless it deforms.
  const Eigen::Matrix3Xd& displacement(int body) const {
    return deformations_.at(body).displacement();
  }
  /// 3 by #probes, in the scene's order, m: of the last frame, or of the snapshot for those inside.
  const Eigen::Matrix3Xd& probeDisplacements() const { return probes_; }

 private:
  void probeInside(const Scene& scene);
  void placeProbes(const std::vector<SceneProbe>& probes, const SceneBody& body);
  void computeProbes(const ContactSnapshot& snapshot);

  const GreensFunctions& greens() const { return *bodies_[0].greens; }

  std::vector<SceneBody> bodies_;
  DeformationRows rows_;
  double stiffnessScale_;
  std::shared_ptr<TouchModel> contact_, model_;
  ProbedTouch* probed_ = nullptr;   ///< the model, if probes are inside
  std::vector<int> insideNumbers_;  ///< a probe: its number among those inside, or -1
  std::vector<SnapshotDeformation> deformations_;  ///< a body, or none
  std::vector<std::vector<int>> computed_;         ///< rows of the last frame, a body
  std::vector<int> probeNodes_;                    ///< as many a probe as probeStarts_ says
  std::vector<double> probeWeights_;               ///< of each of them
  std::vector<int> probeStarts_;                   ///< #probes + 1
  Eigen::Matrix3Xd probes_;
};

}  // namespace palpate
