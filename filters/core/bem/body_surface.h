// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "bem/traction_nodes.h"

namespace palpate {
class ElasticModel;
}

namespace palpate::bem {

/// One elastic body in non-dimensional form: lengths over a characteristic length, the origin at
/// the body's middle, shear modulus 1. Bodies do not interact, so each is a system of its own; in
/// an exterior domain all cavities belong to one body.
struct BodySurface {
  /// @param body  0 .. bodyCount(model) - 1
  BodySurface(const ElasticModel& model, int body);

  static int bodyCount(const ElasticModel& model);

  int vertexCount() const { return static_cast<int>(points.cols()); }
  int triangleCount() const { return static_cast<int>(triangles.cols()); }

  std::vector<int> vertices;        ///< #v, the model's vertex of each vertex of the body
  double length;                    ///< characteristic length, in the model's unit
  Eigen::Matrix3Xd points;          ///< 3 by #v
  Eigen::Matrix3Xi triangles;       ///< 3 by #f, local indices
  Eigen::Matrix3Xd normals;         ///< 3 by #f, as the mesh is oriented
  Eigen::VectorXd areas;            ///< #f
  std::vector<bool> fixed;          ///< #v, displacement given in the reference problem
  std::vector<int> shell;           ///< #f, shell of each triangle, 0 .. shellIsCavity.size() - 1
  std::vector<bool> shellIsCavity;  ///< the material lies outside the shell
  bool exterior;                    ///< the material is the infinite space around the shells
  double poissonRatio;
  TractionNodes nodes;
};

/// Where the boundary integral equation is enforced: a point of the surface with the triangles that
/// contain it.
struct CollocationPoint {
  struct Own {
    int triangle;
    Eigen::Vector3d barycentric;
  };
  Eigen::Vector3d position;
  std::vector<Own> own;
  int vertex;                  ///< the vertex it serves
  Eigen::Vector3d areaVector;  ///< integral of hat times normal over the patches that it stands for
};

/// A traction vector that the reference problem does not prescribe.
struct TractionUnknown {
  int vertex;              ///< a fixed vertex of the body
  std::vector<int> nodes;  ///< the traction nodes that share the vector
  double area;             ///< of those nodes
};

/// The unknowns of the reference problem and the points that determine them.
///
/// Free vertices carry an unknown displacement. At a fixed vertex the traction is unknown on every
/// patch on which the vertex is a corner of a wholly fixed triangle, and zero on the others; a
/// fixed vertex without such a triangle carries one traction on all its patches. Every vertex gives
/// one collocation point, but where k >= 2 tractions are unknown there are k points, one inside
/// each of those patches: the equation at the vertex itself could not tell them apart.
struct CollocationScheme {
  explicit CollocationScheme(const BodySurface& body);

  int pointCount() const { return static_cast<int>(points.size()); }
  /// First block is the vertex itself (displacement, or its first traction unknown), the rest are
  /// the further traction unknowns.
  std::vector<TractionUnknown> tractions;
  std::vector<int> firstTraction;  ///< #v, index of a fixed vertex's first unknown, -1 where free
  std::vector<int> columnOfTraction;     ///< #tractions, block column of the system
  std::vector<CollocationPoint> points;  ///< in an order that keeps neighbours together
};

}  // namespace palpate::bem
