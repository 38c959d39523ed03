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
  Eigen::Vector3d centroid(int triangle) const {
    return (points.col(triangles(0, triangle)) + points.col(triangles(1, triangle)) +
            points.col(triangles(2, triangle))) /
           3;
  }

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

 private:
  BodySurface(const ElasticModel& model, std::vector<int> vertices, const std::vector<int>& faces);
};

}  // namespace palpate::bem
