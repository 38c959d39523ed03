// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/tetrahedralization.h"

#include <CGAL/make_mesh_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "mesh/cgal_surface.h"
#include "mesh/shells.h"

namespace palpate {
namespace {

using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<CgalKernel, CgalSurface>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index,
                                                        Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

constexpr double kMostTetrahedra = 1e7;
/// Protecting balls of this part of a vertex's shortest edge leave room for its neighbours'.
constexpr double kBallOverEdge = 0.3;
constexpr double kRadiusOverEdge = 2;   // of a tetrahedron: Delaunay refinement ends from 2 on
constexpr double kWantedDihedral = 12;  // degrees
constexpr double kPatience = 10, kPatienceOfVertex = 0.02;  // s
constexpr double kFlatVolume = 1e-9;                       // over the longest edge cubed

/// The size of the protecting ball at each vertex.
struct BallSizes {
  using FT = double;
  using Point_3 = CgalPoint;
  using Index = Domain::Index;

  const std::map<CgalPoint, double>* atVertex;
  double elsewhere;

  double operator()(const CgalPoint& point, int, const Index&) const {
    const auto found = atVertex->find(point);
    return found == atVertex->end() ? elsewhere : found->second;
  }
};

std::map<CgalPoint, double> ballSizes(const SurfaceMesh& surface) {
  Eigen::VectorXd shortest =
      Eigen::VectorXd::Constant(surface.vertexCount(), std::numeric_limits<double>::infinity());
  for (int f = 0; f < surface.triangleCount(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = surface.triangles()(k, f), b = surface.triangles()((k + 1) % 3, f);
      const double length = (surface.points().col(a) - surface.points().col(b)).norm();
      shortest[a] = std::min(shortest[a], length);
      shortest[b] = std::min(shortest[b], length);
    }
  std::map<CgalPoint, double> sizes;
  for (int v = 0; v < surface.vertexCount(); ++v)
    sizes[toCgal(surface.points().col(v))] = kBallOverEdge * shortest[v];
  return sizes;
}

Complex meshed(const SurfaceMesh& surface, double cellSize) {
  namespace parameters = CGAL::parameters;
  CGAL::get_default_random() = CGAL::Random(0);
  const CgalSurface input = toCgal(surface.points(), surface.triangles());
  Domain domain(input);
  std::vector<CgalPoint> corners;
  for (int v = 0; v < surface.vertexCount(); ++v)
    corners.push_back(toCgal(surface.points().col(v)));
  domain.add_corners(corners.begin(), corners.end());
  const std::map<CgalPoint, double> sizes = ballSizes(surface);
  const BallSizes balls{&sizes, kBallOverEdge * surface.meanEdgeLength()};
  const Criteria criteria(parameters::edge_size = balls,
                          parameters::cell_radius_edge_ratio = kRadiusOverEdge,
                          parameters::cell_size = cellSize);
  // On regular meshes exudation can go round and round; where it ends it takes a part of that.
  const double patience = kPatience + kPatienceOfVertex * surface.vertexCount();
  return CGAL::make_mesh_3<Complex>(domain, criteria, parameters::features(domain),
                                    parameters::perturb(parameters::sliver_bound = kWantedDihedral,
                                                        parameters::time_limit = patience),
                                    parameters::exude(parameters::sliver_bound = kWantedDihedral,
                                                      parameters::time_limit = patience));
}

double volumeOverEdges(const Eigen::Matrix3Xd& points, const Eigen::Vector4i& cell) {
  double longest = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j)
      longest = std::max(longest, (points.col(cell[i]) - points.col(cell[j])).norm());
  const auto edge = [&](int k) -> Eigen::Vector3d {
    return (points.col(cell[k]) - points.col(cell[0])) / longest;
  };
  return std::abs(edge(1).cross(edge(2)).dot(edge(3))) / 6;
}

/// Four vertices on one circle may make a cell without volume. Where it has two faces on the
/// boundary it is left out, and the two others, of the same four vertices, are in their place.
void leaveOutFlatOnes(const Eigen::Matrix3Xd& points, Eigen::Matrix4Xi& tetrahedra) {
  const auto face = [&](Eigen::Index cell, int opposite) {
    std::array<int, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = tetrahedra((opposite + 1 + k) % 4, cell);
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  std::vector<Eigen::Index> flat, kept;
  std::map<std::array<int, 3>, int> cellsAt;  // of the faces of flat cells
  for (Eigen::Index t = 0; t < tetrahedra.cols(); ++t)
    if (volumeOverEdges(points, tetrahedra.col(t)) < kFlatVolume) {
      flat.push_back(t);
      for (int k = 0; k < 4; ++k) cellsAt[face(t, k)] = 0;
    }
  if (flat.empty()) return;
  for (Eigen::Index t = 0; t < tetrahedra.cols(); ++t)
    for (int k = 0; k < 4; ++k) {
      const auto found = cellsAt.find(face(t, k));
      if (found != cellsAt.end()) ++found->second;
    }
  const auto hasTwoOuterFaces = [&](Eigen::Index t) {
    int outer = 0;
    for (int k = 0; k < 4; ++k) outer += cellsAt.at(face(t, k)) == 1;
    return outer == 2;
  };
  std::vector<bool> isLeftOut(tetrahedra.cols(), false);
  for (auto next = flat.begin();
       (next = std::find_if(flat.begin(), flat.end(), hasTwoOuterFaces)) != flat.end();
       flat.erase(next)) {
    isLeftOut[*next] = true;
    for (int k = 0; k < 4; ++k) --cellsAt.at(face(*next, k));
  }
  for (Eigen::Index t = 0; t < tetrahedra.cols(); ++t)
    if (!isLeftOut[t]) kept.push_back(t);
  tetrahedra = Eigen::Matrix4Xi(tetrahedra(Eigen::all, kept));
}

/// Points and tetrahedra of a complex, the surface's vertices first, then those of its boundary.
Tetrahedralization numbered(const Complex& complex, const SurfaceMesh& surface) {
  using Handle = Triangulation::Vertex_handle;
  std::map<CgalPoint, int> vertexAt;
  for (int v = 0; v < surface.vertexCount(); ++v) vertexAt[toCgal(surface.points().col(v))] = v;
  std::map<Handle, int> number;
  std::vector<Handle> added;
  const auto place = [](Handle handle) {
    return CgalPoint(handle->point().x(), handle->point().y(), handle->point().z());
  };
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell)
    for (int k = 0; k < 4; ++k) {
      const auto [entry, isNew] = number.emplace(cell->vertex(k), -1);
      if (!isNew) continue;
      const auto known = vertexAt.find(place(entry->first));
      if (known != vertexAt.end())
        entry->second = known->second;
      else
        added.push_back(entry->first);
    }
  std::vector<bool> isKept(surface.vertexCount(), false);
  for (const auto& entry : number)
    if (entry.second >= 0) isKept[entry.second] = true;
  const auto lost = std::find(isKept.begin(), isKept.end(), false);
  if (lost != isKept.end())
    throw std::runtime_error("the surface could not be filled with tetrahedra: its vertex " +
                             std::to_string(lost - isKept.begin()) +
                             " was lost; remesh the surface, or give a volume mesh");
  std::set<Handle> onBoundary;
  for (auto facet = complex.facets_in_complex_begin(); facet != complex.facets_in_complex_end();
       ++facet)
    for (int k = 1; k < 4; ++k) onBoundary.insert(facet->first->vertex((facet->second + k) % 4));
  const auto firstInner = std::stable_partition(
      added.begin(), added.end(), [&](Handle handle) { return onBoundary.count(handle) > 0; });
  Eigen::Matrix3Xd points(3, surface.vertexCount() + static_cast<int>(added.size()));
  points.leftCols(surface.vertexCount()) = surface.points();
  int next = surface.vertexCount();
  for (Handle handle : added) {
    points.col(next) << handle->point().x(), handle->point().y(), handle->point().z();
    number[handle] = next++;
  }
  Eigen::Matrix4Xi tetrahedra(4, complex.number_of_cells_in_complex());
  int t = 0;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end();
       ++cell, ++t)
    for (int k = 0; k < 4; ++k) tetrahedra(k, t) = number[cell->vertex(k)];
  leaveOutFlatOnes(points, tetrahedra);
  return {TetrahedralMesh(std::move(points), std::move(tetrahedra)),
          static_cast<int>(firstInner - added.begin()), 0};
}

int countLost(const Eigen::Matrix3Xi& triangles, const Eigen::Matrix3Xi& boundary) {
  const auto key = [](const auto& triangle) {
    std::array<int, 3> corners{triangle[0], triangle[1], triangle[2]};
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  std::set<std::array<int, 3>> there;
  for (const auto& triangle : boundary.colwise()) there.insert(key(triangle));
  int lost = 0;
  for (const auto& triangle : triangles.colwise()) lost += there.count(key(triangle)) == 0;
  return lost;
}

}  // namespace

Tetrahedralization tetrahedralize(const SurfaceMesh& surface, double cellSize,
                                  const ProgressCallback& callback) {
  const double volume = enclosedVolume(surface.points(), surface.triangles());
  const double regular = 8 * cellSize * cellSize * cellSize / (9 * std::sqrt(3.0));
  if (!(cellSize >= 0) || (cellSize > 0 && volume / regular > kMostTetrahedra)) {
    std::ostringstream text;
    text << "the size of tetrahedra must be 0, or so that they are fewer than ten million, not "
         << cellSize;
    throw std::invalid_argument(text.str());
  }
  const Progress progress(callback);
  progress.report(0, "tetrahedralize");
  Tetrahedralization result = numbered(meshed(surface, cellSize), surface);
  result.lostTriangles = countLost(surface.triangles(), result.mesh.boundary());
  progress.report(1, "tetrahedralize");
  return result;
}

}  // namespace palpate
