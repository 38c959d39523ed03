// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/repair.h"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/merge_border_vertices.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>

#include "mesh/cgal_surface.h"
#include "mesh/mesh_defects.h"
#include "mesh/shells.h"
#include "mesh/surface_mesh.h"
#include "mesh/triangle_soup.h"

namespace palpate {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Vertex = CgalSurface::Vertex_index;
using Halfedge = CgalSurface::Halfedge_index;
using Face = CgalSurface::Face_index;

/// A surface under repair; new vertices and faces get the origin -1.
struct Surface {
  CgalSurface mesh;
  CgalSurface::Property_map<Vertex, int> vertexOrigin;
  CgalSurface::Property_map<Face, int> faceOrigin;

  Surface()
      : vertexOrigin(mesh.add_property_map<Vertex, int>("v:origin", -1).first),
        faceOrigin(mesh.add_property_map<Face, int>("f:origin", -1).first) {}
  Eigen::Vector3d point(Vertex v) const {
    const CgalPoint& x = mesh.point(v);
    return {x.x(), x.y(), x.z()};
  }
  std::array<Vertex, 3> corners(Face f) const {
    const Halfedge h = mesh.halfedge(f);
    return {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))};
  }
};

/// Records the points that orient_polygon_soup copies.
struct CopyRecorder : PMP::Default_orientation_visitor {
  std::vector<int>& original;
  explicit CopyRecorder(std::vector<int>& list) : original(list) {}
  void duplicated_vertex(std::size_t from, std::size_t) { original.push_back(original[from]); }
};

/// Turns the triangles of each piece the same way round, and copies vertices at which several
/// sheets of a piece touch.
void orient(TriangleSoup& soup) {
  std::vector<int> original(soup.points.size());
  std::iota(original.begin(), original.end(), 0);
  PMP::orient_polygon_soup(soup.points, soup.triangles,
                           CGAL::parameters::visitor(CopyRecorder(original)));
  for (std::size_t v = soup.vertexOrigin.size(); v < original.size(); ++v)
    soup.vertexOrigin.push_back(soup.vertexOrigin[original[v]]);
  requireTwoSided(soup, original);
}

/// @param soup  oriented.
void build(Surface& surface, const TriangleSoup& soup) {
  std::vector<CgalPoint> points;
  for (const Eigen::Vector3d& x : soup.points) points.push_back(toCgal(x));
  PMP::polygon_soup_to_polygon_mesh(points, soup.triangles, surface.mesh);
  for (Vertex v : surface.mesh.vertices()) surface.vertexOrigin[v] = soup.vertexOrigin[v.idx()];
  for (Face f : surface.mesh.faces()) surface.faceOrigin[f] = soup.triangleOrigin[f.idx()];
  // Where two holes met in a vertex, orientation made one hole and two vertices of them.
  PMP::merge_duplicated_vertices_in_boundary_cycles(surface.mesh);
}

/// Triangles from one vertex of a hole's border to its edges, if that doubles no edge.
bool fillWithFan(CgalSurface& mesh, const std::vector<Vertex>& border) {
  const std::size_t count = border.size();
  for (std::size_t tip = 0; tip < count; ++tip) {
    const auto vertex = [&](std::size_t i) { return border[(tip + i) % count]; };
    bool isFree = true;
    for (std::size_t i = 2; i + 1 < count; ++i)
      isFree = isFree && !mesh.halfedge(vertex(0), vertex(i)).is_valid();
    if (!isFree) continue;
    for (std::size_t i = 1; i + 1 < count; ++i) mesh.add_face(vertex(0), vertex(i), vertex(i + 1));
    return true;
  }
  return false;
}

/// Closes holes by triangles between their border's vertices.
void fillHoles(Surface& surface, ChangeList& changes) {
  constexpr std::size_t longestForCubicSearch = 200;
  std::vector<Halfedge> holes;
  PMP::extract_boundary_cycles(surface.mesh, std::back_inserter(holes));
  for (Halfedge hole : holes) {
    std::vector<Vertex> border;
    for (Vertex v : surface.mesh.vertices_around_face(hole)) border.push_back(v);
    std::vector<Face> patch;
    PMP::triangulate_hole(
        surface.mesh, hole, std::back_inserter(patch),
        CGAL::parameters::do_not_use_cubic_algorithm(border.size() > longestForCubicSearch));
    // CGAL refuses triangles without height, such as close the crack beside a vertex on an edge.
    if (patch.empty() && !fillWithFan(surface.mesh, border)) continue;
    std::ostringstream text;
    text << "filled the hole of " << border.size() << " edges at vertex "
         << surface.vertexOrigin[border.front()];
    changes.add(text.str());
  }
}

bool isDegenerate(const Surface& surface, Face f) {
  const std::array<Vertex, 3> t = surface.corners(f);
  return isDegenerateTriangle(surface.point(t[0]), surface.point(t[1]), surface.point(t[2]));
}

Halfedge longestSide(const Surface& surface, Face f) {
  const CgalSurface& mesh = surface.mesh;
  const auto length = [&](Halfedge h) {
    return (surface.point(mesh.target(h)) - surface.point(mesh.source(h))).norm();
  };
  Halfedge longest = mesh.halfedge(f);
  for (Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
    if (length(h) > length(longest)) longest = h;
  return longest;
}

/// A triangle without height, whose vertices are apart, has one of them on its longest edge: that
/// edge is flipped, so that the triangle beyond it is cut in two at that vertex.
void flipDegenerateTriangles(Surface& surface, ChangeList& changes) {
  CgalSurface& mesh = surface.mesh;
  std::vector<Face> suspects;
  for (Face f : mesh.faces())
    if (isDegenerate(surface, f)) suspects.push_back(f);
  std::vector<int> flipped;
  std::size_t attempts = 100 + 10 * suspects.size();  // flips might go round in circles
  while (!suspects.empty() && attempts-- > 0) {
    const Face f = suspects.back();
    suspects.pop_back();
    if (!isDegenerate(surface, f)) continue;
    const Halfedge side = longestSide(surface, f), beyond = mesh.opposite(side);
    if (mesh.is_border(beyond)) continue;
    const Face other = mesh.face(beyond);
    if (mesh.halfedge(mesh.target(mesh.next(side)), mesh.target(mesh.next(beyond))).is_valid())
      continue;
    if (surface.faceOrigin[f] >= 0) flipped.push_back(surface.faceOrigin[f]);
    CGAL::Euler::flip_edge(side, mesh);
    surface.faceOrigin[f] = surface.faceOrigin[other];
    suspects.insert(suspects.end(), {f, other});
  }
  changes.add("flipped the longest edge of triangles without height", flipped);
}

/// Where copies of a vertex remain, sheets of the surface touch in a point: each is drawn back from
/// it, towards its own neighbours, by a thousandth of their distance.
void partTouchingSheets(Surface& surface, ChangeList& changes) {
  constexpr double step = 1e-3;
  CgalSurface& mesh = surface.mesh;
  std::map<std::array<double, 3>, std::vector<Vertex>> atPlace;
  for (Vertex v : mesh.vertices()) {
    const Eigen::Vector3d x = surface.point(v);
    atPlace[{x.x(), x.y(), x.z()}].push_back(v);
  }
  std::vector<std::pair<Vertex, Eigen::Vector3d>> moves;
  std::vector<int> touching;
  for (const auto& [place, copies] : atPlace) {
    if (copies.size() < 2) continue;
    touching.push_back(surface.vertexOrigin[copies.front()]);
    for (Vertex v : copies) {
      Eigen::Vector3d middle = Eigen::Vector3d::Zero();
      for (Vertex neighbour : mesh.vertices_around_target(mesh.halfedge(v)))
        middle += surface.point(neighbour) / mesh.degree(v);
      moves.emplace_back(v, (1 - step) * surface.point(v) + step * middle);
    }
  }
  for (const auto& [v, x] : moves) mesh.point(v) = toCgal(x);
  changes.add("parted the sheets of the surface that touched at vertices", touching);
}

std::vector<std::pair<Face, Face>> crossingTriangles(const CgalSurface& mesh) {
  std::vector<std::pair<Face, Face>> pairs;
  PMP::self_intersections(mesh, std::back_inserter(pairs));
  return pairs;
}

/// In the numbers of the input.
std::string describeCrossing(const Surface& surface, const std::pair<Face, Face>& pair) {
  const auto name = [&](Face f) {
    const int origin = surface.faceOrigin[f];
    return origin < 0 ? std::string("one that fills a hole") : std::to_string(origin);
  };
  return "triangles " + name(pair.first) + " and " + name(pair.second) + " cut through each other";
}

/// Two shells that cut through each other might bound their union, or what they have in common.
void requireOneShell(const Surface& surface, const std::vector<std::pair<Face, Face>>& crossing) {
  std::vector<std::size_t> shell(surface.mesh.num_faces());
  const auto shellOf = [&](Face f) -> std::size_t& { return shell[f.idx()]; };
  PMP::connected_components(surface.mesh, boost::make_function_property_map<Face>(shellOf));
  for (const std::pair<Face, Face>& pair : crossing)
    if (shellOf(pair.first) != shellOf(pair.second))
      throw std::invalid_argument(
          describeCrossing(surface, pair) +
          ": they belong to two shells, and it is not clear what body these bound");
}

void removeSelfIntersections(Surface& surface, ChangeList& changes) {
  CgalSurface& mesh = surface.mesh;
  const std::vector<std::pair<Face, Face>> crossing = crossingTriangles(mesh);
  if (crossing.empty()) return;
  requireOneShell(surface, crossing);
  std::map<Face, std::array<Vertex, 3>> before;
  std::set<int> originsBefore;
  for (Face f : mesh.faces()) {
    before[f] = surface.corners(f);
    if (surface.faceOrigin[f] >= 0) originsBefore.insert(surface.faceOrigin[f]);
  }
  const std::string description = describeCrossing(surface, crossing.front());

  if (!PMP::experimental::remove_self_intersections(mesh))
    throw std::invalid_argument(description + ", and the surface cannot be rebuilt there");
  std::set<int> replaced = std::move(originsBefore);
  for (Face f : mesh.faces()) {  // CGAL uses faces again for what it puts in their place
    const auto corners = before.find(f);
    if (corners == before.end() || corners->second != surface.corners(f))
      surface.faceOrigin[f] = -1;
    replaced.erase(surface.faceOrigin[f]);
  }
  changes.add("rebuilt the surface where triangles cut through each other",
              {replaced.begin(), replaced.end()});
  fillHoles(surface, changes);
}

RepairedSurface extract(const Surface& surface) {
  RepairedSurface out;
  out.points.resize(3, surface.mesh.number_of_vertices());
  out.triangles.resize(3, surface.mesh.number_of_faces());
  std::map<Vertex, int> number;
  for (Vertex v : surface.mesh.vertices()) {
    if (surface.mesh.is_isolated(v)) continue;
    const int next = static_cast<int>(number.size());
    number[v] = next;
    out.points.col(next) = surface.point(v);
    out.originalVertex.push_back(surface.vertexOrigin[v]);
  }
  out.points.conservativeResize(3, number.size());
  for (Face f : surface.mesh.faces()) {
    const std::array<Vertex, 3> t = surface.corners(f);
    out.triangles.col(out.originalTriangle.size()) << number[t[0]], number[t[1]], number[t[2]];
    out.originalTriangle.push_back(surface.faceOrigin[f]);
  }
  return out;
}

/// @param surface  without mesh defects.
void turnOutwards(RepairedSurface& surface) {
  const Shells shells = findShells(surface.points, surface.triangles);
  for (auto t : surface.triangles.colwise()) {
    const int shell = shells.ofVertex[t[0]];
    const bool isCavity = shells.depth[shell] % 2 == 1;
    if ((shells.volume[shell] > 0) == isCavity) std::swap(t[1], t[2]);
  }
}

bool isTurned(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  for (int k = 0; k < 3; ++k)
    if (a[0] == b[k] && a[1] == b[(k + 2) % 3] && a[2] == b[(k + 1) % 3]) return true;
  return false;
}

/// @param soup  the cleaned input.
void reportVerticesAndTurns(const RepairedSurface& surface, const TriangleSoup& soup,
                            ChangeList& changes) {
  std::map<int, Eigen::Vector3d> placeBefore;
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    placeBefore[soup.vertexOrigin[v]] = soup.points[v];
  std::vector<int> moved, removed, turned;
  for (std::size_t v = 0; v < surface.originalVertex.size(); ++v) {
    const int origin = surface.originalVertex[v];
    if (origin >= 0 && placeBefore[origin] != surface.points.col(v)) moved.push_back(origin);
  }
  const std::set<int> left(surface.originalVertex.begin(), surface.originalVertex.end());
  for (int origin : soup.vertexOrigin)
    if (!left.count(origin)) removed.push_back(origin);
  std::map<int, std::array<int, 3>> cornersBefore;
  for (std::size_t f = 0; f < soup.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k)
      cornersBefore[soup.triangleOrigin[f]][k] = soup.vertexOrigin[soup.triangles[f][k]];
  for (std::size_t f = 0; f < surface.originalTriangle.size(); ++f) {
    const int origin = surface.originalTriangle[f];
    if (origin < 0) continue;
    std::array<int, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = surface.originalVertex[surface.triangles(k, f)];
    if (isTurned(corners, cornersBefore[origin])) turned.push_back(origin);
  }
  changes.add("dropped vertices that are in no triangle any more", removed);
  changes.add("moved vertices", moved);
  changes.add("turned triangles round", turned);
}

/// The sentence about the first thing that SurfaceMesh or its user would refuse; empty if none.
std::string firstDefect(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles) {
  std::vector<MeshDefect> defects = findMeshDefects(points, triangles, 1);
  if (defects.empty()) defects = findOrientationDefects(findShells(points, triangles), 1);
  if (defects.empty()) defects = findSelfIntersections(SurfaceMesh(points, triangles), 1);
  return defects.empty() ? "" : defects.front().sentence;
}

/// @throws std::invalid_argument with the bare reason.
RepairedSurface mend(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles,
                     ChangeList& changes, const Progress& progress) {
  TriangleSoup soup = cleanSoup(points, triangles, changes);
  const TriangleSoup cleaned = soup;
  dropLooseTriangles(soup, changes);
  if (soup.triangles.empty())
    throw std::invalid_argument("it has no triangle that could bound a body");
  separatePieces(soup);
  orient(soup);
  progress.report(0.2, "repair");
  Surface surface;
  build(surface, soup);
  fillHoles(surface, changes);
  progress.report(0.4, "repair");
  flipDegenerateTriangles(surface, changes);
  partTouchingSheets(surface, changes);
  progress.report(0.5, "repair");
  removeSelfIntersections(surface, changes);
  progress.report(0.8, "repair");

  RepairedSurface result = extract(surface);
  if (findMeshDefects(result.points, result.triangles, 1).empty()) turnOutwards(result);
  reportVerticesAndTurns(result, cleaned, changes);
  const std::string defect = firstDefect(result.points, result.triangles);
  if (!defect.empty()) throw std::invalid_argument(defect);
  return result;
}

/// The reason, and what had been changed until it turned up: that may have brought it about.
std::string refusal(const std::string& reason, const ChangeList& changes) {
  std::string text = "the surface cannot be mended: " + reason;
  for (std::size_t i = 0; i < changes.changes().size(); ++i)
    text += (i ? "; " : ", after these changes: ") + changes.changes()[i];
  return text;
}

RepairedSurface unchanged(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles) {
  RepairedSurface same{
      points, triangles, std::vector<int>(points.cols()), std::vector<int>(triangles.cols()), {}};
  std::iota(same.originalVertex.begin(), same.originalVertex.end(), 0);
  std::iota(same.originalTriangle.begin(), same.originalTriangle.end(), 0);
  return same;
}

}  // namespace

RepairedSurface repairSurface(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles,
                              const ProgressCallback& callback) {
  const Progress progress(callback);
  ChangeList changes;
  try {
    const bool isSound = firstDefect(points, triangles).empty();
    progress.report(0.1, "repair");
    RepairedSurface result =
        isSound ? unchanged(points, triangles) : mend(points, triangles, changes, progress);
    result.changes = changes.changes();
    progress.report(1, "repair");
    return result;
  } catch (const std::invalid_argument& reason) {
    throw std::invalid_argument(refusal(reason.what(), changes));
  } catch (const CGAL::Failure_exception& failure) {
    throw std::runtime_error(
        refusal("CGAL gave up (" + failure.expression() + " " + failure.message() + ")", changes));
  }
}

}  // namespace palpate
