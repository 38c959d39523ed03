// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/problems.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bem/kelvin.h"
#include "mesh/smooth_patches.h"

namespace palpate::test {

ElasticModel makeModel(const Shape& shape, const Place& fixed, double youngsModulus,
                       double poissonRatio, double smoothAngle, Domain domain) {
  const auto mesh = shape.mesh();
  return ElasticModel(mesh, Material(youngsModulus, poissonRatio),
                      BoundaryConditions(fixedWhere(shape, fixed)),
                      findSmoothPatches(*mesh, smoothAngle), domain);
}

NodalField pointSourceField(const ElasticModel& model) {
  const Eigen::Vector3d source(0.3, 0.4, 1.9), force(0.3, -0.5, 1);
  const double nu = model.material().poissonRatio();
  const int n = model.mesh().vertexCount();
  NodalField field{Eigen::Matrix3Xd(3, n), Eigen::Matrix3Xd(3, n)};
  for (int v = 0; v < n; ++v) {
    const Eigen::Vector3d x = model.mesh().points().col(v), r = x - source;
    field.displacement.col(v) =
        bem::kelvinDisplacement(r, model.material().shearModulus(), nu) * force;
    field.traction.col(v) = bem::kelvinTraction(r, x.normalized(), nu).transpose() * force;
  }
  return field;
}

double pointSourceError(const ElasticModel& model) {
  const auto greens = computeGreens(model, rawWithAllColumns(model));
  const NodalField exact = pointSourceField(model);
  Eigen::Matrix3Xd given = exact.traction;
  for (int v : model.conditions().fixedNodes()) given.col(v) = exact.displacement.col(v);
  return relativeError(solveReferenceProblem(*greens, given), exact.displacement, model,
                       [&](int v) { return !model.conditions().isFixed(v); });
}

ThickSphere thickSphere(const ElasticModel& model) {
  const double nu = model.material().poissonRatio();
  const double a = (1 - 2 * nu) / 7, b = 8 * (1 + nu) / (2 * 7);
  ThickSphere field;
  field.exact.resize(3, model.mesh().vertexCount());
  field.given.setZero(3, model.mesh().vertexCount());
  for (int v = 0; v < field.exact.cols(); ++v) {
    const Eigen::Vector3d x = model.mesh().points().col(v);
    const double r = x.norm();
    field.exact.col(v) = (a * r + b / (r * r)) * x / r;
    if (model.conditions().isFixed(v))
      field.given.col(v) = field.exact.col(v);
    else if (r < 1.5)
      field.given.col(v) = x;
  }
  return field;
}

double patchTestError(const ElasticModel& model, BoundaryElementOptions options) {
  Eigen::Matrix3d gradient;
  gradient << 0.3, 0.5, -0.2, 0.1, -0.4, 0.7, 0.6, 0.2, 0.9;
  const double g = model.material().shearModulus(), nu = model.material().poissonRatio();
  const Eigen::Matrix3d strain = (gradient + gradient.transpose()) / 2;
  const Eigen::Matrix3d stress =
      2 * g * (strain + nu / (1 - 2 * nu) * strain.trace() * Eigen::Matrix3d::Identity());
  options.columns = rawWithAllColumns(model).columns;
  options.patchColumns = true;
  options.reciprocal = false;
  const auto greens = computeGreens(model, options);
  const Eigen::Matrix3Xd exact = gradient * model.mesh().points();
  Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, exact.cols()), applied;
  for (int v : model.conditions().fixedNodes()) given.col(v) = exact.col(v);
  const Eigen::Matrix3Xd response =
      solveReferenceProblem(*greens, given) +
      solveFaceTractions(*greens, model.mesh(), model.smoothPatches(),
                         stress * model.mesh().triangleNormals(), applied);
  double error = 0;
  for (int v : model.conditions().freeNodes())
    error = std::max(error, (response.col(v) - exact.col(v)).norm());
  return error / exact.colwise().norm().maxCoeff();
}

std::shared_ptr<const GreensFunctions> computeGreens(const ElasticModel& model,
                                                     BoundaryElementOptions options) {
  return computeBoundaryElementGreensFunctions(model, options).take();
}

BoundaryElementOptions rawWithAllColumns(const ElasticModel& model) {
  BoundaryElementOptions options = raw();
  options.columns.resize(model.mesh().vertexCount());
  std::iota(options.columns.begin(), options.columns.end(), 0);
  return options;
}

BoundaryElementOptions raw() {
  BoundaryElementOptions options;
  options.reciprocal = false;
  return options;
}

double relativeError(const Eigen::Matrix3Xd& values, const Eigen::Matrix3Xd& exact,
                     const ElasticModel& model, const std::function<bool(int)>& where) {
  double error = 0, size = 0;
  for (int v = 0; v < model.mesh().vertexCount(); ++v) {
    if (!where(v)) continue;
    error += model.mesh().vertexAreas()[v] * (values.col(v) - exact.col(v)).squaredNorm();
    size += model.mesh().vertexAreas()[v] * exact.col(v).squaredNorm();
  }
  return std::sqrt(error / size);
}

double convergenceOrder(double coarseError, int coarseVertices, double fineError,
                        int fineVertices) {
  return 2 * std::log(coarseError / fineError) / std::log(double(fineVertices) / coarseVertices);
}

}  // namespace palpate::test
