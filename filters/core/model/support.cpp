// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/support.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

#include "mesh/surface_mesh.h"
#include "model/boundary_conditions.h"

namespace palpate {

std::string RigidMotion::describe() const {
  const bool turns = rotation.norm() > translation.norm();
  const Eigen::Vector3d axis = (turns ? rotation : translation).normalized();
  std::ostringstream text;
  text.precision(3);
  text << (turns ? "rotation about the axis (" : "translation along (") << axis.x() << ", "
       << axis.y() << ", " << axis.z() << ")";
  return text.str();
}

Eigen::MatrixXd rigidMotions(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& middle,
                             double length) {
  Eigen::MatrixXd motions(3 * points.cols(), 6);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k);
      motions.block<3, 1>(3 * i, k) = axis;
      motions.block<3, 1>(3 * i, 3 + k) = axis.cross((points.col(i) - middle) / length);
    }
  return motions;
}

RigidMotion leastResistedMotion(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& directions,
                                double bodySize, const Eigen::Matrix3Xd& axes) {
  const Eigen::Index count = points.cols();
  const Eigen::Vector3d middle =
      count > 0 ? Eigen::Vector3d(points.rowwise().mean()) : Eigen::Vector3d::Zero();
  // Six zero rows keep the decomposition defined for fewer than six constraints.
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(count + axes.cols() + 6, 6);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3d arm = (points.col(i) - middle) / bodySize;
    rows.row(i) << directions.col(i).transpose(), arm.cross(directions.col(i)).transpose();
  }
  rows.middleRows(count, axes.cols()).rightCols<3>() = axes.transpose();
  rows /= std::sqrt(std::max<double>(1, count + axes.cols()));
  const Eigen::MatrixXd triangle = Eigen::HouseholderQR<Eigen::MatrixXd>(rows)
                                       .matrixQR()
                                       .topRows(6)
                                       .triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(triangle, Eigen::ComputeFullV);
  return {svd.singularValues()[5], svd.matrixV().col(5).head<3>(), svd.matrixV().col(5).tail<3>()};
}

void requireSupport(const SurfaceMesh& mesh, const BoundaryConditions& conditions) {
  for (int body = 0; body < mesh.bodyCount(); ++body) {
    std::vector<int> fixed, all;
    for (int v = 0; v < mesh.vertexCount(); ++v) {
      if (mesh.bodyOfVertex(v) != body) continue;
      all.push_back(v);
      if (conditions.isFixed(v)) fixed.push_back(v);
    }
    Eigen::AlignedBox3d box;
    for (int v : all) box.extend(mesh.points().col(v));
    Eigen::Matrix3Xd points(3, 3 * fixed.size()), directions(3, 3 * fixed.size());
    for (std::size_t i = 0; i < fixed.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        points.col(3 * i + c) = mesh.points().col(fixed[i]);
        directions.col(3 * i + c) = Eigen::Vector3d::Unit(c);
      }
    const RigidMotion motion = leastResistedMotion(points, directions, box.diagonal().norm());
    if (motion.resistance >= kSmallestResistance) continue;
    std::ostringstream text;
    if (fixed.empty())
      text << "the body of vertex " << all.front()
           << " has no fixed node, which leaves a rigid motion";
    else if (fixed.size() == 1)
      text << "the only fixed node of the body of vertex " << all.front()
           << " leaves a rigid motion";
    else
      text << "the " << fixed.size() << " fixed nodes of the body of vertex " << all.front()
           << " leave a rigid motion";
    text << " free (" << motion.describe()
         << "): fix at least three nodes that are not on one line";
    throw std::invalid_argument(text.str());
  }
}

namespace {

/// Extent of a set of vertices along its second principal axis, over the mean length of the edges
/// within it (of all edges at it, if it has none within).
double widthInEdges(const SurfaceMesh& mesh, const std::vector<int>& vertices,
                    const std::vector<bool>& inside) {
  double lengthWithin = 0, lengthAround = 0;
  int countWithin = 0, countAround = 0;
  for (int v : vertices)
    for (int f : mesh.trianglesOfVertex(v))
      for (int k = 0; k < 3; ++k) {
        const int other = mesh.triangles()(k, f);
        if (other == v) continue;
        const double length = (mesh.points().col(v) - mesh.points().col(other)).norm();
        lengthAround += length;
        ++countAround;
        if (!inside[other]) continue;
        lengthWithin += length;
        ++countWithin;
      }
  const double edge = countWithin ? lengthWithin / countWithin : lengthAround / countAround;

  Eigen::Matrix3Xd points(3, vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) points.col(i) = mesh.points().col(vertices[i]);
  const Eigen::Vector3d middle = points.rowwise().mean();
  points.colwise() -= middle;
  const Eigen::Matrix3d scatter = points * points.transpose();
  const Eigen::Vector3d axis =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(
          1);  // ascending order: 1 is the second largest
  const Eigen::RowVectorXd along = axis.transpose() * points;
  return (along.maxCoeff() - along.minCoeff()) / edge;
}

}  // namespace

double supportWidthInEdges(const SurfaceMesh& mesh, const BoundaryConditions& conditions) {
  std::vector<double> widest(mesh.bodyCount(), -1);
  std::vector<bool> seen(mesh.vertexCount(), false);
  for (int seed = 0; seed < mesh.vertexCount(); ++seed) {
    if (seen[seed] || !conditions.isFixed(seed)) continue;
    std::vector<int> set{seed};
    std::vector<bool> inside(mesh.vertexCount(), false);
    inside[seed] = seen[seed] = true;
    for (std::size_t i = 0; i < set.size(); ++i)
      for (int f : mesh.trianglesOfVertex(set[i]))
        for (int k = 0; k < 3; ++k) {
          const int other = mesh.triangles()(k, f);
          if (seen[other] || !conditions.isFixed(other)) continue;
          inside[other] = seen[other] = true;
          set.push_back(other);
        }
    double& width = widest[mesh.bodyOfVertex(seed)];
    width = std::max(width, widthInEdges(mesh, set, inside));
  }
  double smallest = std::numeric_limits<double>::infinity();
  for (double width : widest)
    if (width >= 0) smallest = std::min(smallest, width);
  return smallest;
}

Eigen::VectorXi splitAtSupport(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                               const Eigen::VectorXi& smoothPatches) {
  std::map<std::pair<int, bool>, int> numbers;
  Eigen::VectorXi patches(mesh.triangleCount());
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    bool isSupport = true;
    for (int v : mesh.triangles().col(f)) isSupport = isSupport && conditions.isFixed(v);
    patches[f] = numbers.try_emplace({smoothPatches[f], isSupport}, numbers.size()).first->second;
  }
  return patches;
}

}  // namespace palpate
