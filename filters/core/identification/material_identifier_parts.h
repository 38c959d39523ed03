// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vector>

#include "identification/material_identification.h"
#include "identification/material_model.h"

namespace palpate {

/// What a MaterialIdentifier holds, for its own sources.
struct MaterialIdentifier::Parts {
  IdentificationOptions options;
  std::vector<Eigen::Vector3d> normals;
  Eigen::Matrix3Xd places;
  MaterialModel model;
};

}  // namespace palpate
