// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>
#include <vector>

#include "support/shapes.h"

namespace palpate::test {

/// One of the control meshes in data/.
struct DataModel {
  Shape shape;
  std::vector<unsigned char> boundaryTypes;
  double youngsModulus, poissonRatio;
};

/// Reads data/<name>.vtp, whose arrays are plain text, without VTK.
/// @param name  "nodule", "kidney", "spatula" or "banana_seat".
DataModel readDataModel(const std::string& name);

}  // namespace palpate::test
