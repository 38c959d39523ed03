// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/influence_panels.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/influence.h"
#include "support/problems.h"

namespace palpate::test {
namespace {

struct Case {
  const char* name;
  Shape shape;
  double tolerance, limit;
  Collocation collocation;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name << " to " << c.tolerance;
}

/// Every triangle a patch of its own, so that face-wise tractions t = sigma n are exact.
ElasticModel faceted(const Shape& shape, double nu) {
  const auto mesh = shape.mesh();
  std::vector<unsigned char> types(mesh->vertexCount(), 1);
  types[0] = 0;
  Eigen::VectorXi patches(mesh->triangleCount());
  for (int f = 0; f < patches.size(); ++f) patches[f] = f;
  return ElasticModel(mesh, Material(1, nu), BoundaryConditions(types), patches);
}

class LinearField : public testing::TestWithParam<Case> {};

/// A3: H u = G t for a linear displacement and its tractions on any closed polyhedron.
TEST_P(LinearField, SatisfiesTheBoundaryIntegralEquation) {
  const double nu = 0.3, lambda = 2 * nu / (1 - 2 * nu);  // unit shear modulus
  const bem::BodySurface body(faceted(GetParam().shape, nu), 0);
  const bem::CollocationScheme scheme(body, GetParam().collocation);
  const InfluenceMatrices matrices(body, scheme, GetParam().tolerance);
  Eigen::Matrix3d gradient;
  gradient << 0.3, 0.5, -0.2, 0.1, -0.4, 0.7, 0.6, 0.2, 0.9;
  const Eigen::Matrix3d strain = (gradient + gradient.transpose()) / 2;
  const Eigen::Matrix3d stress = 2 * strain + lambda * strain.trace() * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3Xd displacement = gradient * body.points;
  Eigen::Matrix3Xd traction(3, body.nodes.count());
  for (int f = 0; f < body.triangleCount(); ++f)
    for (int k = 0; k < 3; ++k)
      traction.col(body.nodes.ofCorner(k, f)) = stress * body.normals.col(f);
  const Eigen::VectorXd right = matrices.g * traction.reshaped();
  EXPECT_LT((matrices.h * displacement.reshaped() - right).lpNorm<Eigen::Infinity>(),
            GetParam().limit * right.lpNorm<Eigen::Infinity>());
}

/// A4: H annihilates rotations; translations it annihilates by construction.
TEST_P(LinearField, RigidMotionsNeedNoTraction) {
  const bem::BodySurface body(faceted(GetParam().shape, 0.3), 0);
  const bem::CollocationScheme scheme(body, GetParam().collocation);
  const InfluenceMatrices matrices(body, scheme, GetParam().tolerance);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d e = Eigen::Vector3d::Unit(axis);
    Eigen::Matrix3Xd shift(3, body.vertexCount()), turn = shift;
    for (int v = 0; v < body.vertexCount(); ++v) {
      shift.col(v) = e;
      turn.col(v) = e.cross(body.points.col(v));
    }
    EXPECT_LT((matrices.h * shift.reshaped()).lpNorm<Eigen::Infinity>(), 1e-13);
    EXPECT_LT((matrices.h * turn.reshaped()).lpNorm<Eigen::Infinity>(), GetParam().limit);
  }
}

Shape ellipsoid() {
  return icosphere(3).mapped(
      [](const auto& x) { return Eigen::Vector3d(2 * x.x(), x.y(), x.z() / 2); });
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, LinearField,
    testing::Values(
        Case{"sphere", icosphere(3), 1e-6, 1e-6, Collocation::Vertex},
        Case{"sphere", icosphere(3), 0, 1e-10, Collocation::Vertex},
        Case{"sphere", icosphere(3), 1e-6, 1e-6, Collocation::Averaged},
        Case{"jittered", jitteredSphere(3, 0.35), 1e-6, 1e-6, Collocation::Averaged},
        Case{"ellipsoid", ellipsoid(), 1e-6, 1e-6, Collocation::Averaged},
        Case{"ellipsoid", ellipsoid(), 0, 1e-10, Collocation::Averaged},
        Case{"cube", box({1, 1, 1}, {6, 6, 6}), 1e-6, 1e-6, Collocation::Averaged},
        Case{"cube", box({1, 1, 1}, {6, 6, 6}), 0, 1e-10, Collocation::Averaged},
        Case{"plate 1:100", box({1, 1, 0.01}, {10, 10, 1}), 1e-6, 1e-6, Collocation::Averaged},
        Case{"plate 1:100", box({1, 1, 0.01}, {10, 10, 1}), 0, 1e-10, Collocation::Vertex},
        Case{"torus", torus(1, 0.3, 24, 10), 1e-6, 1e-6, Collocation::Averaged},
        Case{"thick sphere", icosphere(2).scaled(2).with(icosphere(2).flipped()), 1e-6, 1e-6,
             Collocation::Averaged}));

TEST(InfluencePanels, NeedlesDownToAMillionthOfAnEdgeKeepTheLinearField) {
  // A vertex pulled to within 1e-6 of its neighbour makes needles around it.
  Shape shape = icosphere(2);
  const int a = shape.triangles(0, 0), b = shape.triangles(1, 0);
  shape.points.col(b) = shape.points.col(a) + 1e-6 * (shape.points.col(b) - shape.points.col(a));
  const bem::BodySurface body(faceted(shape, 0.3), 0);
  const bem::CollocationScheme scheme(body, Collocation::Averaged);
  const InfluenceMatrices matrices(body, scheme, 1e-6);
  EXPECT_TRUE(matrices.h.allFinite());
  EXPECT_TRUE(matrices.g.allFinite());
  Eigen::Matrix3Xd turn(3, body.vertexCount());
  for (int v = 0; v < turn.cols(); ++v)
    turn.col(v) = Eigen::Vector3d::UnitY().cross(body.points.col(v));
  EXPECT_LT((matrices.h * turn.reshaped()).lpNorm<Eigen::Infinity>(), 1e-5);
}

TEST(InfluencePanels, ExteriorMatrixIsOneMinusTheInterior) {
  const Shape shape = icosphere(2);
  const auto most = [](const Eigen::Vector3d& x) { return x.z() < 0.9; };
  const bem::BodySurface inside(makeModel(shape, most, 1, 0.3), 0);
  const bem::BodySurface outside(makeModel(shape, most, 1, 0.3, 30, Domain::Exterior), 0);
  const bem::CollocationScheme scheme(inside, Collocation::Vertex);
  const InfluenceMatrices a(inside, scheme, 1e-6), b(outside, scheme, 1e-6);
  Eigen::MatrixXd identity = Eigen::MatrixXd::Zero(a.h.rows(), a.h.cols());
  for (int e = 0; e < scheme.equationCount(); ++e)
    identity.block<3, 3>(3 * e, 3 * scheme.equations[e].vertex).setIdentity();
  EXPECT_LT((a.h + b.h - identity).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((a.g - b.g).cwiseAbs().maxCoeff(), 1e-16);
}

}  // namespace
}  // namespace palpate::test
