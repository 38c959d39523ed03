// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>
#include <vector>

#include "model/elastic_model.h"
#include "support/data_models.h"

namespace palpate::test {

/// Loop's levels of a control mesh from data/, moved so that they enclose what their limit does, the
/// support a patch of its own, with layers along its rim.
class LoopHierarchy {
 public:
  /// @param name  as readDataModel.
  explicit LoopHierarchy(const std::string& name);

  ElasticModel operator()(int level, int layers = 0);

 private:
  struct Mesh {
    Shape shape;
    std::vector<unsigned char> boundaryTypes;
  };
  DataModel base_;
  std::vector<Mesh> meshes_;
};

}  // namespace palpate::test
