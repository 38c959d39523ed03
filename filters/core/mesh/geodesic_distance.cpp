// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/geodesic_distance.h"

#include <CGAL/Heat_method_3/Surface_mesh_geodesic_distances_3.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <queue>
#include <stdexcept>
#include <string>

#include "mesh/cgal_surface.h"

namespace palpate {
namespace {

using HeatMethod =
    CGAL::Heat_method_3::Surface_mesh_geodesic_distances_3<CgalSurface,
                                                           CGAL::Heat_method_3::Intrinsic_Delaunay>;

constexpr double kUnreached = std::numeric_limits<double>::infinity();

/// The shortest ways along edges (Dijkstra), #V.
Eigen::VectorXd distancesAlongEdges(const SurfaceMesh& mesh, int source) {
  using Entry = std::pair<double, int>;
  Eigen::VectorXd distance = Eigen::VectorXd::Constant(mesh.vertexCount(), kUnreached);
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> next;
  distance[source] = 0;
  next.push({0, source});
  while (!next.empty()) {
    const auto [soFar, v] = next.top();
    next.pop();
    if (soFar > distance[v]) continue;
    for (int f : mesh.trianglesOfVertex(v))
      for (int k = 0; k < 3; ++k) {
        const int u = mesh.triangles()(k, f);
        const double way = soFar + (mesh.points().col(u) - mesh.points().col(v)).norm();
        if (way < distance[u]) {
          distance[u] = way;
          next.push({way, u});
        }
      }
  }
  return distance;
}

}  // namespace

/// The heat method's matrices of one shell: it cannot do with surfaces in several pieces.
struct GeodesicDistances::Shell {
  std::vector<int> vertices;  ///< of the mesh
  CgalSurface surface;
  std::unique_ptr<HeatMethod> heat;
  std::mutex mutex;
};

GeodesicDistances::GeodesicDistances(const SurfaceMesh& mesh)
    : mesh_(mesh), indexInShell_(mesh.vertexCount()) {
  for (int s = 0; s < mesh.shellCount(); ++s) shells_.push_back(std::make_unique<Shell>());
  for (int v = 0; v < mesh.vertexCount(); ++v) {
    Shell& shell = *shells_[mesh.shellOfVertex(v)];
    indexInShell_[v] = static_cast<int>(shell.vertices.size());
    shell.vertices.push_back(v);
    shell.surface.add_vertex(toCgal(mesh.points().col(v)));
  }
  using Vertex = CgalSurface::Vertex_index;
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    const Eigen::Vector3i corners = mesh.triangles().col(f);
    shells_[mesh.shellOfVertex(corners[0])]->surface.add_face(Vertex(indexInShell_[corners[0]]),
                                                              Vertex(indexInShell_[corners[1]]),
                                                              Vertex(indexInShell_[corners[2]]));
  }
  try {
    for (const auto& shell : shells_) shell->heat = std::make_unique<HeatMethod>(shell->surface);
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string("the heat method cannot factor this surface: ") +
                             error.what());
  }
}

GeodesicDistances::~GeodesicDistances() = default;

Eigen::VectorXd GeodesicDistances::from(int vertex) const {
  if (vertex < 0 || vertex >= mesh_.vertexCount())
    throw std::invalid_argument("there is no vertex " + std::to_string(vertex) +
                                " to measure distances from");
  Eigen::VectorXd distance = distancesAlongEdges(mesh_, vertex);
  Shell& shell = *shells_[mesh_.shellOfVertex(vertex)];
  std::vector<double> heat(shell.vertices.size());
  {
    const std::lock_guard<std::mutex> lock(shell.mutex);
    const CgalSurface::Vertex_index source(indexInShell_[vertex]);
    auto property = shell.surface.add_property_map<CgalSurface::Vertex_index, double>("d").first;
    shell.heat->add_source(source);
    shell.heat->estimate_geodesic_distances(property);
    shell.heat->remove_source(source);
    for (std::size_t i = 0; i < heat.size(); ++i)
      heat[i] = property[CgalSurface::Vertex_index(static_cast<unsigned>(i))];
  }
  for (std::size_t i = 0; i < heat.size(); ++i) {
    const int v = shell.vertices[i];
    if (!std::isfinite(heat[i])) continue;  // the heat has died out on its way: along edges then
    const double straight = (mesh_.points().col(v) - mesh_.points().col(vertex)).norm();
    distance[v] = std::min(distance[v], std::max(straight, heat[i]));
  }
  return distance;
}

}  // namespace palpate
