// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/pressing_hand.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

namespace palpate {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kClearance = 0.05, kDepth = 0.02;  ///< diagonals of the body
// As an arm that holds a pen, damped so that it does not swing.
constexpr double kArmStiffness = 400, kArmDamping = 5;  ///< N/m, N s/m

/// Of a body that nothing fixes, its own middle.
Eigen::Vector3d middleOfSupport(const SceneBody& body) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int fixed = 0;
  for (int v = 0; v < body.mesh->vertexCount(); ++v)
    if (body.greens->isFixed(v)) {
      sum += body.mesh->points().col(v);
      ++fixed;
    }
  if (fixed == 0) return body.mesh->points().rowwise().mean();
  return sum / fixed;
}

/// Ends of the edges that belong to one triangle alone.
std::vector<Eigen::Vector3d> rimOf(const SurfaceMesh& mesh) {
  std::set<std::pair<int, int>> edges;
  for (const auto& corners : mesh.triangles().colwise())
    for (int k = 0; k < 3; ++k) edges.emplace(corners[k], corners[(k + 1) % 3]);
  std::vector<Eigen::Vector3d> rim;
  for (const auto& [from, to] : edges)
    if (edges.count({to, from}) == 0) rim.push_back(mesh.points().col(from));
  return rim;
}

/// What a hand keeps away from. A half-space goes on beyond the rim of its surface, where nothing
/// can be touched.
std::vector<Eigen::Vector3d> avoidedBy(const SceneBody& body) {
  if (body.greens->info().domain == Domain::HalfSpace) return rimOf(*body.mesh);
  return {middleOfSupport(body)};
}

/// The vertex that lies farthest along a direction.
int farthestAlong(const SurfaceMesh& mesh, const Eigen::Vector3d& direction) {
  Eigen::Index vertex;
  (direction.transpose() * mesh.points()).maxCoeff(&vertex);
  return static_cast<int>(vertex);
}

/// From where the tool touches to its position.
Eigen::Vector3d reachOf(const SceneTool& tool, const SurfaceMesh* toolMesh,
                        const Eigen::Vector3d& outwards) {
  if (toolMesh) return -toolMesh->points().col(farthestAlong(*toolMesh, -outwards));
  return tool.radius * outwards;
}

}  // namespace

int farthestFreeVertex(const SceneBody& body, const std::vector<Eigen::Vector3d>& taken) {
  std::vector<Eigen::Vector3d> avoided = avoidedBy(body);
  avoided.insert(avoided.end(), taken.begin(), taken.end());
  int farthest = -1;
  double largest = -1;
  for (int v = 0; v < body.mesh->vertexCount(); ++v) {
    if (body.greens->isFixed(v) || !body.greens->hasColumn(v)) continue;
    double distance = HUGE_VAL;
    for (const Eigen::Vector3d& place : avoided)
      distance = std::min(distance, (body.mesh->points().col(v) - place).norm());
    if (distance <= largest) continue;
    largest = distance;
    farthest = v;
  }
  if (farthest < 0)
    throw std::invalid_argument("the model has no free vertex with Green's functions to press on");
  return farthest;
}

PressPlan planPress(const SceneBody& body, const SceneTool& tool, const SurfaceMesh* toolMesh,
                    std::vector<Eigen::Vector3d>& taken) {
  if (tool.shape == ToolShape::Hand)
    throw std::invalid_argument(
        "a simulated device has no joints to move a hand with: give it a glove's recording");
  const SurfaceMesh& mesh = *body.mesh;
  PressPlan plan;
  int vertex;
  if (tool.shape == ToolShape::Capsule || tool.shape == ToolShape::Plane) {
    plan.outwards = (tool.shape == ToolShape::Plane ? -1.0 : 1.0) * Eigen::Vector3d::UnitZ();
    vertex = farthestAlong(mesh, plan.outwards);
  } else {
    vertex = farthestFreeVertex(body, taken);
    plan.outwards = mesh.vertexNormals().col(vertex).stableNormalized();
  }
  const Eigen::Vector3d place = mesh.points().col(vertex);
  taken.push_back(place);
  plan.contact = place + reachOf(tool, toolMesh, plan.outwards);
  plan.clearance = kClearance * mesh.diagonal();
  plan.depth = kDepth * mesh.diagonal();
  if (tool.radius > 0) plan.depth = std::min(plan.depth, tool.radius);
  return plan;
}

std::shared_ptr<SimulatedDevice> pressingDevice(const PressPlan& plan,
                                                const WorkspaceMapping& mapping, double period) {
  SimulatedDeviceSettings settings;
  settings.period = period;
  settings.hand.stiffness = kArmStiffness;
  settings.hand.damping = kArmDamping;
  settings.hand.path = [plan, mapping](double time) -> Eigen::Vector3d {
    const double lifted = (1 + std::cos(2 * kPi * time / PressPlan::kSeconds)) / 2;
    const double height = lifted * (plan.clearance + plan.depth) - plan.depth;
    const Eigen::Vector3d inScene = plan.contact + height * plan.outwards;
    return mapping.rotation.conjugate() * (inScene - mapping.origin) / mapping.scale;
  };
  auto device = std::make_shared<SimulatedDevice>(settings);
  device->place(settings.hand.path(0), Eigen::Vector3d::Zero());
  return device;
}

}  // namespace palpate
