// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/problems.h"

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
