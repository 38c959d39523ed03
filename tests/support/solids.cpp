// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/solids.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace palpate::test {

Solid Solid::mapped(const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map) const {
  Solid out = *this;
  for (int i = 0; i < points.cols(); ++i) out.points.col(i) = map(points.col(i));
  return out;
}

Solid cornerTetrahedron() {
  Solid solid{Eigen::Matrix3Xd::Zero(3, 4), Eigen::Vector4i(0, 1, 2, 3)};
  solid.points.rightCols<3>().setIdentity();
  return solid;
}

Solid regularTetrahedron() {
  Solid solid{Eigen::Matrix3Xd(3, 4), Eigen::Vector4i(0, 1, 2, 3)};
  solid.points << 1, 1, -1, -1,  //
      1, -1, 1, -1,              //
      1, -1, -1, 1;
  return solid;
}

Solid cubeOfFive() {
  Solid solid{Eigen::Matrix3Xd(3, 8), Eigen::Matrix4Xi(4, 5)};
  for (int i = 0; i < 8; ++i) solid.points.col(i) << (i & 1), (i >> 1 & 1), (i >> 2);
  solid.tetrahedra << 0, 1, 2, 4, 7,  //
      3, 0, 0, 0, 3,                  //
      5, 3, 3, 5, 5,                  //
      6, 5, 6, 6, 6;
  return solid;
}

Solid kuhnBox(const Eigen::Vector3d& size, const Eigen::Vector3i& divisions) {
  const auto at = [&](const Eigen::Vector3i& i) {
    return (i.z() * (divisions.y() + 1) + i.y()) * (divisions.x() + 1) + i.x();
  };
  std::vector<Eigen::Vector4i> cells;
  Solid solid;
  solid.points.resize(3, at(divisions) + 1);
  Eigen::Vector3i i;
  for (i.z() = 0; i.z() <= divisions.z(); ++i.z())
    for (i.y() = 0; i.y() <= divisions.y(); ++i.y())
      for (i.x() = 0; i.x() <= divisions.x(); ++i.x()) {
        solid.points.col(at(i)) =
            size.array() * i.cast<double>().array() / divisions.cast<double>().array();
        if ((i.array() == divisions.array()).any()) continue;
        int axes[3] = {0, 1, 2};
        do {
          Eigen::Vector4i cell(at(i), 0, 0, 0);
          Eigen::Vector3i corner = i;
          for (int k = 0; k < 3; ++k) {
            ++corner[axes[k]];
            cell[k + 1] = at(corner);
          }
          cells.push_back(cell);
        } while (std::next_permutation(axes, axes + 3));
      }
  solid.tetrahedra.resize(4, static_cast<Eigen::Index>(cells.size()));
  for (std::size_t t = 0; t < cells.size(); ++t) solid.tetrahedra.col(t) = cells[t];
  return solid;
}

Shape boundaryOf(const TetrahedralMesh& mesh) {
  std::vector<int> number(mesh.pointCount(), -1);
  for (int corner : mesh.boundary().reshaped()) number[corner] = 0;
  int count = 0;
  for (int& entry : number)
    if (entry == 0) entry = count++;
  Shape shape{Eigen::Matrix3Xd(3, count), mesh.boundary()};
  for (int i = 0; i < mesh.pointCount(); ++i)
    if (number[i] >= 0) shape.points.col(number[i]) = mesh.points().col(i);
  for (int& corner : shape.triangles.reshaped()) corner = number[corner];
  return shape;
}

SolidProblem solidProblem(const TetrahedralMesh& mesh, const Place& fixed, double youngsModulus,
                          double poissonRatio) {
  const ElasticModel model = makeModel(boundaryOf(mesh), fixed, youngsModulus, poissonRatio);
  return {model, SolidBody(model.mesh(), mesh, {Elasticity(model.material())})};
}

FiniteElementOptions allColumns(const ElasticModel& model) {
  FiniteElementOptions options;
  options.columns.resize(model.mesh().vertexCount());
  std::iota(options.columns.begin(), options.columns.end(), 0);
  return options;
}

}  // namespace palpate::test
