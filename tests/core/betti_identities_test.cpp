// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/betti_identities.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/problems.h"

namespace palpate::test {
namespace {

using bem::BettiIdentity;

bem::BodySurface bodyOf(const Shape& shape, double nu, Domain domain = Domain::Interior) {
  const auto mesh = shape.mesh();
  std::vector<unsigned char> types(mesh->vertexCount(), 1);
  types[0] = 0;
  Eigen::VectorXi patches(mesh->triangleCount());
  for (int f = 0; f < patches.size(); ++f) patches[f] = f;
  return bem::BodySurface(
      ElasticModel(mesh, Material(1, nu), BoundaryConditions(types), patches, domain), 0);
}

/// |t_w . u - w . p| of a linear field, over the size of its parts.
double defectOfLinearField(const bem::BodySurface& body, const BettiIdentity& identity) {
  const double nu = body.poissonRatio;
  Eigen::Matrix3d gradient;
  gradient << 0.2, 0.1, -0.3, 0.4, 0.5, 0.1, -0.2, 0.3, 0.7;
  if (nu == 0.5) gradient -= gradient.trace() / 3 * Eigen::Matrix3d::Identity();
  const double lambda = nu == 0.5 ? 0 : 2 * nu / (1 - 2 * nu);
  const Eigen::Matrix3d strain = (gradient + gradient.transpose()) / 2;
  const Eigen::Matrix3d stress = 2 * strain + lambda * strain.trace() * Eigen::Matrix3d::Identity();
  double work = 0, size = 0;
  for (int v = 0; v < body.vertexCount(); ++v) {
    const double part = identity.displacement.col(v).dot(gradient * body.points.col(v));
    work += part;
    size += std::abs(part);
  }
  for (int f = 0; f < body.triangleCount(); ++f)
    for (int k = 0; k < 3; ++k) {
      const double part =
          identity.traction.col(body.nodes.ofCorner(k, f)).dot(stress * body.normals.col(f));
      work -= part;
      size += std::abs(part);
    }
  return std::abs(work) / size;
}

class BettiIdentities : public testing::TestWithParam<double> {};

TEST_P(BettiIdentities, HoldForLinearFieldsOnPolyhedraToRounding) {
  for (const Shape& shape :
       {icosphere(2), box({1, 2, 1}, {3, 5, 3}),
        icosphere(2).scaled(2).with(icosphere(2).flipped()), torus(1, 0.3, 16, 8)}) {
    const bem::BodySurface body = bodyOf(shape, GetParam());
    const bem::CollocationScheme scheme(body, Collocation::Averaged);
    for (const BettiIdentity& identity : bem::bettiIdentities(body, scheme))
      EXPECT_LT(defectOfLinearField(body, identity), 1e-9);  // quadrature of the cavity's state
  }
}

TEST_P(BettiIdentities, HaveOrthonormalWeights) {
  const bem::BodySurface body =
      bodyOf(icosphere(2).scaled(2).with(icosphere(1).flipped()), GetParam());
  const bem::CollocationScheme scheme(body, Collocation::Averaged);
  const std::vector<BettiIdentity> identities = bem::bettiIdentities(body, scheme);
  ASSERT_EQ(identities.size(), 8u);  // two shells, six motions
  for (std::size_t a = 0; a < identities.size(); ++a)
    for (std::size_t b = 0; b <= a; ++b)
      EXPECT_NEAR(identities[a].weights.cwiseProduct(identities[b].weights).sum(), a == b, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Materials, BettiIdentities, testing::Values(-0.5, 0.0, 0.3, 0.4999, 0.5));

TEST(BettiIdentities, AreTheVolumesAloneInAnExteriorDomainAndInVertexCollocation) {
  const Shape two = icosphere(1).with(icosphere(1).moved({5, 0, 0}));
  const bem::BodySurface outside = bodyOf(two, 0.3, Domain::Exterior);
  EXPECT_EQ(bem::bettiIdentities(outside, {outside, Collocation::Averaged}).size(), 2u);
  const bem::BodySurface inside = bodyOf(icosphere(1), 0.3);
  EXPECT_EQ(bem::bettiIdentities(inside, {inside, Collocation::Vertex}).size(), 1u);
}

}  // namespace
}  // namespace palpate::test
