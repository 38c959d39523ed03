// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/tool_stiffness.h"

#include <algorithm>
#include <stdexcept>

#include "haptics/hand_proportions.h"
#include "haptics/pressing_hand.h"
#include "haptics/stability_lab.h"

namespace palpate {
namespace {

constexpr int kMostPlaces = 24;

/// A place to press at: the tool's position when it just touches, and the way in.
struct Press {
  Eigen::Vector3d place, direction;
};

std::vector<Press> pressesOf(const SceneBody& body, const SceneTool& tool,
                             const SurfaceMesh* toolMesh) {
  if (tool.radius == 0) {
    std::vector<Eigen::Vector3d> taken;
    const PressPlan plan = planPress(body, tool, toolMesh, taken);
    return {{plan.contact, -plan.outwards}};
  }
  std::vector<int> vertices;
  for (int v : body.greens->info().conditions.freeNodes())
    if (body.greens->hasColumn(v)) vertices.push_back(v);
  const std::size_t stride = std::max<std::size_t>(1, vertices.size() / kMostPlaces);
  std::vector<Press> presses;
  for (std::size_t i = 0; i < vertices.size(); i += stride) {
    const Eigen::Vector3d normal = body.mesh->vertexNormals().col(vertices[i]);
    presses.push_back({body.mesh->points().col(vertices[i]) + tool.radius * normal, -normal});
  }
  return presses;
}

/// 0 where it leads nowhere.
double stiffnessAt(TouchModel& model, const Press& press, double depth) {
  LabSettings settings;
  settings.place = press.place;
  settings.direction = press.direction;
  settings.depth = depth;
  try {
    return StabilityLab(model, settings).stiffness();
  } catch (const std::invalid_argument&) {
    return 0;
  }
}

}  // namespace

ToolStiffness toolStiffness(const Scene& scene, const std::vector<SceneBody>& bodies,
                            const std::vector<std::shared_ptr<const SurfaceMesh>>& toolMeshes) {
  ToolStiffness largest;
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    Scene alone = scene;
    alone.effects.deformation = DeformationRows::None;
    alone.effects.probes.clear();
    alone.effects.stiffnessScale = 1;
    SceneTool& tool = alone.tools[0] = scene.tools[t];
    alone.tools.resize(1);
    if (tool.shape == ToolShape::Hand) {
      tool.shape = ToolShape::Sphere;
      tool.radius = hand::kThumbRadii[2] * tool.length;
    } else if (tool.shape == ToolShape::Capsule) {  // its rounded tip
      tool.shape = ToolShape::Sphere;
    }
    const auto mesh = t < toolMeshes.size() ? toolMeshes[t] : nullptr;
    const TouchSession session(alone, bodies, {mesh});
    const SceneBody hung = {bodies[0].greens, session.mesh(0)};
    double depth = hung.mesh->diagonal() / 100;
    if (tool.radius > 0) depth = std::min(depth, tool.radius);
    for (const Press& press : pressesOf(hung, tool, mesh.get()))
      if (const double stiffness = stiffnessAt(session.contact(), press, depth);
          stiffness > largest.stiffness)
        largest = {stiffness, depth};
  }
  return largest;
}

}  // namespace palpate
