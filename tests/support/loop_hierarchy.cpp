// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/loop_hierarchy.h"

#include "mesh/loop_limit.h"
#include "mesh/loop_subdivision.h"
#include "mesh/smooth_patches.h"
#include "model/graded_model.h"
#include "model/support.h"

namespace palpate::test {

LoopHierarchy::LoopHierarchy(const std::string& name) : base_(readDataModel(name)) {
  meshes_.push_back({base_.shape, base_.boundaryTypes});
}

ElasticModel LoopHierarchy::operator()(int level, int layers) {
  while (static_cast<int>(meshes_.size()) <= level) {
    const Mesh& last = meshes_.back();
    const SubdivisionLevel next = subdivideLoop(*last.shape.mesh());
    meshes_.push_back(
        {{next.points, next.triangles}, refineBoundaryTypes(next, last.boundaryTypes)});
  }
  const auto control = meshes_[level].shape.mesh();
  const auto mesh = std::make_shared<SurfaceMesh>(towardsLoopLimit(*control, kVolumeShare),
                                                  control->triangles());
  const BoundaryConditions conditions(meshes_[level].boundaryTypes);
  const ElasticModel model(mesh, Material(base_.youngsModulus, base_.poissonRatio), conditions,
                           splitAtSupport(*mesh, conditions, findSmoothPatches(*mesh, 30)));
  return layers > 0 ? gradedModel(model, layers) : model;
}

}  // namespace palpate::test
