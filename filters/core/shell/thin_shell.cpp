// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shell/thin_shell.h"

#include <cmath>
#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "model/support.h"
#include "sentence.h"

namespace palpate {
namespace {

void requireThickness(const SurfaceMesh& mesh, const Eigen::VectorXd& thickness, Eigen::Index count,
                      const char* place) {
  if (thickness.size() != count)
    refuse("there are ", thickness.size(), " thicknesses for ", count, " of the surface, one a ",
           place);
  for (Eigen::Index i = 0; i < count; ++i) {
    if (!(thickness[i] > 0) || !std::isfinite(thickness[i]))
      refuse("the thickness at ", place, " ", i, " must be a positive number, not ", thickness[i]);
    if (thickness[i] > mesh.diagonal())
      refuse("the thickness at ", place, " ", i, ", ", thickness[i],
             ", is more than the whole surface is wide (", mesh.diagonal(),
             "): that is no shell; is it in the unit of the points?");
  }
}

/// What is held of one piece of the surface.
struct Support {
  std::vector<Eigen::Vector3d> points, directions, axes;
  Eigen::AlignedBox3d box;
  int firstVertex = -1;
};

Eigen::Matrix3Xd matrixOf(const std::vector<Eigen::Vector3d>& vectors) {
  Eigen::Matrix3Xd matrix(3, vectors.size());
  for (std::size_t i = 0; i < vectors.size(); ++i) matrix.col(i) = vectors[i];
  return matrix;
}

void requireHeld(const SurfaceMesh& mesh, const HeldComponents& held) {
  std::vector<Support> supports(mesh.bodyCount());
  for (int v = 0; v < mesh.vertexCount(); ++v) {
    Support& support = supports[mesh.bodyOfVertex(v)];
    if (support.firstVertex < 0) support.firstVertex = v;
    support.box.extend(mesh.points().col(v));
    for (int k = 0; k < 3; ++k) {
      if (held(3 + k, v)) support.axes.push_back(Eigen::Vector3d::Unit(k));
      if (!held(k, v)) continue;
      support.points.push_back(mesh.points().col(v));
      support.directions.push_back(Eigen::Vector3d::Unit(k));
    }
  }
  for (const Support& support : supports) {
    const RigidMotion motion =
        leastResistedMotion(matrixOf(support.points), matrixOf(support.directions),
                            support.box.diagonal().norm(), matrixOf(support.axes));
    if (motion.resistance >= kSmallestResistance) continue;
    const std::string piece = sentence("the piece of the shell with vertex ", support.firstVertex);
    const std::string left = sentence(" free (", motion.describe(), "): ");
    if (support.points.empty() && support.axes.empty())
      refuse(piece, " is not held anywhere, which leaves a rigid motion", left,
             "fix vertices, clamped or three that are not on one line, or make the shell "
             "unsupported");
    refuse("what is held of ", piece, " leaves a rigid motion", left,
           "clamp its fixed vertices, or fix three that are not on one line");
  }
}

}  // namespace

HeldComponents heldComponents(const BoundaryConditions& conditions, bool clamped) {
  HeldComponents held = HeldComponents::Constant(6, conditions.nodeCount(), false);
  for (int v : conditions.fixedNodes()) held.col(v).head(clamped ? 6 : 3) = true;
  return held;
}

bool areRotationsHeld(const BoundaryConditions& conditions, const HeldComponents& held) {
  for (int v : conditions.fixedNodes())
    if (!held.col(v).tail<3>().all()) return false;
  return true;
}

Eigen::Matrix3Xd thicknessOfVertices(const SurfaceMesh& mesh, const Eigen::VectorXd& thickness) {
  requireThickness(mesh, thickness, mesh.vertexCount(), "vertex");
  Eigen::Matrix3Xd atCorners(3, mesh.triangleCount());
  for (int f = 0; f < mesh.triangleCount(); ++f)
    for (int k = 0; k < 3; ++k) atCorners(k, f) = thickness[mesh.triangles()(k, f)];
  return atCorners;
}

Eigen::Matrix3Xd thicknessOfTriangles(const SurfaceMesh& mesh, const Eigen::VectorXd& thickness) {
  requireThickness(mesh, thickness, mesh.triangleCount(), "triangle");
  return thickness.transpose().replicate<3, 1>();
}

ThinShell::ThinShell(const ElasticModel& model, Eigen::Matrix3Xd thickness, HeldComponents held)
    : thickness_(std::move(thickness)), held_(std::move(held)), isClamped_(false) {
  const SurfaceMesh& mesh = model.mesh();
  if (model.domain() != Domain::Shell) refuse("the model's surface is not the middle of a shell");
  if (thickness_.cols() != mesh.triangleCount())
    refuse("there are thicknesses of ", thickness_.cols(), " triangles, the surface has ",
           mesh.triangleCount());
  for (int f = 0; f < mesh.triangleCount(); ++f)
    if (!(thickness_.col(f).minCoeff() > 0) || !thickness_.col(f).allFinite())
      refuse("the thickness at triangle ", f, " must be a positive number, not ",
             thickness_.col(f).minCoeff());
  if (held_.cols() != mesh.vertexCount())
    refuse("there are held components of ", held_.cols(), " vertices, the surface has ",
           mesh.vertexCount());
  for (int v = 0; v < mesh.vertexCount(); ++v) {
    const bool isFixed = model.conditions().isFixed(v);
    if (held_.col(v).head<3>().all() != isFixed)
      refuse("vertex ", v, " is ",
             isFixed ? "fixed, but its displacement is not held"
                     : "free, but its whole displacement is held: fix it");
  }
  isClamped_ = areRotationsHeld(model.conditions(), held_);
  requireHeld(mesh, held_);
}

ThinShell::ThinShell(const ElasticModel& model, Eigen::Matrix3Xd thickness, bool clamped)
    : ThinShell(model, std::move(thickness), heldComponents(model.conditions(), clamped)) {}

std::uint64_t ThinShell::fingerprint(const ElasticModel& model) const {
  return shellFingerprint(model.fingerprint(), thickness_, held_);
}

std::uint64_t shellFingerprint(std::uint64_t ofModel, const Eigen::Matrix3Xd& thickness,
                               const HeldComponents& held) {
  return Fingerprint()
      .add(&ofModel, sizeof ofModel)
      .add(thickness.data(), sizeof(double) * thickness.size())
      .add(held.data(), sizeof(bool) * held.size())
      .value();
}

}  // namespace palpate
