// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/touch_session.h"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <string>

#include "contact/mesh_shape.h"
#include "greens/gravity.h"
#include "haptics/hand_tool.h"
#include "haptics/point_touch.h"
#include "haptics/tool_touch.h"
#include "mesh/surface_locator.h"
#include "mesh/surface_point.h"

namespace palpate {
namespace {

std::string text(double value) {
  std::ostringstream shortened;
  shortened << std::setprecision(4) << value;
  return shortened.str();
}

void requireBodies(const Scene& scene, const std::vector<SceneBody>& bodies) {
  if (bodies.size() != scene.models.size())
    throw std::invalid_argument("the scene has " + std::to_string(scene.models.size()) +
                                " models, but there are " + std::to_string(bodies.size()));
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!bodies[i].greens || !bodies[i].mesh)
      throw std::invalid_argument("the scene's model " + std::to_string(i) +
                                  " has no surface or no Green's functions");
  for (const SceneBody& body : bodies) requireTouchable(body);
  for (std::size_t i = 1; i < bodies.size(); ++i)  // contacts slide to any of its vertices
    if (bodies[i].greens->missingCount() > 0)
      throw std::invalid_argument(
          "the scene's model " + std::to_string(i) +
          " meets the first with any of its free vertices and lacks Green's "
          "functions of some: `palpate precompute` without --columns "
          "computes those of all");
}

/// As it hangs under its weight. In linear elasticity, the Green's functions of the body as it was
/// given hold there too.
/// @throws std::invalid_argument if it sags until its surface is none.
std::shared_ptr<const SurfaceMesh> hung(const SceneBody& body, const SceneModel& model,
                                        const Eigen::Vector3d& gravity) {
  const Eigen::Vector3d weight = model.density * (model.pose.orientation.conjugate() * gravity);
  const Eigen::Matrix3Xd sag =
      gravityDisplacement(*body.greens, *body.mesh, body.smoothPatches, weight);
  try {
    return std::make_shared<const SurfaceMesh>(body.mesh->points() + sag, body.mesh->triangles());
  } catch (const std::invalid_argument&) {
    throw std::invalid_argument("under gravity the model sags by " +
                                text(sag.colwise().norm().maxCoeff()) +
                                " m and folds over: lower gravity or density, or stiffen it");
  }
}

/// A tool that is smaller or larger by this is hardly meant: a flat one is a plane.
void requireToFit(double size, const SceneBody& body) {
  constexpr double least = 1e-4, most = 10;
  const double diagonal = body.mesh->diagonal();
  if (size >= least * diagonal && size <= most * diagonal) return;
  throw std::invalid_argument("a tool of " + text(size) + " m does not fit a model of " +
                              text(diagonal) + " m: are both in metres?");
}

/// Radius, of a capsule its length too, or the length of a hand; as large as the body for tools
/// that have no size.
std::vector<double> sizesOf(const SceneTool& tool, const SurfaceMesh* mesh, const SceneBody& body) {
  switch (tool.shape) {
    case ToolShape::Sphere:
      return {tool.radius};
    case ToolShape::Capsule:
      return {tool.radius, std::max(tool.radius, tool.length)};
    case ToolShape::Hand:
      return {tool.length};
    default:
      return {mesh ? mesh->diagonal() : body.mesh->diagonal()};
  }
}

std::shared_ptr<const TouchTool> toolOf(const SceneTool& tool,
                                        const std::shared_ptr<const SurfaceMesh>& mesh) {
  const auto rigid = [](std::shared_ptr<const RigidShape> shape) {
    return std::make_shared<RigidTouchTool>(std::move(shape));
  };
  switch (tool.shape) {
    case ToolShape::Sphere:
      return rigid(std::make_shared<SphereShape>(tool.radius));
    case ToolShape::Capsule:
      return rigid(std::make_shared<CapsuleShape>(
          Eigen::Vector3d::Zero(), tool.length * Eigen::Vector3d::UnitZ(), tool.radius));
    case ToolShape::Plane:
      return rigid(std::make_shared<PlaneShape>());
    case ToolShape::Mesh:
      if (!mesh) throw std::invalid_argument("the tool '" + tool.file + "' has no surface");
      return rigid(std::make_shared<MeshShape>(mesh));
    case ToolShape::Hand:
      return std::make_shared<HandTool>(HandModel(tool.length, tool.side));
    case ToolShape::Point:
      break;
  }
  throw std::invalid_argument("points and tools with a shape do not touch a surface together");
}

/// Radius of a point's pressure mask.
double maskRadiusOf(const SceneEffects& effects, const SurfaceMesh& mesh) {
  return effects.maskRadiusEdges > 0 ? effects.maskRadiusEdges * mesh.meanEdgeLength()
                                     : effects.maskRadius;
}

std::shared_ptr<TouchModel> pointTouch(const Scene& scene, const SceneBody& body) {
  const SceneEffects& effects = scene.effects;
  for (const SceneTool& tool : scene.tools)
    if (tool.shape != ToolShape::Point)
      throw std::invalid_argument("points and tools with a shape do not touch a surface together");
  const double modulus = body.greens->info().material.youngsModulus();
  const auto greens = effects.stiffnessScale == 1
                          ? body.greens
                          : body.greens->withYoungsModulus(effects.stiffnessScale * modulus);
  const auto stiffness = std::make_shared<const SurfaceStiffness>(
      greens, body.mesh, effects.maskShape, maskRadiusOf(effects, *body.mesh),
      effects.stiffnessLimit);
  return std::make_shared<PointTouch>(stiffness, static_cast<int>(scene.tools.size()),
                                      effects.friction);
}

std::shared_ptr<TouchModel> toolTouch(
    const Scene& scene, const std::vector<SceneBody>& bodies,
    const std::vector<std::shared_ptr<const SurfaceMesh>>& toolMeshes) {
  const SceneEffects& effects = scene.effects;
  std::vector<std::shared_ptr<const TouchTool>> tools;
  for (std::size_t i = 0; i < scene.tools.size(); ++i) {
    const auto mesh = i < toolMeshes.size() ? toolMeshes[i] : nullptr;
    for (double size : sizesOf(scene.tools[i], mesh.get(), bodies[0]))
      requireToFit(size, bodies[0]);
    tools.push_back(toolOf(scene.tools[i], mesh));
  }
  std::vector<ElasticPartner> partners;
  for (std::size_t i = 1; i < bodies.size(); ++i)
    partners.push_back(
        {bodies[i].greens, bodies[i].mesh, scene.models[i].pose, scene.models[i].friction});
  UnilateralContactSettings solver = scene.solver;
  solver.rigidStiffness = effects.stiffnessLimit;
  auto touch = std::make_shared<ToolTouch>(bodies[0].greens, bodies[0].mesh, std::move(tools),
                                           effects.friction, solver, partners);
  touch->setTorques(effects.torque);
  touch->setHolds(!effects.unilateral);
  touch->setStiffnessScale(effects.stiffnessScale);
  return touch;
}

/// How deep vertices of a body lie in another, m.
double overlap(const SurfaceMesh& body, const RigidPose& bodyPose, const SurfaceMesh& other,
               const RigidPose& otherPose) {
  if (other.rims() == Rims::Allowed) return 0;
  const SurfaceLocator locator(std::make_shared<const SurfaceMesh>(other));
  double deepest = 0;
  for (int vertex = 0; vertex < body.vertexCount(); ++vertex) {
    const Eigen::Vector3d place = otherPose.toOwn(bodyPose.toWorld(body.points().col(vertex)));
    if (locator.isInside(place))
      deepest = std::max(deepest, (placeOf(other, locator.nearest(place)) - place).norm());
  }
  return deepest;
}

/// Of partners that overlap what is touched before any tool does.
void warnOfOverlaps(const Scene& scene, const std::vector<SceneBody>& bodies,
                    std::vector<std::string>& warnings) {
  constexpr double worthTelling = 1e-3;  // of an edge
  const SurfaceMesh& first = *bodies[0].mesh;
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const SurfaceMesh& other = *bodies[i].mesh;
    const RigidPose& pose = scene.models[i].pose;
    const double depth = std::max(overlap(other, pose, first, {}), overlap(first, {}, other, pose));
    if (depth > worthTelling * first.meanEdgeLength())
      warnings.push_back("the scene's model " + std::to_string(i) + " overlaps the first by " +
                         text(depth) +
                         " m: they press on each other before they are touched; its "
                         "position moves it away");
  }
}

}  // namespace

Eigen::Matrix3Xd placesInside(const Scene& scene) {
  Eigen::Matrix3Xd points(3, scene.effects.probes.size());
  Eigen::Index count = 0;
  for (const SceneProbe& probe : scene.effects.probes)
    if (probe.isInside) points.col(count++) = probe.position;
  return points.leftCols(count);
}

void requireTouchable(const SceneBody& body) {
  if (body.greens->info().domain == Domain::Exterior)
    throw std::invalid_argument(
        "the model's material lies outside its surface, where no tool can be: only models that "
        "`palpate precompute --domain interior` made can be touched");
  const auto free = static_cast<int>(body.greens->info().conditions.freeNodes().size());
  if (free > 0 && body.greens->missingCount() == free)
    throw std::invalid_argument(
        "the model has no Green's functions of free vertices: `palpate precompute` without "
        "--columns computes those of all");
}

std::vector<std::string> warningsOf(const Scene& scene, const std::vector<SceneBody>& bodies) {
  constexpr double coarse = 0.25, coarseMask = 0.5, wideMargin = 2;  // of the mean edge
  std::vector<std::string> warnings;
  const GreensFunctions& greens = *bodies[0].greens;
  if (const int missing = greens.missingCount())
    warnings.push_back("the model has no Green's functions of " + std::to_string(missing) +
                       " of its " + std::to_string(greens.info().conditions.freeNodes().size()) +
                       " free vertices and gives no force near them: " +
                       (greens.info().domain == Domain::Given
                            ? "they are held where its matrix is from, or were left out"
                            : "`palpate precompute` without --columns computes all"));
  const double edge = bodies[0].mesh->meanEdgeLength();
  const auto warnIf = [&](bool isCoarse, const std::string& what, double radius) {
    if (isCoarse)
      warnings.push_back(what + " of radius " + text(radius) +
                         " m is much smaller than the model's edges, " + text(edge) +
                         " m: the force depends on the mesh; `palpate refine` makes it finer");
  };
  warnOfOverlaps(scene, bodies, warnings);
  for (const SceneTool& tool : scene.tools)
    warnIf(tool.radius > 0 && tool.radius < coarse * edge, "a tool", tool.radius);
  const double mask = scene.isOfPoints() ? maskRadiusOf(scene.effects, *bodies[0].mesh) : 0;
  warnIf(mask > 0 && mask < coarseMask * edge, "the pressure mask", mask);
  if (!scene.isOfPoints() && scene.solver.margin > wideMargin * edge)
    warnings.push_back("solver.margin, " + text(scene.solver.margin) +
                       " m, is much wider than the model's edges, " + text(edge) +
                       " m: all vertices so near to a tool are watched, which takes time and the "
                       "room for those that touch; half an edge is the default");
  return warnings;
}

TouchSession::TouchSession(const Scene& scene, const std::vector<SceneBody>& bodies,
                           const std::vector<std::shared_ptr<const SurfaceMesh>>& toolMeshes)
    : bodies_(bodies),
      rows_(scene.effects.deformation),
      stiffnessScale_(scene.effects.stiffnessScale) {
  requireBodies(scene, bodies);
  if (scene.tools.empty())
    throw std::invalid_argument("there is no tool to touch the surface with");
  placeProbes(scene.effects.probes, bodies[0]);
  if (!scene.effects.gravity.isZero(0))
    for (std::size_t i = 0; i < bodies.size(); ++i)
      bodies_[i].mesh = hung(bodies[i], scene.models[i], scene.effects.gravity);
  contact_ =
      scene.isOfPoints() ? pointTouch(scene, bodies_[0]) : toolTouch(scene, bodies_, toolMeshes);
  model_ = contact_;
  if (placesInside(scene).cols() > 0) probeInside(scene);
  if (rows_ == DeformationRows::None) return;
  computed_.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    deformations_.emplace_back(bodies[i].greens, static_cast<int>(i),
                               scene.models[i].pose.orientation);
}

void TouchSession::probeInside(const Scene& scene) {
  if (!bodies_[0].probeRows)
    throw std::invalid_argument(
        "the scene probes the inside of its model, of which there are no rows");
  std::vector<ProbeLimits> limits;
  for (const SceneProbe& probe : scene.effects.probes)
    if (probe.isInside) limits.push_back(probe.limits);
  const auto probed = std::make_shared<ProbedTouch>(contact_, bodies_[0].greens,
                                                    *bodies_[0].probeRows, std::move(limits));
  probed->setStiffnessScale(stiffnessScale_);
  probed_ = probed.get();
  model_ = probed;
}

void TouchSession::setStiffnessScale(double scale) noexcept {
  stiffnessScale_ = scale;
  if (probed_) probed_->setStiffnessScale(scale);
}

void TouchSession::placeProbes(const std::vector<SceneProbe>& probes, const SceneBody& body) {
  if (probes.empty()) return;
  probes_.setZero(3, probes.size());
  probeStarts_.push_back(0);
  int inside = 0;
  for (const SceneProbe& probe : probes) {
    insideNumbers_.push_back(probe.isInside ? inside++ : -1);
    if (probe.isInside) {
      probeStarts_.push_back(static_cast<int>(probeNodes_.size()));
      continue;
    }
    if (probe.node >= body.greens->nodeCount())
      throw std::invalid_argument("the probe '" + probe.name + "' is at node " +
                                  std::to_string(probe.node) + ", but the model has " +
                                  std::to_string(body.greens->nodeCount()) + " nodes");
    if (probe.node >= 0) {
      probeNodes_.push_back(probe.node);
      probeWeights_.push_back(1);
    } else {
      const SurfacePoint point = nearestSurfacePoint(*body.mesh, probe.position);
      const double away = (placeOf(*body.mesh, point) - probe.position).norm();
      if (away > body.mesh->meanEdgeLength())
        throw std::invalid_argument("the probe '" + probe.name + "' lies " + std::to_string(away) +
                                    " m from the surface, on which the displacement is known");
      for (int k = 0; k < 3; ++k) {
        if (point.barycentric[k] == 0) continue;
        probeNodes_.push_back(body.mesh->triangles()(k, point.triangle));
        probeWeights_.push_back(point.barycentric[k]);
      }
    }
    probeStarts_.push_back(static_cast<int>(probeNodes_.size()));
  }
}

/// From all rows if they are there, else at the cost of their own.
void TouchSession::computeProbes(const ContactSnapshot& snapshot) {
  Eigen::Matrix3Xd at = Eigen::Matrix3Xd::Zero(3, probeNodes_.size());
  const bool isKnown = rows_ == DeformationRows::All;
  if (!isKnown) {
    const SnapshotTractions tractions =
        snapshotTractions(greens(), snapshot, 0, Eigen::Matrix3d::Identity(), stiffnessScale_);
    greens().accumulate(nodeList(tractions.nodes), tractions.values, nodeList(probeNodes_),
                        at.reshaped());
  }
  probes_.setZero();
  for (int probe = 0; probe < probes_.cols(); ++probe) {
    if (insideNumbers_[probe] >= 0)
      probes_.col(probe) = snapshot.probes[insideNumbers_[probe]].displacement;
    for (int i = probeStarts_[probe]; i < probeStarts_[probe + 1]; ++i)
      if (!greens().isFixed(probeNodes_[i]))
        probes_.col(probe) += probeWeights_[i] * (isKnown ? displacement(0).col(probeNodes_[i])
                                                          : Eigen::Vector3d(at.col(i)));
  }
}

void TouchSession::computeFrame(const ContactSnapshot& snapshot,
                                const std::vector<std::vector<int>>& visible) {
  for (std::size_t body = 0; body < deformations_.size(); ++body) {
    SnapshotDeformation& deformation = deformations_[body];
    if (rows_ == DeformationRows::All) {
      deformation.computeAll(snapshot, stiffnessScale_);
      continue;
    }
    std::vector<int> rows;
    if (rows_ == DeformationRows::Contact)
      rows = deformation.loadedNodes(snapshot);
    else if (body < visible.size())
      rows = visible[body];
    deformation.clearAt(computed_[body]);
    deformation.computeAt(rows, snapshot, stiffnessScale_);
    computed_[body] = std::move(rows);
  }
  if (probes_.cols() > 0) computeProbes(snapshot);
}

}  // namespace palpate
