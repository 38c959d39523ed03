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

}  // namespace palpate::shell
