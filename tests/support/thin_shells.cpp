// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/thin_shells.h"

#include <utility>
#include <vector>

namespace palpate::test {
namespace {

ElasticModel modelOf(const Shape& shape, std::vector<unsigned char> types,
                     const ShellMaterial& material) {
  const auto mesh = shape.sheet();
  return ElasticModel(mesh, Material(material.youngsModulus, material.poissonRatio),
                      BoundaryConditions(std::move(types)),
                      Eigen::VectorXi::Zero(mesh->triangleCount()), Domain::Shell);
}

Eigen::Matrix3Xd even(const Shape& shape, double thickness) {
  return Eigen::Matrix3Xd::Constant(3, shape.triangles.cols(), thickness);
}

}  // namespace

ElasticModel shellModel(const Shape& shape, const Place& fixed, const ShellMaterial& material) {
  return modelOf(shape, fixedWhere(shape, fixed), material);
}

ShellProblem shellProblem(const Shape& shape, const Place& fixed, const ShellMaterial& material,
                          bool clamped) {
  const ElasticModel model = shellModel(shape, fixed, material);
  return {model, ThinShell(model, even(shape, material.thickness), clamped)};
}

ShellProblem heldShell(const Shape& shape, const HeldAt& heldAt, const ShellMaterial& material) {
  HeldComponents held(6, shape.points.cols());
  std::vector<unsigned char> types;
  for (Eigen::Index v = 0; v < shape.points.cols(); ++v) {
    const unsigned bits = heldAt(shape.points.col(v));
    for (int k = 0; k < 6; ++k) held(k, v) = bits >> k & 1;
    types.push_back(held.col(v).head<3>().all());
  }
  const ElasticModel model = modelOf(shape, types, material);
  return {model, ThinShell(model, even(shape, material.thickness), std::move(held))};
}

Shape sheetOf(int n, const std::function<Eigen::Vector3d(double, double)>& map) {
  return sheetOf(n, n, map);
}

Shape sheetOf(int alongX, int alongY, const std::function<Eigen::Vector3d(double, double)>& map) {
  std::vector<Eigen::Vector3d> points;
  for (int j = 0; j <= alongY; ++j)
    for (int i = 0; i <= alongX; ++i) points.push_back(map(double(i) / alongX, double(j) / alongY));
  return fromLists(points, alternatingSquares(alongX, alongY));
}

Eigen::Matrix3Xd displacementUnder(const ShellProblem& problem, const Eigen::Matrix3Xd& forces) {
  ShellOptions options;
  for (int v : problem.model.conditions().freeNodes())
    if (!forces.col(v).isZero(0)) options.columns.push_back(v);
  const auto greens = problem.greens(options);
  Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, forces.cols());
  for (int v : options.columns) given.col(v) = forces.col(v) / greens->vertexArea(v);
  Eigen::Matrix3Xd answer = solveReferenceProblem(*greens, given);
  for (int v : problem.model.conditions().fixedNodes()) answer.col(v).setZero();
  return answer;
}

double displacementAt(const ShellProblem& problem, int vertex, int component,
                      const Eigen::Matrix3Xd& forces) {
  Eigen::Matrix3Xd there = Eigen::Matrix3Xd::Zero(3, forces.cols());
  there(component, vertex) = 1;
  return displacementUnder(problem, there).cwiseProduct(forces).sum();
}

Eigen::Matrix3Xd spreadEvenly(const SurfaceMesh& mesh, const Eigen::Vector3d& traction) {
  return traction * mesh.vertexAreas().transpose();
}

int vertexNear(const SurfaceMesh& mesh, const Eigen::Vector3d& place) {
  Eigen::Index vertex;
  (mesh.points().colwise() - place).colwise().squaredNorm().minCoeff(&vertex);
  return static_cast<int>(vertex);
}

}  // namespace palpate::test
