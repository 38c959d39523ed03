// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/surface_fields.h"

#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <utility>

#include "greens/probe_rows.h"
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

/// What is known at a triangle: its normal out of the material, the mean traction and the gradient
/// along the surface.
struct SurfaceState {
  Eigen::Vector3d normal, traction;
  Eigen::Matrix3d along;
};

/// @param complete  (triangle, state) -> (gradient, stress).
template <class Complete>
SurfaceFields fieldsOf(const ElasticModel& model, const Eigen::Matrix3Xd& displacement,
                       const Eigen::Matrix3Xd& traction, const Complete& complete) {
  const SurfaceMesh& mesh = model.mesh();
  requireAtVertices(mesh, displacement, "displacement");
  requireAtVertices(mesh, traction, "traction");
  const double side = model.domain() == Domain::Exterior ? -1 : 1;
  const Eigen::Matrix3Xd shares = supportShares(mesh, model.conditions(), model.smoothPatches());
  SurfaceFields fields;
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    SurfaceState at{side * mesh.triangleNormals().col(f), Eigen::Vector3d::Zero(),
                    gradientAlong(mesh, f, displacement)};
    for (int k = 0; k < 3; ++k)
      at.traction += shares(k, f) / 3 * traction.col(mesh.triangles()(k, f));
    const auto [gradient, stress] = complete(f, at);
    fields.gradient.push_back(gradient);
    fields.stress.push_back(stress);
  }
  return fields;
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
  const double shear = model.material().shearModulus(), nu = model.material().poissonRatio();
  return fieldsOf(model, displacement, traction, [&](int, const SurfaceState& at) {
    const Eigen::Vector3d sheared = at.traction / shear - at.along.transpose() * at.normal;
    const double normalTraction = at.traction.dot(at.normal);
    // n . d from t . n = lambda (tr G + n . d) + 2 G n . d, in which lambda may be infinite.
    const double across =
        ((1 - 2 * nu) * normalTraction / shear - 2 * nu * at.along.trace()) / (2 * (1 - nu));
    const Eigen::Vector3d out = sheared - sheared.dot(at.normal) * at.normal + across * at.normal;
    const Eigen::Matrix3d gradient = at.along + out * at.normal.transpose();
    Eigen::Matrix3d stress = shear * (gradient + gradient.transpose());
    stress.diagonal().array() += normalTraction - at.normal.dot(stress * at.normal);
    return std::pair(gradient, stress);
  });
}

SurfaceFields surfaceFields(const ElasticModel& model, const std::vector<Elasticity>& materials,
                            const Eigen::Matrix3Xd& displacement,
                            const Eigen::Matrix3Xd& traction) {
  if (static_cast<int>(materials.size()) != model.mesh().triangleCount())
    refuse("there are materials of ", materials.size(), " triangles, the surface has ",
           model.mesh().triangleCount());
  return fieldsOf(model, displacement, traction, [&](int f, const SurfaceState& at) {
    const Elasticity& material = materials[f];
    const double unit = material.stiffness().cwiseAbs().maxCoeff();
    const auto stressOf = [&](const Eigen::Matrix3d& gradient) {
      ProbeValues values = ProbeValues::Zero();
      values.segment<9>(3) = gradient.reshaped<Eigen::RowMajor>();
      return fieldOf(values, material.stiffness()).stress;
    };
    // Unknown are d and, over the unit, the pressure: t = stress n, and what it compresses.
    Eigen::Matrix4d system = Eigen::Matrix4d::Identity();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (int k = 0; k < 3; ++k)
      system.block<3, 1>(0, k) =
          stressOf(Eigen::Vector3d::Unit(k) * at.normal.transpose()) * at.normal / unit;
    right.head<3>() = (at.traction - stressOf(at.along) * at.normal) / unit;
    if (material.isSplit()) {
      system.topRightCorner<3, 1>() = at.normal;
      system.bottomRows<1>() << at.normal.transpose(), -material.compressibility() * unit;
      right[3] = -at.along.trace();
    }
    const Eigen::Vector4d found = system.partialPivLu().solve(right);
    const Eigen::Matrix3d gradient = at.along + found.head<3>() * at.normal.transpose();
    Eigen::Matrix3d stress = stressOf(gradient);
    stress.diagonal().array() += unit * found[3];
    return std::pair(gradient, stress);
  });
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
