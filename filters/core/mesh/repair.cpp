// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/repair.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>

#include "mesh/cgal_surface.h"
#include "mesh/mesh_defects.h"
#include "mesh/surface_mesh.h"

namespace palpate {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
constexpr double kWeldDistance = 1e-9;  // of the diagonal

/// Builds "welded 12 vertices (3, 5, 9, ...)" from the things that one step touched.
class ChangeList {
 public:
  explicit ChangeList(std::vector<std::string>& changes) : changes_(changes) {}
  void add(const std::string& what, const std::string& things, const std::vector<int>& which) {
    if (which.empty()) return;
    std::ostringstream text;
    text << what << " " << which.size() << " " << things << " (";
    for (std::size_t i = 0; i < which.size() && i < 8; ++i) text << (i ? ", " : "") << which[i];
    text << (which.size() > 8 ? ", ...)" : ")");
    changes_.push_back(text.str());
  }

 private:
  std::vector<std::string>& changes_;
};

using Polygon = std::array<std::size_t, 3>;

/// A triangle soup that remembers where its points and triangles come from.
struct Soup {
  std::vector<CgalPoint> points;
  std::vector<int> pointOrigin;
  std::vector<Polygon> triangles;
  std::vector<int> triangleOrigin;
};

bool isUsable(const Eigen::Vector3d& x) {
  return x.allFinite() && x.cwiseAbs().maxCoeff() < 1e100;
}

/// Keeps the triangles whose indices and coordinates can be used, welded, distinct and not
/// collapsed.
Soup cleanSoup(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles,
               ChangeList& changes) {
  Eigen::Matrix3Xd usable = points;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300), high = -low;
  for (Eigen::Index v = 0; v < points.cols(); ++v)
    if (isUsable(points.col(v))) {
      low = low.cwiseMin(points.col(v));
      high = high.cwiseMax(points.col(v));
    }
  const double diagonal = (high - low).norm();
  for (Eigen::Index v = 0; v < points.cols(); ++v)  // out of the way, each at a place of its own
    if (!isUsable(points.col(v)))
      usable.col(v) = high + Eigen::Vector3d::Constant((v + 1) * (diagonal + 1));
  const std::vector<int> twin = nearestDuplicates(usable, kWeldDistance * diagonal);

  Soup soup;
  std::vector<int> unusable, collapsed, repeated, welded, unused;
  std::vector<int> number(points.cols(), -1);
  std::set<Polygon> seen;
  for (Eigen::Index f = 0; f < triangles.cols(); ++f) {
    const Eigen::Vector3i t = triangles.col(f);
    if (t.minCoeff() < 0 || t.maxCoeff() >= points.cols() || !isUsable(points.col(t[0])) ||
        !isUsable(points.col(t[1])) || !isUsable(points.col(t[2]))) {
      unusable.push_back(static_cast<int>(f));
      continue;
    }
    const Eigen::Vector3i w(twin[t[0]], twin[t[1]], twin[t[2]]);
    if (w[0] == w[1] || w[1] == w[2] || w[2] == w[0]) {
      collapsed.push_back(static_cast<int>(f));
      continue;
    }
    Polygon key{std::size_t(w[0]), std::size_t(w[1]), std::size_t(w[2])};
    std::sort(key.begin(), key.end());
    if (!seen.insert(key).second) {
      repeated.push_back(static_cast<int>(f));
      continue;
    }
    Polygon polygon;
    for (int k = 0; k < 3; ++k) {
      if (w[k] != t[k]) welded.push_back(t[k]);
      if (number[w[k]] < 0) {
        number[w[k]] = static_cast<int>(soup.points.size());
        soup.points.push_back(toCgal(points.col(w[k])));
        soup.pointOrigin.push_back(w[k]);
      }
      polygon[k] = number[w[k]];
    }
    soup.triangles.push_back(polygon);
    soup.triangleOrigin.push_back(static_cast<int>(f));
  }
  std::sort(welded.begin(), welded.end());
  welded.erase(std::unique(welded.begin(), welded.end()), welded.end());
  for (Eigen::Index v = 0; v < points.cols(); ++v)
    if (number[v] < 0 && !std::binary_search(welded.begin(), welded.end(), int(v)))
      unused.push_back(static_cast<int>(v));
  changes.add("dropped", "triangles with unusable indices or coordinates", unusable);
  changes.add("welded", "vertices to another at the same place", welded);
  changes.add("dropped", "triangles with a repeated vertex", collapsed);
  changes.add("dropped", "triangles that repeat another", repeated);
  changes.add("dropped", "unused vertices", unused);
  return soup;
}

/// Records what orient_polygon_soup does, in the numbers of the input.
struct OrientationVisitor : PMP::Default_orientation_visitor {
  Soup& soup;
  std::vector<int>&turned, &split;
  OrientationVisitor(Soup& s, std::vector<int>& t, std::vector<int>& d)
      : soup(s), turned(t), split(d) {}
  void polygon_orientation_reversed(std::size_t f) { turned.push_back(soup.triangleOrigin[f]); }
  void duplicated_vertex(std::size_t from, std::size_t) {
    split.push_back(soup.pointOrigin[from]);
    soup.pointOrigin.push_back(soup.pointOrigin[from]);
  }
};

/// Turned triangles count as turned only against the majority: a wholly reversed soup is put right
/// by the last step.
void orient(Soup& soup, ChangeList& changes, std::vector<int>& turned) {
  std::vector<int> split;
  OrientationVisitor visitor(soup, turned, split);
  PMP::orient_polygon_soup(soup.points, soup.triangles, CGAL::parameters::visitor(visitor));
  changes.add("split", "vertices where the surface was not a manifold", split);
}

/// Closes holes by triangles between their border's vertices.
void fillHoles(CgalSurface& surface, ChangeList& changes) {
  std::vector<CgalSurface::Halfedge_index> borders;
  std::vector<bool> seen(surface.num_halfedges() + surface.number_of_removed_edges() * 2, false);
  std::vector<int> lengths;
  for (CgalSurface::Halfedge_index h : surface.halfedges()) {
    if (!surface.is_border(h) || seen[h.idx()]) continue;
    borders.push_back(h);
    int length = 0;
    CgalSurface::Halfedge_index step = h;
    do {
      seen[step.idx()] = true;
      ++length;
      step = surface.next(step);
    } while (step != h);
    lengths.push_back(length);
  }
  for (CgalSurface::Halfedge_index h : borders) {
    std::vector<CgalSurface::Face_index> patch;
    PMP::triangulate_hole(surface, h, std::back_inserter(patch));
  }
  changes.add("filled", "holes, with borders of so many edges", lengths);
}

std::vector<int> intersectingTriangles(const CgalSurface& surface) {
  std::vector<std::pair<CgalSurface::Face_index, CgalSurface::Face_index>> pairs;
  PMP::self_intersections(surface, std::back_inserter(pairs));
  std::set<int> faces;
  for (const auto& [a, b] : pairs) faces.insert({int(a.idx()), int(b.idx())});
  return {faces.begin(), faces.end()};
}

std::vector<int> degenerateTriangles(const CgalSurface& surface) {
  std::vector<int> faces;
  for (CgalSurface::Face_index f : surface.faces())
    if (PMP::is_degenerate_triangle_face(f, surface)) faces.push_back(static_cast<int>(f.idx()));
  return faces;
}

std::vector<int> inOriginalNumbers(const std::vector<int>& triangles, const Soup& soup) {
  std::vector<int> original;
  for (int f : triangles)
    original.push_back(f < int(soup.triangleOrigin.size()) ? soup.triangleOrigin[f] : -1);
  return original;
}

void mend(CgalSurface& surface, const Soup& soup, std::vector<int> turned, ChangeList& changes,
          const Progress& progress) {
  const std::size_t stitched = PMP::stitch_borders(surface);
  if (stitched) changes.add("stitched", "pairs of border edges", std::vector<int>(stitched, 0));
  progress.report(0.3, "repair");
  const std::vector<int> degenerate = degenerateTriangles(surface);
  if (!degenerate.empty()) {
    PMP::remove_degenerate_faces(surface);
    changes.add("collapsed", "degenerate triangles", inOriginalNumbers(degenerate, soup));
  }
  progress.report(0.4, "repair");
  fillHoles(surface, changes);
  progress.report(0.6, "repair");
  const std::vector<int> crossing = intersectingTriangles(surface);
  if (!crossing.empty()) {
    PMP::experimental::remove_self_intersections(surface);
    fillHoles(surface, changes);
    changes.add("rebuilt the surface at", "triangles that cut through each other",
                inOriginalNumbers(crossing, soup));
  }
  progress.report(0.8, "repair");

  std::vector<CgalPoint> before;
  CgalSurface reference = surface;
  if (CGAL::is_closed(surface)) PMP::orient_to_bound_a_volume(surface);
  std::set<int> reversed(turned.begin(), turned.end());
  for (CgalSurface::Face_index f : surface.faces()) {
    const auto firstOf = [](const CgalSurface& s, CgalSurface::Face_index face) {
      return s.target(s.halfedge(face));
    };
    // A face is reversed if its cycle runs the other way round than before.
    const auto h = surface.halfedge(f);
    const auto a = surface.source(h), b = surface.target(h);
    auto r = reference.halfedge(f);
    bool same = false;
    for (int k = 0; k < 3; ++k, r = reference.next(r))
      same = same || (reference.source(r) == a && reference.target(r) == b);
    (void)firstOf;
    if (same || f.idx() >= soup.triangleOrigin.size()) continue;
    const int original = soup.triangleOrigin[f.idx()];
    if (!reversed.erase(original)) reversed.insert(original);
  }
  changes.add("turned", "triangles round", {reversed.begin(), reversed.end()});
}

RepairedSurface extract(const CgalSurface& surface, const Soup& soup) {
  RepairedSurface out;
  std::vector<int> number(surface.num_vertices() + surface.number_of_removed_vertices(), -1);
  out.points.resize(3, surface.number_of_vertices());
  out.triangles.resize(3, surface.number_of_faces());
  int count = 0;
  for (CgalSurface::Vertex_index v : surface.vertices()) {
    if (surface.is_isolated(v)) continue;
    number[v.idx()] = count;
    const CgalPoint& x = surface.point(v);
    out.points.col(count++) << x.x(), x.y(), x.z();
    const bool known = v.idx() < soup.pointOrigin.size();
    out.originalVertex.push_back(known ? soup.pointOrigin[v.idx()] : -1);
  }
  out.points.conservativeResize(3, count);
  int face = 0;
  for (CgalSurface::Face_index f : surface.faces()) {
    int k = 0;
    for (CgalSurface::Vertex_index v : surface.vertices_around_face(surface.halfedge(f)))
      out.triangles(k++, face) = number[v.idx()];
    ++face;
    const bool known = f.idx() < soup.triangleOrigin.size();
    out.originalTriangle.push_back(known ? soup.triangleOrigin[f.idx()] : -1);
  }
  return out;
}

bool isSound(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles) {
  if (!findMeshDefects(points, triangles, 1).empty()) return false;
  try {
    return findSelfIntersections(SurfaceMesh(points, triangles), 1).empty();
  } catch (const std::invalid_argument&) {
    return false;  // inside out
  }
}

}  // namespace

RepairedSurface repairSurface(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles,
                              const ProgressCallback& callback) {
  const Progress progress(callback);
  RepairedSurface result;
  if (isSound(points, triangles)) {
    result.points = points;
    result.triangles = triangles;
    for (Eigen::Index v = 0; v < points.cols(); ++v) result.originalVertex.push_back(int(v));
    for (Eigen::Index f = 0; f < triangles.cols(); ++f) result.originalTriangle.push_back(int(f));
    progress.report(1, "repair");
    return result;
  }
  progress.report(0.1, "repair");
  std::vector<std::string> changes;
  ChangeList list(changes);
  Soup soup = cleanSoup(points, triangles, list);
  std::vector<int> turned;
  if (!soup.triangles.empty()) orient(soup, list, turned);
  progress.report(0.2, "repair");
  CgalSurface surface;
  PMP::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, surface);
  mend(surface, soup, turned, list, progress);
  result = extract(surface, soup);
  result.changes = std::move(changes);
  requireNoDefect(findMeshDefects(result.points, result.triangles, 1));
  requireNoDefect(findSelfIntersections(SurfaceMesh(result.points, result.triangles), 1));
  progress.report(1, "repair");
  return result;
}

}  // namespace palpate
