// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/point_load.h"

#include <map>

namespace palpate {

SpreadForce pointLoad(const VertexMasks& masks, const SurfaceMesh& mesh,
                      const BoundaryConditions& conditions, const SurfacePoint& point) {
  std::map<int, double> density;
  for (int k = 0; k < 3; ++k) {
    const int vertex = mesh.triangles()(k, point.triangle);
    if (point.barycentric[k] == 0 || conditions.isFixed(vertex)) continue;
    const VertexMask mask = masks.at(vertex);
    for (std::size_t j = 0; j < mask.nodes.size(); ++j)
      density[mask.nodes[j]] += point.barycentric[k] * mask.density[j];
  }
  SpreadForce load;
  load.density.resize(density.size());
  for (const auto& [node, value] : density) {
    load.density[load.nodes.size()] = value;
    load.nodes.push_back(node);
  }
  return load;
}

}  // namespace palpate
