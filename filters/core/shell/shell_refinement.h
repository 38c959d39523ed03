// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "diagnostics.h"
#include "greens/greens_functions.h"
#include "mesh/subdivision.h"
#include "progress.h"
#include "shell/thin_shell.h"

namespace palpate {

/// The thickness at the corners of a finer mesh's triangles, linear between those of the coarser.
/// @param level   of a mesh with these triangles.
/// @param coarse  3 by #F.
Eigen::Matrix3Xd refineThickness(const SubdivisionLevel& level, const Eigen::Matrix3Xi& coarse,
                                 const Eigen::Matrix3Xd& thickness);

/// What is held of a finer mesh: a new vertex as both ends of its edge are.
HeldComponents refineHeldComponents(const SubdivisionLevel& level, const HeldComponents& held);

/// How wrong the answers of a shell's Green's functions are: it is solved on a mesh of half as long
/// edges (subdivideCurved), too, and errors are taken to go with the edges. They do where supports
/// are points or end in corners; elsewhere they fall faster, and the estimate is too large by up to
/// a half. Costs sixteen times as much as the shell's own columns. Unknown (-1) beyond a thousand
/// vertices, or where columns are missing or the finer mesh has defects.
ErrorEstimate estimateShellError(const ElasticModel& model, const ThinShell& shell,
                                 const GreensFunctions& greens, const Progress& progress = {});

}  // namespace palpate
