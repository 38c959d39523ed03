// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "mesh/cgal_surface.h"
#include "mesh/mesh_defects.h"
#include "mesh/surface_mesh.h"

namespace palpate {

std::vector<MeshDefect> findSelfIntersections(const SurfaceMesh& mesh, std::size_t largestCount) {
  const CgalSurface surface = toCgal(mesh.points(), mesh.triangles());
  std::vector<std::pair<CgalSurface::Face_index, CgalSurface::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(pairs));
  for (auto& [a, b] : pairs)
    if (b < a) std::swap(a, b);
  std::sort(pairs.begin(), pairs.end());
  std::vector<MeshDefect> defects;
  for (const auto& [a, b] : pairs) {
    if (defects.size() == largestCount) break;
    std::ostringstream text;
    text << "triangles " << a.idx() << " and " << b.idx() << " cut through each other ("
         << pairs.size() << (pairs.size() == 1 ? " such pair)" : " such pairs)");
    defects.push_back(
        describeDefect(MeshDefectKind::SelfIntersection, static_cast<int>(a.idx()), text.str()));
  }
  return defects;
}

}  // namespace palpate
