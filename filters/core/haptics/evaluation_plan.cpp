// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/evaluation_plan.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

#include "contact/inverse_updates.h"
#include "contact/pressure_mask.h"
#include "mesh/triangle_tree.h"

namespace palpate {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kBlock = 9;       ///< numbers of a block of Green's functions
constexpr double kNumber = 8;      ///< bytes
constexpr int kMostSamples = 256;  ///< vertices and triangles whose masks are looked at
constexpr double kSnapshots = 3;   ///< that a servo loop keeps

// Flops, counted in the sources.
constexpr double kTurnedBlock = 126;  ///< a block that is turned twice and scaled
constexpr double kPointTick = 600;    ///< a point: stiffness, its norm, slip
constexpr double kCoupling = 400;     ///< a pair of points: weights of corners, norm
constexpr double kProximity = 30;     ///< a distance to a ball
constexpr double kTorque = 15;        ///< a contact's torque

/// What the work on a body depends on.
struct BodySizes {
  int nodes = 0, freeNodes = 0, triangles = 0;
  double nodeArea = 0;       ///< m^2, mean
  double edge = 0;           ///< m, mean
  bool knowsWeight = false;  ///< what it does comes with the Green's functions
  // Of pressure masks, if points touch it:
  double maskNodes = 0;         ///< mean number of nodes
  double maskNodesSquared = 0;  ///< mean of its square
  double pointNodes = 0;        ///< under the masks of all corners of a triangle, by area
};

int partsOf(const SceneTool& tool) {
  return tool.shape == ToolShape::Hand ? kHandCapsuleCount : 1;
}

/// A plan in the making.
class Planner {
 public:
  /// @param rehearsed  of shapes.
  Planner(const Scene& scene, const std::vector<BodySizes>& bodies, const ExpectedTouch& touch,
          const RehearsedTouch& rehearsed)
      : scene_(scene), bodies_(bodies), touch_(touch), first_(bodies.front()) {
    plan_.rate = scene.servo.rate;
    plan_.rehearsed = rehearsed;
    loadedOf_.assign(bodies.size(), 0);
    loadedSquaredOf_.assign(bodies.size(), 0);
    if (scene.isOfPoints())
      planPoints();
    else
      planShapes();
    if (!scene.effects.gravity.isZero(0)) planGravity();
    plan_.loaded = loadedOf_[0];
    planProbesInside();
    planFrame();
    plan_.memory.push_back({"snapshots of contacts", kSnapshots * snapshotBytes_});
  }
  EvaluationPlan take() { return std::move(plan_); }

 private:
  /// All rows for all free columns, and the surface once more.
  void planGravity() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const BodySizes& body = bodies_[i];
      const double blocks = double(2 * body.nodes - body.freeNodes) * body.freeNodes;
      const std::string which = i ? " of partner " + std::to_string(i) : "";
      if (!body.knowsWeight)
        plan_.setup.push_back({"gravity" + which, double(body.nodes), double(body.freeNodes),
                               2 * kBlock * blocks, kNumber * kBlock * blocks});
      plan_.memory.push_back({"surface under gravity" + which,
                              kMeshVertex * body.nodes + kMeshTriangle * body.triangles});
    }
  }

  /// Thirteen rows a point, from all columns at first, then for the nodes under forces.
  void planProbesInside() {
    double points = 0;
    for (const SceneProbe& probe : scene_.effects.probes) points += probe.isInside;
    if (points == 0) return;
    constexpr double values = 13, perBlock = 3 * values;
    const double all = double(first_.nodes) * first_.freeNodes;
    plan_.setup.push_back({"probes inside", double(first_.nodes), double(first_.freeNodes),
                           2 * 2 * values * points * kBlock * all, kNumber * kBlock * all});
    const double blocks = points * loadedOf_[0];
    plan_.tick.push_back({"probes inside", points, loadedOf_[0], 2 * perBlock * blocks,
                          kNumber * perBlock * blocks});
    plan_.memory.push_back({"rows of probes inside", kNumber * perBlock * points * first_.nodes});
  }

  void planPoints() {
    const double tools = static_cast<double>(scene_.tools.size());
    loadedOf_[0] = std::min<double>(first_.freeNodes, tools * first_.pointNodes);
    loadedSquaredOf_[0] = loadedOf_[0] * loadedOf_[0];
    const double blocks = first_.freeNodes * (first_.maskNodesSquared + first_.maskNodes);
    plan_.setup.push_back({"stiffness of the surface", first_.maskNodes, double(first_.freeNodes),
                           2 * kBlock * blocks, kNumber * kBlock * blocks});
    plan_.tick.push_back(
        {"points that stick and slide", 0, 0, tools * kPointTick, tools * 3 * kNumber * kBlock});
    if (tools > 1) planCoupling(tools);
    const double perNode = kNumber * (kBlock + 2) + 1. / 8 + sizeof(VertexMask) + sizeof(int);
    const double perMask = 2 * kAllocation + (kNumber + sizeof(int)) * first_.maskNodes;
    plan_.memory.push_back({"stiffness of the surface and its masks",
                            first_.nodes * perNode + first_.freeNodes * perMask});
    constexpr double perSide = 2 * sizeof(int);
    plan_.memory.push_back({"search and walks on the surface",
                            first_.triangles * (3 * perSide + TriangleTree::bytesPerTriangle())});
    snapshotBytes_ = first_.nodes * kLoadBytes;
  }

  /// A line crosses 2 / pi times the length of edges in an area of its own length. Each time one
  /// corner is new, to be coupled with three of each other point.
  void planCoupling(double tools) {
    const double crossings = 6 * first_.edge / (kPi * first_.nodeArea);  // a metre
    double ways = 0;
    for (const SceneTool& tool : scene_.tools)
      ways += (touch_.speed > 0 ? touch_.speed : handSpeed(scene_, tool)) / scene_.servo.rate;
    const double columns = 3 * (tools - 1) * crossings * ways * first_.maskNodes;
    const double blocks = first_.maskNodes * columns, pairs = tools * (tools - 1) / 2;
    plan_.tick.push_back({"compliance between points that slide", first_.maskNodes, columns,
                          2 * kBlock * blocks, kNumber * kBlock * blocks});
    const double perPair = kCoupling + 4 * kBlock;
    plan_.tick.push_back({"points that feel each other", 0, 0,
                          touch_.sweeps * (tools * kPointTick + pairs * perPair),
                          touch_.sweeps * pairs * 10 * kNumber * kBlock});
    plan_.memory.push_back({"coupling of points", kPairBytes * pairs + kPointBytes * tools});
  }

  void planShapes() {
    const RehearsedTouch& counted = plan_.rehearsed;
    loadedOf_ = counted.loaded;
    loadedSquaredOf_ = counted.loadedSquared;
    plan_.watched = counted.watched;
    double parts = 0;
    for (const SceneTool& tool : scene_.tools) parts += partsOf(tool);
    for (std::size_t i = 1; i < bodies_.size(); ++i) {
      parts += 1;
      plan_.memory.push_back(
          {"search on partner " + std::to_string(i),
           bodies_[i].triangles * (9 * kNumber + TriangleTree::bytesPerTriangle()) +
               3 * kNumber * bodies_[i].nodes});
    }
    const double w = counted.watched;
    const auto per = [](double blocks, double rows) { return rows > 0 ? blocks / rows : 0; };
    plan_.tick.push_back({"compliance of points that come near", w, per(counted.gatheredBlocks, w),
                          kTurnedBlock * counted.gatheredBlocks,
                          kNumber * kBlock * counted.gatheredBlocks});
    plan_.tick.push_back({"points looked at as they are pressed",
                          per(counted.displacementBlocks, loadedOf_[0]), loadedOf_[0],
                          2 * kBlock * counted.displacementBlocks,
                          kNumber * kBlock * counted.displacementBlocks});
    plan_.tick.push_back({"search for vertices that come near", 0, 0,
                          parts * first_.nodes + 3 * kProximity * w,
                          parts * first_.nodes * (kNumber + 1)});
    plan_.tick.push_back(
        {"unilateral contact", 0, 0, 2 * counted.solverMultiplications, counted.solverBytes});
    if (scene_.effects.torque) plan_.tick.push_back({"torque", 0, 0, kTorque * w, kNumber * 6 * w});
    planSolverMemory(parts);
  }

  void planSolverMemory(double parts) {
    const int capacity = scene_.solver.capacityFor(first_.nodes);
    const double c = capacity, stride = padded(3 * capacity);
    constexpr double perContact = 1000;  // sites, conditions, shares, borders and scratch
    plan_.memory.push_back({"matrices of the contact solver",
                            3 * kNumber * stride * 3 * c + 16 * kNumber * stride + perContact * c});
    plan_.memory.push_back({"search for vertices", parts * first_.nodes * (kNumber + 1)});
    snapshotBytes_ = 4 * c * kLoadBytes;
  }

  void planFrame() {
    const DeformationRows rows = scene_.effects.deformation;
    for (std::size_t i = 0; i < bodies_.size() && rows != DeformationRows::None; ++i) {
      const BodySizes& body = bodies_[i];
      const std::string which = i ? " of partner " + std::to_string(i) : "";
      if (rows == DeformationRows::Contact)
        addRows("deformation" + which, loadedOf_[i], loadedOf_[i], loadedSquaredOf_[i]);
      else
        addRows("deformation" + which,
                (rows == DeformationRows::All ? 1 : touch_.visible) * body.nodes, loadedOf_[i]);
      plan_.memory.push_back({"displacements" + which, 3 * kNumber * body.nodes});
    }
    if (scene_.effects.probes.empty()) return;
    double count = 0;
    for (const SceneProbe& probe : scene_.effects.probes)
      count += probe.isInside ? 0 : probe.node >= 0 ? 1 : 3;
    if (count == 0) return;
    if (rows != DeformationRows::All) addRows("probes", count, loadedOf_[0]);
    plan_.memory.push_back(
        {"probes",
         2 * kNumber * count + 4 * kNumber * static_cast<double>(scene_.effects.probes.size())});
  }

  void addRows(const std::string& what, double rows, double columns) {
    addRows(what, rows, columns, rows * columns);
  }

  void addRows(const std::string& what, double rows, double columns, double blocks) {
    plan_.frame.push_back({what, rows, columns, 2 * kBlock * blocks, kNumber * kBlock * blocks});
  }

  static constexpr double kMeshVertex = 7 * kNumber + 2 * sizeof(int);  ///< bytes of a SurfaceMesh
  static constexpr double kMeshTriangle = 4 * kNumber + 6 * sizeof(int);
  static constexpr double kPairBytes = 22 * kNumber * kBlock;  ///< corners, now and before
  static constexpr double kPointBytes = 2300;  ///< its state, to take ticks back, corners
  static constexpr double kAllocation = 12;    ///< bytes that a block of heap memory costs besides
  static constexpr double kLoadBytes = 2 * sizeof(int) + sizeof(Eigen::Vector3d);

  const Scene& scene_;
  const std::vector<BodySizes>& bodies_;
  const ExpectedTouch& touch_;
  const BodySizes& first_;
  std::vector<double> loadedOf_, loadedSquaredOf_;  ///< nodes under forces, a body
  double snapshotBytes_ = 0;
  EvaluationPlan plan_;
};

/// Every so many, that there be at most kMostSamples.
int strideOf(int count) {
  return std::max(1, (count + kMostSamples - 1) / kMostSamples);
}

void measureMasks(const SceneBody& body, const SceneEffects& effects, BodySizes& sizes) {
  const SurfaceMesh& mesh = *body.mesh;
  const BoundaryConditions& conditions = body.greens->info().conditions;
  const double radius =
      effects.maskRadiusEdges > 0 ? effects.maskRadiusEdges * sizes.edge : effects.maskRadius;
  const PressureMasks masks(mesh, conditions, effects.maskShape, radius);
  const std::vector<int> free = conditions.freeNodes();
  double samples = 0;
  for (std::size_t i = 0; i < free.size(); i += strideOf(static_cast<int>(free.size()))) {
    const double count = static_cast<double>(masks.at(free[i]).nodes.size());
    sizes.maskNodes += count;
    sizes.maskNodesSquared += count * count;
    ++samples;
  }
  sizes.maskNodes /= samples;
  sizes.maskNodesSquared /= samples;
  double area = 0;
  for (int f = 0; f < mesh.triangleCount(); f += strideOf(mesh.triangleCount())) {
    std::set<int> under;
    for (int k = 0; k < 3; ++k) {
      const int vertex = mesh.triangles()(k, f);
      if (conditions.isFixed(vertex)) continue;
      const VertexMask mask = masks.at(vertex);
      under.insert(mask.nodes.begin(), mask.nodes.end());
    }
    if (under.empty()) continue;
    sizes.pointNodes += mesh.triangleAreas()[f] * static_cast<double>(under.size());
    area += mesh.triangleAreas()[f];
  }
  if (area > 0) sizes.pointNodes /= area;
}

BodySizes measure(const SceneBody& body, const Scene& scene) {
  BodySizes sizes;
  const SurfaceMesh& mesh = *body.mesh;
  sizes.nodes = mesh.vertexCount();
  sizes.freeNodes = static_cast<int>(body.greens->info().conditions.freeNodes().size());
  sizes.triangles = mesh.triangleCount();
  sizes.nodeArea = mesh.vertexAreas().mean();
  sizes.edge = mesh.meanEdgeLength();
  sizes.knowsWeight = body.greens->info().weightResponse.size() > 0;
  if (scene.isOfPoints()) measureMasks(body, scene.effects, sizes);
  return sizes;
}

}  // namespace

EvaluationPlan planEvaluation(const Scene& scene, const std::vector<SceneBody>& bodies,
                              const ExpectedTouch& touch,
                              const std::vector<std::shared_ptr<const SurfaceMesh>>& toolMeshes,
                              const Progress& progress) {
  if (bodies.empty() || bodies.size() != scene.models.size())
    throw std::invalid_argument("the scene has " + std::to_string(scene.models.size()) +
                                " models, but there are " + std::to_string(bodies.size()));
  std::vector<BodySizes> sizes;
  for (const SceneBody& body : bodies) sizes.push_back(measure(body, scene));
  RehearsalSettings settings;
  settings.depth = touch.depth;
  settings.speed = touch.speed;
  return Planner(scene, sizes, touch,
                 scene.isOfPoints() ? RehearsedTouch{}
                                    : rehearse(scene, bodies, toolMeshes, settings, progress))
      .take();
}

PlannedWork total(const std::vector<PlannedWork>& list) {
  PlannedWork sum{"together"};
  for (const PlannedWork& work : list) {
    sum.rows += work.rows;
    sum.columns += work.columns;
    sum.flops += work.flops;
    sum.bytes += work.bytes;
  }
  return sum;
}

double totalBytes(const std::vector<PlannedMemory>& list) {
  return std::accumulate(list.begin(), list.end(), 0.,
                         [](double sum, const auto& entry) { return sum + entry.bytes; });
}

}  // namespace palpate
