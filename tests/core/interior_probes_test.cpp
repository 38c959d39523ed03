// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/interior_probes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>

#include "bem/probe_kernels.h"
#include "support/problems.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

ElasticModel sphere(int levels, double poissonRatio, Domain domain = Domain::Interior) {
  const Place nowhere = [](const Vector3d&) { return false; };
  return makeModel(icosphere(levels), domain == Domain::Interior ? Place(cap) : nowhere, 3,
                   poissonRatio, 30, domain);
}

ProbedField probed(const ElasticModel& model, const Vector3d& point, const Matrix3Xd& displacement,
                   const Matrix3Xd& traction) {
  return InteriorProbes(model, point).evaluate(displacement, traction)[0];
}

class ProbeKernelsAt : public testing::TestWithParam<double> {};

TEST_P(ProbeKernelsAt, APoissonRatioAreTheDerivativesOfKelvins) {
  const double nu = GetParam(), shear = 1.7, step = 1e-5;
  const Vector3d r(0.4, -0.7, 0.5), normal = Vector3d(1, 2, -1).normalized();
  const bem::ProbeKernels found = bem::probeKernels(r, normal, shear, nu);
  const Matrix3d u = bem::kelvinDisplacement(r, shear, nu), t = bem::kelvinTraction(r, normal, nu);
  EXPECT_EQ(Matrix3d(found.ofTraction.topRows<3>()), u);
  EXPECT_EQ(Matrix3d(found.ofDisplacement.topRows<3>()), -t);
  for (int k = 0; k < 3; ++k) {
    // r shrinks as the point moves on.
    const Vector3d on = r - step * Vector3d::Unit(k), back = r + step * Vector3d::Unit(k);
    const Matrix3d du =
        (bem::kelvinDisplacement(on, shear, nu) - bem::kelvinDisplacement(back, shear, nu)) /
        (2 * step);
    const Matrix3d dt =
        (bem::kelvinTraction(on, normal, nu) - bem::kelvinTraction(back, normal, nu)) / (2 * step);
    for (int i = 0; i < 3; ++i) {  // central differences err by step^2, rounding / step
      EXPECT_LT((found.ofTraction.row(3 + 3 * i + k) - du.row(i)).norm(), 1e-8);
      EXPECT_LT((found.ofDisplacement.row(3 + 3 * i + k) + dt.row(i)).norm(), 1e-8);
    }
  }
  const auto divergence = [](const bem::ProbeBlock& block) -> Eigen::RowVector3d {
    return block.row(3) + block.row(7) + block.row(11);
  };
  const double young = 2 * shear * (1 + nu), share = 3 * (1 - 2 * nu) / young;
  EXPECT_LT((share * found.ofTraction.row(12) - divergence(found.ofTraction)).norm(), 1e-14);
  EXPECT_LT((share * found.ofDisplacement.row(12) - divergence(found.ofDisplacement)).norm(),
            1e-14);
}

INSTANTIATE_TEST_SUITE_P(Of, ProbeKernelsAt, testing::Values(-0.5, 0.0, 0.3, 0.49, 0.5));

TEST(InteriorProbes, SeeRigidMotionsExactlyHoweverNearTheSurface) {
  const ElasticModel model = sphere(2, 0.3);
  const SurfaceMesh& mesh = model.mesh();
  const Vector3d turn(0.2, -0.3, 0.5), shift(1, 2, 3);
  Matrix3Xd displacement(3, mesh.vertexCount());
  for (int v = 0; v < mesh.vertexCount(); ++v)
    displacement.col(v) = shift + turn.cross(mesh.points().col(v));
  const Vector3d middle = mesh.points()(Eigen::all, mesh.triangles().col(0)).rowwise().mean();
  for (double depth : {1.0, 0.3, 0.1, 0.01, 1e-3}) {
    const Vector3d point = middle - depth * mesh.meanEdgeLength() * mesh.triangleNormals().col(0);
    const InteriorProbes probes(model, point);
    EXPECT_NEAR(probes.distances()[0], depth, 1e-9);
    const ProbedField field =
        probes.evaluate(displacement, Matrix3Xd::Zero(3, mesh.vertexCount()))[0];
    const Matrix3d skew =
        (Matrix3d() << 0, -turn.z(), turn.y(), turn.z(), 0, -turn.x(), -turn.y(), turn.x(), 0)
            .finished();
    // The rules' errors, 1e-7 of each piece's share; gradients over the distance.
    EXPECT_LT((field.displacement - shift - turn.cross(point)).norm(), 1e-5) << depth;
    EXPECT_LT((field.gradient - skew).norm(), 1e-4 / depth) << depth;
    EXPECT_LT(field.stress.norm(), 3e-4 / depth) << depth;
  }
}

/// Of the point force (0.3, -0.5, 1) at (0.3, 0.4, 1.9), as pointSourceField.
ProbedField exactField(const Material& material, const Vector3d& x) {
  const Vector3d force(0.3, -0.5, 1), at(0.3, 0.4, 1.9);
  const auto displacement = [&](const Vector3d& y) -> Vector3d {
    return bem::kelvinDisplacement(y - at, material.shearModulus(), material.poissonRatio()) *
           force;
  };
  ProbedField field;
  field.displacement = displacement(x);
  for (int k = 0; k < 3; ++k) {
    constexpr double step = 1e-4;
    field.gradient.col(k) =
        (displacement(x + step * Vector3d::Unit(k)) - displacement(x - step * Vector3d::Unit(k))) /
        (2 * step);
    field.stress.col(k) =
        bem::kelvinTraction(x - at, Vector3d::Unit(k), material.poissonRatio()).transpose() * force;
  }
  return field;
}

class InteriorProbesOf : public testing::TestWithParam<double> {};

TEST_P(InteriorProbesOf, APointSourceConvergeWithTheSquareOfTheEdges) {
  const Vector3d point(0.2, -0.1, 0.35);
  Eigen::Vector3d errors[2];
  for (int level : {2, 3}) {
    const ElasticModel model = sphere(level, GetParam());
    const NodalField field = pointSourceField(model);
    const ProbedField found = probed(model, point, field.displacement, field.traction);
    const ProbedField exact = exactField(model.material(), point);
    errors[level - 2] = {
        (found.displacement - exact.displacement).norm() / exact.displacement.norm(),
        (found.gradient - exact.gradient).norm() / exact.gradient.norm(),
        (found.stress - exact.stress).norm() / exact.stress.norm()};
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT(errors[1][k], 0.02) << k;
    EXPECT_GT(convergenceOrder(errors[0][k], 162, errors[1][k], 642), 1.7) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(PoissonRatios, InteriorProbesOf, testing::Values(0.0, 0.3, 0.499, 0.5));

TEST(InteriorProbes, AroundACavityUnderPressureSeeLamesField) {
  const ElasticModel model = sphere(3, 0.3, Domain::Exterior);
  const double pressure = 0.7, shear = model.material().shearModulus();
  const Matrix3Xd displacement = pressure / (4 * shear) * model.mesh().points();
  const Matrix3Xd traction = pressure * model.mesh().points();
  const Vector3d direction = Vector3d(1, -2, 2).normalized();
  for (double radius : {1.5, 2.0, 4.0}) {
    const ProbedField field = probed(model, radius * direction, displacement, traction);
    const double fade = 1 / (radius * radius);
    EXPECT_NEAR(field.displacement.dot(direction) / (pressure / (4 * shear) * fade), 1, 0.02);
    EXPECT_NEAR(direction.dot(field.stress * direction) / (-pressure * fade / radius), 1, 0.02);
  }
}

TEST(InteriorProbes, RefusePlacesWhereNoMaterialIs) {
  const ElasticModel body = sphere(1, 0.3), cavity = sphere(1, 0.3, Domain::Exterior);
  const SurfaceMesh& mesh = body.mesh();
  const Vector3d onSurface = mesh.points()(Eigen::all, mesh.triangles().col(0)).rowwise().mean();
  EXPECT_TRUE(isRefused([&] { InteriorProbes(body, Vector3d(0, 0, 1.2)); },
                        "probe 0 at (0, 0, 1.2) is not inside the material"));
  EXPECT_TRUE(isRefused([&] { InteriorProbes(cavity, Vector3d::Zero()); }, "is not inside"));
  EXPECT_TRUE(isRefused([&] { InteriorProbes(body, onSurface); }, "lies on the surface"));
  EXPECT_TRUE(isRefused([&] { InteriorProbes(body, Vector3d(0, NAN, 0)); }, "finite place"));
  const InteriorProbes sound(body, Vector3d(0, 0, 0.1));
  EXPECT_TRUE(isRefused([&] { sound.evaluate(Matrix3Xd(3, 1), Matrix3Xd(3, 42)); },
                        "at 42 vertices, not at 1 and 42"));
}

TEST(InteriorProbes, ReportProgressAndCanBeAborted) {
  const ElasticModel model = sphere(1, 0.3);
  double last = 0;
  InteriorProbes(model, Matrix3Xd::Zero(3, 5), [&](double fraction, const char*) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return true;
  });
  EXPECT_EQ(last, 1);
  EXPECT_THROW(
      InteriorProbes(model, Matrix3Xd::Zero(3, 5), [](double, const char*) { return false; }),
      Aborted);
}

}  // namespace
}  // namespace palpate::test
