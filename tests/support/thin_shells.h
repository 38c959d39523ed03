// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "shell/shell_greens_functions.h"
#include "support/problems.h"
#include "support/shapes.h"

namespace palpate::test {

/// A shell and the reference problem of its middle surface.
struct ShellProblem {
  ElasticModel model;
  ThinShell shell;

  const SurfaceMesh& mesh() const { return model.mesh(); }
  std::shared_ptr<const GreensFunctions> greens(const ShellOptions& options = {}) const {
    return computeShellGreensFunctions(model, shell, options).take();
  }
};

struct ShellMaterial {
  double thickness = 0.01, poissonRatio = 0.3, youngsModulus = 1;
};

/// The model of a shell's middle, fixed where `fixed` says.
ElasticModel shellModel(const Shape& shape, const Place& fixed, const ShellMaterial& material = {});

/// Fixed where `fixed` says.
ShellProblem shellProblem(const Shape& shape, const Place& fixed,
                          const ShellMaterial& material = {}, bool clamped = true);

/// What is held at a place: u_x, u_y, u_z, theta_x, theta_y, theta_z, in these bits from the
/// lowest.
using HeldAt = std::function<unsigned(const Eigen::Vector3d&)>;
constexpr unsigned kUx = 1, kUy = 2, kUz = 4, kTurnX = 8, kTurnY = 16, kTurnZ = 32;
/// On a plane of symmetry with this normal.
constexpr unsigned kMirrorX = kUx | kTurnY | kTurnZ, kMirrorY = kUy | kTurnX | kTurnZ,
                   kMirrorZ = kUz | kTurnX | kTurnY;

/// Held by components; vertices whose whole displacement is held are fixed.
ShellProblem heldShell(const Shape& shape, const HeldAt& held, const ShellMaterial& material);

/// The square [0, 1]^2 of n by n squares, cut along alternating diagonals, mapped into space.
Shape sheetOf(int n, const std::function<Eigen::Vector3d(double, double)>& map);
/// The same of rectangles, along x and along y.
Shape sheetOf(int alongX, int alongY, const std::function<Eigen::Vector3d(double, double)>& map);

/// Displacements, 3 by #V, under these forces (not tractions) at vertices, 3 by #V.
Eigen::Matrix3Xd displacementUnder(const ShellProblem& problem, const Eigen::Matrix3Xd& forces);

/// A component of one free vertex's displacement under them, by Betti's theorem from what a force
/// there does, so that one column is enough.
double displacementAt(const ShellProblem& problem, int vertex, int component,
                      const Eigen::Matrix3Xd& forces);

/// The forces of a traction, the same all over the surface.
Eigen::Matrix3Xd spreadEvenly(const SurfaceMesh& mesh, const Eigen::Vector3d& traction);

/// The vertex nearest to a place.
int vertexNear(const SurfaceMesh& mesh, const Eigen::Vector3d& place);

}  // namespace palpate::test
