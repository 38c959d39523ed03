// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>
#include <vector>

#include "shell/thin_shell.h"

namespace palpate::shell {

/// Sentences, each with its measured number, about what makes a shell's answers doubtful: where it
/// is thick beside its size, its radius of curvature or its edges, where a clamped piece is held at
/// few vertices, and where it is so thin that rounding shows.
std::vector<std::string> shellWarnings(const ElasticModel& model, const ThinShell& shell,
                                       double rigidMotionDefect);

/// The last of these.
/// @param rigidMotionDefect  negative where there is no solution.
std::string roundingSentence(const ElasticModel& model, const ThinShell& shell,
                             double rigidMotionDefect);

/// #F: size of the mean curvature (1 / R1 + 1 / R2) / 2 of the surface around each triangle's
/// corners, from the angles between the triangles at their edges; zero where these are folds, of
/// more than 30 degrees.
Eigen::VectorXd meanCurvatures(const SurfaceMesh& mesh);

}  // namespace palpate::shell
