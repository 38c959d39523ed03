// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

#include "mesh/surface_mesh.h"

namespace palpate::shell {

/// Edges whose triangles' normals differ by more than this are folds, of less are chords of a
/// curved surface.
constexpr double kFold = 0.5235987755982988;  // 30 degrees

/// #F: the largest angle, radians, between normals across the edges at each triangle's corners,
/// folds left out.
Eigen::VectorXd inclinations(const SurfaceMesh& mesh);

/// #F: size of the mean curvature (1 / R1 + 1 / R2) / 2 of the surface around each triangle's
/// corners, from the angles between the triangles at their edges; zero where any of these is a
/// fold.
Eigen::VectorXd meanCurvatures(const SurfaceMesh& mesh);

}  // namespace palpate::shell
