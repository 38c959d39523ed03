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
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "mesh/cgal_surface.h"
#include "mesh/flat_cells.h"
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

/// Whether vertices are corners of faces that only one cell has.
std::vector<bool> boundaryVertices(int count, const Eigen::Matrix4Xi& tetrahedra) {
  std::map<std::array<int, 3>, int> cellsAt;
  for (const auto& cell : tetrahedra.colwise())
    for (int k = 0; k < 4; ++k) {
      std::array<int, 3> face{cell[(k + 1) % 4], cell[(k + 2) % 4], cell[(k + 3) % 4]};
      std::sort(face.begin(), face.end());
      ++cellsAt[face];
    }
  std::vector<bool> isOuter(count, false);
  for (const auto& [face, cells] : cellsAt)
    for (int vertex : face) isOuter[vertex] = isOuter[vertex] || cells == 1;
  return isOuter;
}

/// Puts the points behind the first so many in order: those on the boundary before the others.
/// @return how many of them are on the boundary.
int orderAdded(int first, Eigen::Matrix3Xd& points, Eigen::Matrix4Xi& tetrahedra) {
  const std::vector<bool> isOuter = boundaryVertices(static_cast<int>(points.cols()), tetrahedra);
  std::vector<int> order(points.cols());
  std::iota(order.begin(), order.end(), 0);
  const auto firstInner =
      std::stable_partition(order.begin() + first, order.end(), [&](int v) { return isOuter[v]; });
  std::vector<int> number(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) number[order[i]] = static_cast<int>(i);
  points = Eigen::Matrix3Xd(points(Eigen::all, order));
  for (int& vertex : tetrahedra.reshaped()) vertex = number[vertex];
  return static_cast<int>(firstInner - order.begin()) - first;
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
  removeFlatCells(points, tetrahedra);
  const int newOnBoundary = orderAdded(surface.vertexCount(), points, tetrahedra);
  try {
    return {TetrahedralMesh(std::move(points), std::move(tetrahedra)), newOnBoundary, 0};
  } catch (const std::invalid_argument& failure) {
    throw std::runtime_error(
        "the surface could not be filled with tetrahedra: " + std::string(failure.what()) +
        "; remesh the surface, or give a volume mesh");
  }
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
