// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imported/node_places.h"

#include <array>
#include <map>
#include <set>
#include <unordered_map>

#include "sentence.h"

namespace palpate::imported {
namespace {

/// The vertices by the cells of a grid as wide as the tolerance.
class VertexGrid {
 public:
  VertexGrid(const SurfaceMesh& mesh, double tolerance) : mesh_(mesh), tolerance_(tolerance) {
    low_ = mesh.points().rowwise().minCoeff().array() - tolerance;
    high_ = mesh.points().rowwise().maxCoeff().array() + tolerance;
    for (int v = 0; v < mesh.vertexCount(); ++v)
      cells_[keyOf(cellOf(mesh.points().col(v)))].push_back(v);
  }

  /// The nearest vertex within the tolerance, -1 for none.
  int vertexAt(const Eigen::Vector3d& x) const {
    if (!((x.array() >= low_.array()).all() && (x.array() <= high_.array()).all())) return -1;
    const std::array<std::int64_t, 3> middle = cellOf(x);
    int nearest = -1;
    double least = tolerance_;
    for (int neighbour = 0; neighbour < 27; ++neighbour) {
      const auto found =
          cells_.find(keyOf({middle[0] + neighbour % 3 - 1, middle[1] + neighbour / 3 % 3 - 1,
                             middle[2] + neighbour / 9 - 1}));
      if (found == cells_.end()) continue;
      for (int v : found->second) {
        const double distance = (mesh_.points().col(v) - x).norm();
        if (distance > least) continue;
        least = distance;
        nearest = v;
      }
    }
    return nearest;
  }

 private:
  std::array<std::int64_t, 3> cellOf(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d cell = (x - low_) / tolerance_;
    return {std::int64_t(cell[0]), std::int64_t(cell[1]), std::int64_t(cell[2])};
  }
  /// Cells that share a key by chance are told apart by distances.
  static std::uint64_t keyOf(const std::array<std::int64_t, 3>& cell) {
    return std::uint64_t(cell[0]) * 73856093u ^ std::uint64_t(cell[1]) * 19349663u ^
           std::uint64_t(cell[2]) * 83492791u;
  }

  const SurfaceMesh& mesh_;
  double tolerance_;
  Eigen::Vector3d low_, high_;
  std::unordered_map<std::uint64_t, std::vector<int>> cells_;
};

/// What a matrix' rows are that does not say so itself: three a node.
/// @param numbers  of the nodes; empty to count them from 1.
std::vector<MatrixDof> dofsByOrder(int size, DofOrder order,
                                   const std::vector<std::int64_t>& numbers) {
  if (size % 3 != 0)
    refuse("the matrix has ", size,
           " rows, which is no multiple of 3: a node has three, of its displacements x, y and z");
  const int count = size / 3;
  std::vector<MatrixDof> dofs;
  for (int row = 0; row < size; ++row) {
    const int node = order == DofOrder::ByNode ? row / 3 : row % count;
    dofs.push_back({numbers.empty() ? node + 1 : numbers[node],
                    order == DofOrder::ByNode ? row % 3 : row / count});
  }
  return dofs;
}

/// The vertices that the nodes of a matrix without places are: all, or the free ones.
std::map<std::int64_t, int> verticesByOrder(int size, const BoundaryConditions& conditions) {
  const std::vector<int> free = conditions.freeNodes();
  const std::size_t count = conditions.nodeCount(), rows = size;
  if (rows != 3 * count && rows != 3 * free.size())
    refuse("the matrix has ", size, " rows, but the surface has ", count, " vertices",
           free.size() < count ? sentence(", ", free.size(), " of them free") : "",
           ": it must have three rows a vertex in their order, or give the places of its nodes");
  std::map<std::int64_t, int> vertices;
  for (std::size_t i = 0; i < rows / 3; ++i)
    vertices[i + 1] = rows == 3 * count ? static_cast<int>(i) : free[i];
  return vertices;
}

/// The vertices at the places of the nodes that have rows.
std::map<std::int64_t, int> verticesByPlace(const std::vector<MatrixDof>& dofs,
                                            const std::map<std::int64_t, int>& indexOfNode,
                                            const NodeTable& nodes, const SurfaceMesh& mesh,
                                            double tolerance) {
  const VertexGrid grid(mesh, tolerance);
  std::map<std::int64_t, int> vertices;
  std::map<int, std::int64_t> nodeAt;
  for (const MatrixDof& dof : dofs) {
    const auto index = indexOfNode.find(dof.node);
    if (index == indexOfNode.end() || vertices.count(dof.node)) continue;
    const int vertex = grid.vertexAt(nodes.points.col(index->second));
    if (vertex < 0) continue;
    vertices[dof.node] = vertex;
    const auto [other, isNew] = nodeAt.emplace(vertex, dof.node);
    if (!isNew)
      refuse("nodes ", other->second, " and ", dof.node, " are both at vertex ", vertex,
             ": which of them is touched cannot be told");
  }
  return vertices;
}

double extentOf(const Eigen::Matrix3Xd& points) {
  return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

/// @throws about a free vertex that no node is at.
[[noreturn]] void refuseVertex(int vertex, const SurfaceMesh& mesh, const NodeTable& nodes,
                               double tolerance) {
  const double ratio = extentOf(nodes.points) / mesh.diagonal();
  if (ratio > 5 || ratio < 0.2)
    refuse("vertex ", vertex, " has no node in the matrix, whose nodes extend over ", ratio,
           " times the surface's size: state the unit of the matrix' lengths");
  Eigen::Index nearest;
  const double distance =
      (nodes.points.colwise() - mesh.points().col(vertex)).colwise().norm().minCoeff(&nearest);
  refuse("vertex ", vertex, " has no node in the matrix: the nearest, node ",
         nodes.numbers.empty() ? nearest + 1 : nodes.numbers[nearest], ", is ", distance,
         " away (at most ", tolerance,
         "): give the surface of these nodes, or fix the vertex if it is held where the matrix is "
         "from");
}

void requireWholeVertices(const NodePlaces& places, const SurfaceMesh& mesh,
                          const BoundaryConditions& conditions, const NodeTable& nodes,
                          double tolerance) {
  const Eigen::Matrix3Xi& rows = places.rowsOfVertex;
  for (int v = 0; v < rows.cols(); ++v) {
    const auto given = (rows.col(v).array() >= 0).count();
    if (given > 0 && given < 3)
      refuse("the matrix has only ", given, " of the three displacements of vertex ", v);
    if (given == 0 && !conditions.isFixed(v)) refuseVertex(v, mesh, nodes, tolerance);
  }
}

}  // namespace

NodePlaces nodePlaces(const GivenMatrix& matrix, const NodeTable& nodes, DofOrder order,
                      const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                      double tolerance) {
  const bool isNumbered = !matrix.dofs.empty();
  if (isNumbered && nodes.count() == 0)
    refuse(
        "the matrix names its nodes by numbers, of which no place is known: give number, x, y "
        "and z of each");
  if (isNumbered && nodes.numbers.empty())
    refuse(
        "the matrix names its nodes by numbers, which the nodes given lack: give number, x, y "
        "and z of each");
  if (!isNumbered && nodes.count() > 0 && 3 * std::int64_t(nodes.count()) != matrix.size())
    refuse("there are ", nodes.count(), " nodes for ", matrix.size(),
           " rows of the matrix, of which each node has three");

  std::map<std::int64_t, int> indexOfNode;
  for (int i = 0; i < nodes.count(); ++i)
    indexOfNode[nodes.numbers.empty() ? i + 1 : nodes.numbers[i]] = i;
  NodePlaces places;
  places.dofs = isNumbered ? matrix.dofs : dofsByOrder(matrix.size(), order, nodes.numbers);
  const std::map<std::int64_t, int> vertices =
      nodes.count() == 0 ? verticesByOrder(matrix.size(), conditions)
                         : verticesByPlace(places.dofs, indexOfNode, nodes, mesh, tolerance);

  places.rowsOfVertex = Eigen::Matrix3Xi::Constant(3, mesh.vertexCount(), -1);
  std::set<std::int64_t> seen;
  for (int row = 0; row < matrix.size(); ++row) {
    const MatrixDof& dof = places.dofs[row];
    seen.insert(dof.node);
    const auto vertex = vertices.find(dof.node);
    if (vertex == vertices.end() || dof.component < 0 || dof.component > 2)
      places.others.push_back(row);
    else if (places.rowsOfVertex(dof.component, vertex->second) >= 0)
      refuse("two rows of the matrix are of the same displacement: ", places.nameOf(row));
    else
      places.rowsOfVertex(dof.component, vertex->second) = row;
  }
  places.nodeCount = static_cast<int>(seen.size());
  requireWholeVertices(places, mesh, conditions, nodes, tolerance);
  return places;
}

std::string NodePlaces::nameOf(int row) const {
  constexpr const char* names[] = {"", ", x", ", y", ", z", ", rx", ", ry", ", rz"};
  return sentence("row ", row + 1, " (node ", dofs[row].node, names[dofs[row].component + 1], ")");
}

}  // namespace palpate::imported
