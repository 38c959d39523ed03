// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/surface_fields.h"

#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "greens/support_tractions.h"
#include "sentence.h"

namespace palpate {
namespace {

void requireAtVertices(const SurfaceMesh& mesh, const Eigen::Matrix3Xd& values, const char* what) {
  if (values.cols() != mesh.vertexCount())
    refuse("the ", what, " must be given at ", mesh.vertexCount(), " vertices, not at ",
           values.cols());
}

/// Along the surface, of displacements linear in a triangle.
Eigen::Matrix3d gradientAlong(const SurfaceMesh& mesh, int triangle,
                              const Eigen::Matrix3Xd& displacement) {
  const Eigen::Vector3i corners = mesh.triangles().col(triangle);
  const Eigen::Vector3d normal = mesh.triangleNormals().col(triangle);
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d opposite =
        mesh.points().col(corners[(k + 2) % 3]) - mesh.points().col(corners[(k + 1) % 3]);
    gradient += displacement.col(corners[k]) * normal.cross(opposite).transpose();
  }
  return gradient / (2 * mesh.triangleAreas()[triangle]);
}

}  // namespace

DisplacementGradients surfaceGradients(const SurfaceMesh& mesh,
                                       const Eigen::Matrix3Xd& displacement) {
  requireAtVertices(mesh, displacement, "displacement");
  DisplacementGradients result;
  result.gradient.reserve(mesh.triangleCount());
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    const Eigen::Matrix3d& gradient =
        result.gradient.emplace_back(gradientAlong(mesh, f, displacement));
    if (gradient.norm() <= result.largest) continue;  // Frobenius' norm is none the less
    const double norm = spectralNorm(gradient);
    if (norm <= result.largest) continue;
    result.largest = norm;
    result.triangle = f;
  }
  return result;
}

SurfaceFields surfaceFields(const ElasticModel& model, const Eigen::Matrix3Xd& displacement,
                            const Eigen::Matrix3Xd& traction) {
  const SurfaceMesh& mesh = model.mesh();
  requireAtVertices(mesh, displacement, "displacement");
  requireAtVertices(mesh, traction, "traction");
  const double shear = model.material().shearModulus(), nu = model.material().poissonRatio();
  const double side = model.domain() == Domain::Exterior ? -1 : 1;
  const Eigen::Matrix3Xd shares = supportShares(mesh, model.conditions(), model.smoothPatches());
  SurfaceFields fields;
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    const Eigen::Vector3d normal = side * mesh.triangleNormals().col(f);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) mean += shares(k, f) / 3 * traction.col(mesh.triangles()(k, f));
    const Eigen::Matrix3d along = gradientAlong(mesh, f, displacement);
    const Eigen::Vector3d sheared = mean / shear - along.transpose() * normal;
    // n . d from t . n = lambda (tr G + n . d) + 2 G n . d, in which lambda may be infinite.
    const double across =
        ((1 - 2 * nu) * mean.dot(normal) / shear - 2 * nu * along.trace()) / (2 * (1 - nu));
    const Eigen::Vector3d out = sheared - sheared.dot(normal) * normal + across * normal;
    const Eigen::Matrix3d gradient = along + out * normal.transpose();
    Eigen::Matrix3d stress = shear * (gradient + gradient.transpose());
    stress.diagonal().array() += mean.dot(normal) - normal.dot(stress * normal);
    fields.gradient.push_back(gradient);
    fields.stress.push_back(stress);
  }
  return fields;
}

double spectralNorm(const Eigen::Matrix3d& gradient) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> square(gradient.transpose() * gradient,
                                                              Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, square.eigenvalues()[2]));
}

double vonMisesStress(const Eigen::Matrix3d& stress) {
  const Eigen::Matrix3d deviator = stress - stress.trace() / 3 * Eigen::Matrix3d::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

Eigen::Vector3d principalStresses(const Eigen::Matrix3d& stress) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(stress, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .reverse();
}

}  // namespace palpate
