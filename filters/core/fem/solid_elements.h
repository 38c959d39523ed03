// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "fem/solid_body.h"

namespace palpate {

/// Shape functions of displacement on a tetrahedron with straight edges.
enum class SolidElement {
  Linear,     ///< four corners
  Quadratic,  ///< and the middles of six edges
};

/// 3 by #V: whether the displacement of a vertex of the surface along x, y, z is held, besides what
/// its fixed vertices hold.
using HeldDisplacements = Eigen::Array<bool, 3, Eigen::Dynamic>;

}  // namespace palpate

namespace palpate::fem {

/// The nodes of displacement: the points of the mesh, then the middles of its edges.
struct SolidNodes {
  SolidNodes(const TetrahedralMesh& mesh, SolidElement element);

  int perCell() const { return static_cast<int>(cells.rows()); }
  /// The middle of an edge, -1 if there is no such edge or edges have no nodes.
  int middle(int from, int to) const;

  int count;              ///< of all nodes
  Eigen::MatrixXi cells;  ///< 4 or 10 by #T: corners, then middles of edges 01 02 03 12 13 23

 private:
  struct Edge {
    int low, high, node;
  };
  std::vector<Edge> edges_;  // ascending
};

/// Integrals over one tetrahedron, of lengths as given.
struct ElementMatrices {
  Eigen::MatrixXd stiffness;   ///< 3 nodes by 3 nodes: integral of strain . C strain
  Eigen::MatrixXd divergence;  ///< 4 by 3 nodes: integral of corner hat times divergence
  Eigen::Matrix4d mass;        ///< integral of the product of two corners' hats
};

/// @param corners    3 by 4.
/// @param stiffness  C, Voigt (see Elasticity).
/// @param split      whether divergence and mass are wanted.
/// @param out        matrices are resized where needed.
void integrateElement(const Eigen::Matrix<double, 3, 4>& corners, SolidElement element,
                      const Matrix6d& stiffness, bool split, ElementMatrices& out);

/// Values of the shape functions and their gradients at a point of a tetrahedron.
/// @param barycentric  of the point.
/// @param gradients    3 by 4: of the barycentric coordinates.
/// @param values       4 or 10.
/// @param slopes       3 by 4 or 10.
void shapeFunctions(SolidElement element, const Eigen::Vector4d& barycentric,
                    const Eigen::Matrix<double, 3, 4>& gradients, Eigen::VectorXd& values,
                    Eigen::Matrix3Xd& slopes);

/// Gradients of the barycentric coordinates of a tetrahedron.
/// @param corners  3 by 4, of positive volume.
Eigen::Matrix<double, 3, 4> barycentricGradients(const Eigen::Matrix<double, 3, 4>& corners);

}  // namespace palpate::fem
