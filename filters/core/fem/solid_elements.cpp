// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fem/solid_elements.h"

#include <algorithm>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <utility>

namespace palpate::fem {
namespace {

constexpr int kEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

/// The rule of four points that is exact for polynomials of degree two: (5 - sqrt 5) / 20 thrice
/// and the rest, equal weights (Hammer and Stroud 1956).
constexpr double kFar = 0.13819660112501052, kNear = 1 - 3 * kFar;

/// Columns of the strain (Voigt, engineering shear) that a node's displacement makes.
Eigen::Matrix<double, 6, 3> strainOf(const Eigen::Vector3d& slope) {
  Eigen::Matrix<double, 6, 3> strain;
  strain << slope.x(), 0, 0,    //
      0, slope.y(), 0,          //
      0, 0, slope.z(),          //
      0, slope.z(), slope.y(),  //
      slope.z(), 0, slope.x(),  //
      slope.y(), slope.x(), 0;
  return strain;
}

}  // namespace

SolidNodes::SolidNodes(const TetrahedralMesh& mesh, SolidElement element)
    : count(mesh.pointCount()) {
  if (element == SolidElement::Linear) {
    cells = mesh.tetrahedra();
    return;
  }
  const auto ends = [&](int cell, int edge) {
    return std::minmax(
        {mesh.tetrahedra()(kEdges[edge][0], cell), mesh.tetrahedra()(kEdges[edge][1], cell)});
  };
  edges_.reserve(6 * std::size_t(mesh.cellCount()));
  for (int cell = 0; cell < mesh.cellCount(); ++cell)
    for (int edge = 0; edge < 6; ++edge) {
      const auto [low, high] = ends(cell, edge);
      edges_.push_back({low, high, -1});
    }
  const auto key = [](const Edge& e) { return std::make_pair(e.low, e.high); };
  std::sort(edges_.begin(), edges_.end(),
            [&](const Edge& a, const Edge& b) { return key(a) < key(b); });
  edges_.erase(std::unique(edges_.begin(), edges_.end(),
                           [&](const Edge& a, const Edge& b) { return key(a) == key(b); }),
               edges_.end());
  for (Edge& edge : edges_) edge.node = count++;
  cells.resize(10, mesh.cellCount());
  cells.topRows<4>() = mesh.tetrahedra();
  for (int cell = 0; cell < mesh.cellCount(); ++cell)
    for (int edge = 0; edge < 6; ++edge) {
      const auto [low, high] = ends(cell, edge);
      cells(4 + edge, cell) = middle(low, high);
    }
}

int SolidNodes::middle(int from, int to) const {
  const auto [low, high] = std::minmax(from, to);
  const auto found = std::lower_bound(edges_.begin(), edges_.end(), std::make_pair(low, high),
                                      [](const Edge& edge, const std::pair<int, int>& ends) {
                                        return std::make_pair(edge.low, edge.high) < ends;
                                      });
  return found != edges_.end() && found->low == low && found->high == high ? found->node : -1;
}

Eigen::Matrix<double, 3, 4> barycentricGradients(const Eigen::Matrix<double, 3, 4>& corners) {
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = corners.col(k + 1) - corners.col(0);
  Eigen::Matrix<double, 3, 4> gradients;
  gradients.rightCols<3>() = edges.inverse().transpose();
  gradients.col(0) = -gradients.rightCols<3>().rowwise().sum();
  return gradients;
}

void shapeFunctions(SolidElement element, const Eigen::Vector4d& b,
                    const Eigen::Matrix<double, 3, 4>& gradients, Eigen::VectorXd& values,
                    Eigen::Matrix3Xd& slopes) {
  if (element == SolidElement::Linear) {
    values = b;
    slopes = gradients;
    return;
  }
  values.resize(10);
  slopes.resize(3, 10);
  for (int k = 0; k < 4; ++k) {
    values[k] = b[k] * (2 * b[k] - 1);
    slopes.col(k) = (4 * b[k] - 1) * gradients.col(k);
  }
  for (int e = 0; e < 6; ++e) {
    const int i = kEdges[e][0], j = kEdges[e][1];
    values[4 + e] = 4 * b[i] * b[j];
    slopes.col(4 + e) = 4 * (b[i] * gradients.col(j) + b[j] * gradients.col(i));
  }
}

void integrateElement(const Eigen::Matrix<double, 3, 4>& corners, SolidElement element,
                      const Matrix6d& stiffness, bool split, ElementMatrices& out) {
  const Eigen::Matrix<double, 3, 4> gradients = barycentricGradients(corners);
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = corners.col(k + 1) - corners.col(0);
  const double volume = edges.determinant() / 6;
  const int nodes = element == SolidElement::Linear ? 4 : 10;
  out.stiffness.setZero(3 * nodes, 3 * nodes);
  out.divergence.setZero(split ? 4 : 0, 3 * nodes);
  out.mass = (Eigen::Matrix4d::Ones() + Eigen::Matrix4d::Identity()) * volume / 20;
  Eigen::VectorXd values;
  Eigen::Matrix3Xd slopes;
  Eigen::Matrix<double, 6, 3> strain[10];
  for (int q = 0; q < 4; ++q) {
    Eigen::Vector4d place = Eigen::Vector4d::Constant(kFar);
    place[q] = kNear;
    shapeFunctions(element, place, gradients, values, slopes);
    for (int i = 0; i < nodes; ++i) strain[i] = strainOf(slopes.col(i));
    for (int j = 0; j < nodes; ++j) {
      const Eigen::Matrix<double, 6, 3> stress = volume / 4 * stiffness * strain[j];
      for (int i = j; i < nodes; ++i)
        out.stiffness.block<3, 3>(3 * i, 3 * j).noalias() += strain[i].transpose() * stress;
    }
    for (int v = 0; split && v < 4; ++v)
      for (int i = 0; i < nodes; ++i)
        out.divergence.block<1, 3>(v, 3 * i) += volume / 4 * place[v] * slopes.col(i).transpose();
  }
  out.stiffness.triangularView<Eigen::StrictlyUpper>() = out.stiffness.transpose();
}

}  // namespace palpate::fem
