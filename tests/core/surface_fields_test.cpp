// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/surface_fields.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "greens/probe_rows.h"
#include "support/problems.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

const Place base = [](const Vector3d& x) { return x.z() < 1e-9; };

/// Whether the triangle's corners are inside one side of the unit cube, where each vertex has one
/// normal.
bool isInsideASide(const SurfaceMesh& mesh, int triangle) {
  for (int corner : mesh.triangles().col(triangle)) {
    const Eigen::Array3d x = mesh.points().col(corner);
    if ((x < 1e-9 || x > 1 - 1e-9).count() != 1) return false;
  }
  return true;
}

class SurfaceFieldsOf : public testing::TestWithParam<double> {};

TEST_P(SurfaceFieldsOf, AUniformStateAreExact) {
  const ElasticModel model = makeModel(box({1, 1, 1}, {5, 5, 5}), base, 3, GetParam());
  const SurfaceMesh& mesh = model.mesh();
  const double shear = model.material().shearModulus(), nu = GetParam();
  Matrix3d gradient;
  gradient << 0.01, -0.03, 0.02, 0.05, 0.02, 0.01, 0.04, -0.02, -0.03;  // no change of volume
  double pressure = 0.4;                                                // of nu = 0.5
  if (nu < 0.5) {
    gradient(0, 0) += 0.02;
    pressure = -2 * shear * nu / (1 - 2 * nu) * gradient.trace();
  }
  const Matrix3d stress =
      shear * (gradient + gradient.transpose()) - pressure * Matrix3d::Identity();
  const Matrix3Xd displacement = gradient * mesh.points();
  Matrix3Xd traction = Matrix3Xd::Zero(3, mesh.vertexCount());
  for (int f = 0; f < mesh.triangleCount(); ++f)
    if (isInsideASide(mesh, f))
      for (int corner : mesh.triangles().col(f))
        traction.col(corner) = stress * mesh.triangleNormals().col(f);
  const SurfaceFields found = surfaceFields(model, displacement, traction);
  int seen = 0;
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    if (!isInsideASide(mesh, f)) continue;
    ++seen;
    EXPECT_LT((found.gradient[f] - gradient).norm(), 1e-13) << f;
    EXPECT_LT((found.stress[f] - stress).norm(), 1e-12) << f;
  }
  EXPECT_EQ(seen, 6 * 18);
  const std::vector<Elasticity> same(mesh.triangleCount(), Elasticity(model.material()));
  const SurfaceFields again = surfaceFields(model, same, displacement, traction);
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    EXPECT_LT((again.gradient[f] - found.gradient[f]).norm(), 1e-12) << f;
    EXPECT_LT((again.stress[f] - found.stress[f]).norm(), 1e-12) << f;
  }
}

TEST(SurfaceFields, OfFibresAcrossTheAxesAreExactInAUniformState) {
  const ElasticModel model = makeModel(box({1, 1, 1}, {4, 4, 4}), base, 1, 0.3);
  const SurfaceMesh& mesh = model.mesh();
  const Elasticity fibres = Elasticity::transverselyIsotropic({1, 2, -1}, 9, 0.25, 2, 0.4, 1.5);
  Matrix3d gradient;
  gradient << 0.01, -0.03, 0.02, 0.05, 0.02, 0.01, 0.04, -0.02, -0.03;
  ProbeValues values = ProbeValues::Zero();
  values.segment<9>(3) = gradient.reshaped<Eigen::RowMajor>();
  const Matrix3d stress = fieldOf(values, fibres.stiffness()).stress;
  Matrix3Xd traction = Matrix3Xd::Zero(3, mesh.vertexCount());
  for (int f = 0; f < mesh.triangleCount(); ++f)
    if (isInsideASide(mesh, f))
      for (int corner : mesh.triangles().col(f))
        traction.col(corner) = stress * mesh.triangleNormals().col(f);
  const std::vector<Elasticity> materials(mesh.triangleCount(), fibres);
  const SurfaceFields found = surfaceFields(model, materials, gradient * mesh.points(), traction);
  int seen = 0;
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    if (!isInsideASide(mesh, f)) continue;
    ++seen;
    EXPECT_LT((found.gradient[f] - gradient).norm(), 1e-12) << f;
    EXPECT_LT((found.stress[f] - stress).norm(), 1e-12) << f;
  }
  EXPECT_GT(seen, 0);
  EXPECT_TRUE(isRefused([&] { surfaceFields(model, {fibres}, traction, traction); },
                        "materials of 1 triangles, the surface has 192"));
}

INSTANTIATE_TEST_SUITE_P(PoissonRatios, SurfaceFieldsOf,
                         testing::Values(-0.3, 0.0, 0.3, 0.499, 0.5));

TEST(SurfaceFields, OfACavityUnderPressureAreLames) {
  const Place nowhere = [](const Vector3d&) { return false; };
  const ElasticModel model = makeModel(icosphere(3), nowhere, 1, 0.3, 30, Domain::Exterior);
  const SurfaceMesh& mesh = model.mesh();
  const double shear = model.material().shearModulus();
  const SurfaceFields found = surfaceFields(model, 1 / (4 * shear) * mesh.points(), mesh.points());
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    // -p out of the wall, p / 2 along it; facets stand off the sphere by 1 %.
    const Vector3d stresses = principalStresses(found.stress[f]);
    EXPECT_NEAR(stresses[0], 0.5, 0.02);
    EXPECT_NEAR(stresses[1], 0.5, 0.02);
    EXPECT_NEAR(stresses[2], -1, 0.02);
    EXPECT_NEAR(vonMisesStress(found.stress[f]), 1.5, 0.03);
  }
}

TEST(DisplacementGradients, AreAlongTheSurfaceAndTheLargestIsNamed) {
  const ElasticModel model = makeModel(box({1, 1, 1}, {3, 3, 3}), base, 1, 0.3);
  const SurfaceMesh& mesh = model.mesh();
  Matrix3d gradient = Matrix3d::Zero();
  gradient(1, 0) = 0.25;  // y moves with x
  const DisplacementGradients found = surfaceGradients(mesh, gradient * mesh.points());
  EXPECT_NEAR(found.largest, 0.25, 1e-14);
  EXPECT_LT(std::abs(mesh.triangleNormals()(0, found.triangle)), 1e-9) << "where x runs along it";
  for (int f = 0; f < mesh.triangleCount(); ++f) {
    const Vector3d normal = mesh.triangleNormals().col(f);
    const Matrix3d along = gradient * (Matrix3d::Identity() - normal * normal.transpose());
    EXPECT_LT((found.gradient[f] - along).norm(), 1e-14);
  }
  // A turn by 0.2 is none of strain, but out of reach of linear theory all the same.
  Matrix3Xd turned = mesh.points();
  for (auto u : turned.colwise()) u = Vector3d(0, 0, 0.2).cross(Vector3d(u));
  EXPECT_NEAR(surfaceGradients(mesh, turned).largest, 0.2, 1e-14);
  EXPECT_TRUE(isRefused([&] { surfaceGradients(mesh, Matrix3Xd(3, 2)); }, "not at 2"));
}

TEST(VonMisesStress, IsThatOfTensionAndNoneOfPressure) {
  EXPECT_NEAR(vonMisesStress(Vector3d(3, 0, 0).asDiagonal()), 3, 1e-15);
  EXPECT_EQ(vonMisesStress(Matrix3d::Identity()), 0);
  Matrix3d shear = Matrix3d::Zero();
  shear(0, 1) = shear(1, 0) = 2;
  EXPECT_NEAR(vonMisesStress(shear), 2 * std::sqrt(3), 1e-15);
  EXPECT_LT((principalStresses(shear) - Vector3d(2, 0, -2)).norm(), 1e-14);
}

}  // namespace
}  // namespace palpate::test
