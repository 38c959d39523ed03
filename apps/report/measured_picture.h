// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "picture/picture.h"
#include "report/measured_data.h"

namespace palpate::app {

/// A force that one might measure under, too.
struct ProposedProbe {
  PlaceOnSurface at;
  Eigen::Vector3d force;  ///< on the body, N
  std::string name;
};

/// An arrow of a force, whose tip is on the surface where it pushes and whose foot is where it
/// pulls.
/// @param share  of the strongest force beside it.
Glyph forceArrow(const PlaceOnSurface& at, const Eigen::Vector3d& force, double share,
                 double diagonal);

/// The surface with probes and markers, coloured by the root mean square of their residuals'
/// components, from one side or from two where one does not show all. Outliers have red rings, and
/// do not count.
/// @param model  outlives the picture.
Picture measuredPicture(vtkPolyData* model, const MeasuredData& data,
                        const std::vector<ProposedProbe>& proposed);

}  // namespace palpate::app
