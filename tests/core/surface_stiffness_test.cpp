// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/surface_stiffness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "contact/capacitance_matrix.h"
#include "support/contact_bodies.h"
#include "support/mask_compliances.h"
#include "support/refusals.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

// Inverting a 3 by 3 matrix of condition below 1e2.
constexpr double kRounding = 1e-13;

class SurfaceStiffnessOfASphere : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    raw_ = new TouchedBody(touchedSphere(2, false));
    reciprocal_ = new TouchedBody(touchedSphere(2, true));
  }
  static void TearDownTestSuite() {
    delete raw_;
    delete reciprocal_;
  }

  static SurfaceStiffness stiffnessOf(const TouchedBody& body, double radiusInEdges,
                                      double rigidStiffness = 0) {
    return {body.greens, body.mesh, MaskShape::Linear, radiusInEdges * body.mesh->meanEdgeLength(),
            rigidStiffness};
  }

  static SurfaceStiffness byTheMean(const TouchedBody& body, MaskShape shape, double radius) {
    return {body.greens,
            body.mesh,
            PressureMasks(*body.mesh, body.greens->info().conditions, shape, radius),
            {0, DisplacementMeasure::Mean}};
  }

  Eigen::Vector3d randomPlace() {
    Eigen::Vector3d barycentric = randomVectors(1, random_).cwiseAbs();
    return barycentric / barycentric.sum();
  }

  static TouchedBody *raw_, *reciprocal_;
  std::mt19937 random_{31};
};
TouchedBody* SurfaceStiffnessOfASphere::raw_ = nullptr;
TouchedBody* SurfaceStiffnessOfASphere::reciprocal_ = nullptr;

TEST_F(SurfaceStiffnessOfASphere, IsTheInverseOfTheNearestSymmetricCompliance) {
  for (const TouchedBody* body : {raw_, reciprocal_})
    for (double radius : {0.0, 1.5, 3.0}) {
      const SurfaceStiffness stiffness = stiffnessOf(*body, radius);
      for (int v : body->greens->info().conditions.freeNodes()) {
        const Eigen::Matrix3d b = vertexCompliance(*body->greens, v, stiffness.mask(v));
        const Eigen::Matrix3d m = meanCompliance(*body->greens, stiffness.mask(v));
        const Eigen::Matrix3d s = stiffness.elastic(v).inverse();
        // |(B - S) M^-1|^2 is stationary in S.
        const Eigen::Matrix3d gradient = (b - s) * (m * m).inverse();
        EXPECT_LE((gradient + gradient.transpose()).norm(), kRounding * m.inverse().norm());
        EXPECT_NEAR(stiffness.asymmetry(v), (b - b.transpose()).norm() / b.norm(), kRounding);
        if (body == reciprocal_ && radius == 0) {
          EXPECT_LE((s - b).norm(), kRounding * b.norm());
        }
      }
    }
}

TEST_F(SurfaceStiffnessOfASphere, OfTheMeanDisplacementNeedsNoSymmetrising) {
  // Reciprocal Green's functions: K is the inverse of the mask's own compliance, as it stands.
  for (MaskShape shape : {MaskShape::Linear, MaskShape::Hertzian})
    for (double radius : {0.0, 0.4, 0.8}) {
      const SurfaceStiffness stiffness = byTheMean(*reciprocal_, shape, radius);
      EXPECT_EQ(stiffness.measure(), DisplacementMeasure::Mean);
      for (int v : reciprocal_->greens->info().conditions.freeNodes()) {
        EXPECT_LE(stiffness.asymmetry(v), 1e-13);
        EXPECT_FALSE(stiffness.isLimited(v));
        const Eigen::Matrix3d m = meanCompliance(*reciprocal_->greens, stiffness.mask(v));
        EXPECT_LE((m * stiffness.elastic(v) - Eigen::Matrix3d::Identity()).norm(), 1e-11);
      }
    }
}

TEST_F(SurfaceStiffnessOfASphere, OfTheMeanDisplacementIsTwiceTheEnergyOfTheBody) {
  // Half of u K u is what the mask's tractions do on the surface's displacements, all of them.
  const SurfaceStiffness stiffness = byTheMean(*reciprocal_, MaskShape::Linear, 0.6);
  for (int v : reciprocal_->greens->info().conditions.freeNodes()) {
    const Eigen::Vector3d force = stiffness.elastic(v) * randomDirection(random_);
    Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, reciprocal_->mesh->vertexCount());
    const VertexMask& mask = stiffness.mask(v);
    for (std::size_t j = 0; j < mask.nodes.size(); ++j)
      given.col(mask.nodes[j]) = mask.density[j] * force;
    const Eigen::Matrix3Xd moved = solveReferenceProblem(*reciprocal_->greens, given);
    double work = 0;
    for (int node : mask.nodes)
      work += reciprocal_->mesh->vertexAreas()[node] * given.col(node).dot(moved.col(node));
    EXPECT_NEAR(force.dot(stiffness.elastic(v).inverse() * force) / work, 1, 1e-11);
  }
}

TEST_F(SurfaceStiffnessOfASphere, OfOneVertexIsTheSameByEitherMeasure) {
  const SurfaceStiffness own = stiffnessOf(*reciprocal_, 0);
  const SurfaceStiffness mean = byTheMean(*reciprocal_, MaskShape::Linear, 0);
  for (int v = 0; v < reciprocal_->mesh->vertexCount(); ++v)
    EXPECT_LE(relativeDifference(mean.elastic(v), own.elastic(v)), 1e-12);
}

TEST_F(SurfaceStiffnessOfASphere, OfTheMeanKeepsItsMeasureWhenItsModulusChanges) {
  const SurfaceStiffness one = byTheMean(*reciprocal_, MaskShape::Linear, 0.6);
  const auto stiffer = one.withYoungsModulus(25)->withRigidStiffness(3);
  EXPECT_EQ(stiffer->measure(), DisplacementMeasure::Mean);
  for (int v : reciprocal_->greens->info().conditions.freeNodes())
    EXPECT_LE(relativeDifference(stiffer->elastic(v), 10 * one.elastic(v)), kRounding);
}

TEST_F(SurfaceStiffnessOfASphere, IsSymmetricPositiveDefiniteEverywhere) {
  for (const TouchedBody* body : {raw_, reciprocal_})
    for (double radius : {0.0, 2.0}) {
      const SurfaceStiffness stiffness = stiffnessOf(*body, radius, 5);
      for (int v = 0; v < body->mesh->vertexCount(); ++v)
        for (const Eigen::Matrix3d& k : {stiffness.elastic(v), stiffness.haptic(v)}) {
          EXPECT_LE((k - k.transpose()).norm(), 1e-12 * k.norm());
          EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(k).eigenvalues()[0],
                    1e-3 * k.norm());
        }
    }
}

TEST_F(SurfaceStiffnessOfASphere, OfOneVertexIsThatOfItsCapacitanceMatrix) {
  const SurfaceStiffness stiffness = stiffnessOf(*reciprocal_, 0);
  for (int v : reciprocal_->greens->info().conditions.freeNodes()) {
    // K = -a C^-1, section 5.2
    const CapacitanceMatrix c(reciprocal_->greens, switchesOfNodes({v}));
    const Eigen::Matrix3d expected = -reciprocal_->mesh->vertexAreas()[v] * c.inverse();
    EXPECT_LE(relativeDifference(stiffness.elastic(v), expected), 1e-12);
    EXPECT_LE(stiffness.asymmetry(v), 1e-15) << "reciprocal Green's functions";
  }
}

TEST_F(SurfaceStiffnessOfASphere, AForceSpreadByTheMaskMovesTheVertexByItsInverse) {
  for (double radius : {0.0, 2.0}) {
    const SurfaceStiffness stiffness = stiffnessOf(*reciprocal_, radius);
    for (int v : {0, 40, 99}) {
      if (reciprocal_->greens->isFixed(v)) continue;
      const Eigen::Vector3d force = randomDirection(random_);
      // The whole solution zeta f, p_j = rho_j f
      Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, reciprocal_->mesh->vertexCount());
      const VertexMask& mask = stiffness.mask(v);
      for (std::size_t j = 0; j < mask.nodes.size(); ++j)
        given.col(mask.nodes[j]) = mask.density[j] * force;
      const Eigen::Vector3d moved = solveReferenceProblem(*reciprocal_->greens, given).col(v);
      const Eigen::Vector3d expected = stiffness.elastic(v).inverse() * force;
      // What is served leaves out the asymmetry of the mask's compliance B, half of |B - B^T|.
      const double left =
          stiffness.asymmetry(v) / 2 * vertexCompliance(*reciprocal_->greens, v, mask).norm();
      EXPECT_LE((moved - expected).norm(), left + 1e-12 * expected.norm());
      EXPECT_LE(stiffness.asymmetry(v), 0.05);
    }
  }
}

TEST_F(SurfaceStiffnessOfASphere, OfFixedVerticesIsTheRigidOne) {
  for (double rigid : {0.0, 3.0}) {
    const SurfaceStiffness stiffness = stiffnessOf(*reciprocal_, 2, rigid);
    double stiffest = 0;
    for (int v : reciprocal_->greens->info().conditions.freeNodes())
      stiffest = std::max(stiffest, stiffness.elastic(v).norm());
    if (rigid == 0)  // the default: |K^R| = sqrt(3) k_Rigid is that of the stiffest elastic vertex
      EXPECT_NEAR(std::sqrt(3.0) * stiffness.rigidStiffness() / stiffest, 1, 1e-15);
    else
      EXPECT_EQ(stiffness.rigidStiffness(), rigid);
    for (int v : reciprocal_->greens->info().conditions.fixedNodes()) {
      EXPECT_EQ(stiffness.elastic(v), stiffness.rigidStiffness() * Eigen::Matrix3d::Identity());
      EXPECT_EQ(stiffness.hapticRatio(v), 1);
      EXPECT_EQ(stiffness.asymmetry(v), 0);
      EXPECT_TRUE(stiffness.mask(v).nodes.empty());
    }
  }
}

TEST_F(SurfaceStiffnessOfASphere, BetweenVerticesIsTheirInterpolation) {
  const SurfaceStiffness stiffness = stiffnessOf(*reciprocal_, 2, 1);
  for (int f = 0; f < reciprocal_->mesh->triangleCount(); ++f) {
    const Eigen::Vector3d at = randomPlace();
    Eigen::Matrix3d elastic = Eigen::Matrix3d::Zero(), haptic = elastic;
    for (int k = 0; k < 3; ++k) {
      const int v = reciprocal_->mesh->triangles()(k, f);
      EXPECT_EQ(stiffness.elasticAt(f, Eigen::Vector3d::Unit(k)), stiffness.elastic(v));
      elastic += at[k] * stiffness.elastic(v);
      haptic += at[k] * stiffness.haptic(v);
    }
    EXPECT_LE(relativeDifference(stiffness.elasticAt(f, at), elastic), 1e-15);
    EXPECT_LE(relativeDifference(stiffness.hapticAt(f, at), haptic), 1e-15);
  }
}

TEST_F(SurfaceStiffnessOfASphere, HapticStiffnessNeverExceedsTheRigidOne) {
  const double soft = stiffnessOf(*reciprocal_, 2).rigidStiffness();
  for (double rigid : {0.2 * soft, 0.7 * soft, 2 * soft}) {
    const SurfaceStiffness stiffness = stiffnessOf(*reciprocal_, 2, rigid);
    const double limit = std::sqrt(3.0) * rigid;
    int limited = 0;
    for (int v = 0; v < reciprocal_->mesh->vertexCount(); ++v) {
      const double ratio = stiffness.hapticRatio(v);
      EXPECT_EQ(stiffness.haptic(v), ratio * stiffness.elastic(v));
      if (stiffness.elastic(v).norm() <= limit * (1 + 1e-15)) {
        EXPECT_EQ(ratio, 1);
      } else {
        EXPECT_NEAR(stiffness.haptic(v).norm() / limit, 1, 1e-15);
        ++limited;
      }
    }
    for (int f = 0; f < reciprocal_->mesh->triangleCount(); ++f)
      EXPECT_LE(stiffness.hapticAt(f, randomPlace()).norm(), limit * (1 + 1e-15));
    EXPECT_EQ(limited == 0, rigid > soft);
  }
}

TEST_F(SurfaceStiffnessOfASphere, ScalesWithYoungsModulus) {
  const SurfaceStiffness one = stiffnessOf(*reciprocal_, 2);
  const SurfaceStiffness stiffer(reciprocal_->greens->withYoungsModulus(2.5 * 7), reciprocal_->mesh,
                                 MaskShape::Linear, 2 * reciprocal_->mesh->meanEdgeLength());
  for (int v = 0; v < reciprocal_->mesh->vertexCount(); ++v) {
    EXPECT_LE(relativeDifference(stiffer.elastic(v), 7 * one.elastic(v)), kRounding);
    EXPECT_NEAR(stiffer.hapticRatio(v), one.hapticRatio(v), kRounding);
  }
}

TEST_F(SurfaceStiffnessOfASphere, ChangesItsRigidStiffnessAndYoungsModulusAsIfMadeWithThem) {
  const double radius = 2 * reciprocal_->mesh->meanEdgeLength();
  const auto expectSame = [](const SurfaceStiffness& a, const SurfaceStiffness& b) {
    EXPECT_NEAR(a.rigidStiffness() / b.rigidStiffness(), 1, 1e-14);
    for (int v = 0; v < a.mesh().vertexCount(); ++v) {
      EXPECT_LE(relativeDifference(a.elastic(v), b.elastic(v)), kRounding);
      EXPECT_NEAR(a.hapticRatio(v), b.hapticRatio(v), kRounding);
      EXPECT_EQ(a.mask(v).nodes, b.mask(v).nodes);
    }
  };
  for (double rigid : {0.0, 0.5}) {
    const SurfaceStiffness one = stiffnessOf(*reciprocal_, 2, 3);
    const auto changed = one.withRigidStiffness(rigid);
    expectSame(*changed, stiffnessOf(*reciprocal_, 2, rigid));
    const auto greens = reciprocal_->greens->withYoungsModulus(7);
    const auto stiffer = changed->withYoungsModulus(7);
    expectSame(*stiffer,
               SurfaceStiffness(greens, reciprocal_->mesh, MaskShape::Linear, radius, rigid));
    EXPECT_EQ(stiffer->greens().info().material.youngsModulus(), 7);
    // And back: nothing is lost on the way.
    expectSame(*stiffer->withYoungsModulus(2.5)->withRigidStiffness(3), one);
  }
  EXPECT_TRUE(isRefused([&] { stiffnessOf(*reciprocal_, 2).withRigidStiffness(-1); },
                        "the rigid stiffness must be at least 0 and finite, not -1"));
}

TEST(SurfaceStiffness, MasksLevelTheNoiseOfAnIrregularMesh) {
  // A spherical hole in infinite space has the same stiffness everywhere but for its mesh.
  // NUMERICS.md section 5: 7.1 % of variation for single vertices, at most 1.5 % (8 % from peak to
  // peak) for the paper's masks of two mean edge lengths.
  const Shape shape = jitteredSphere(3, 0.2);
  const TouchedBody body = touchedBody(shape, fixedWhere(shape, [](const auto&) { return false; }),
                                       true, Domain::Exterior);
  struct Noise {
    double variation, peakToPeak;
  };
  const auto noise = [&](double radiusInEdges) -> Noise {
    const SurfaceStiffness stiffness(body.greens, body.mesh, MaskShape::Linear,
                                     radiusInEdges * body.mesh->meanEdgeLength());
    Eigen::ArrayXd norms(body.mesh->vertexCount());
    for (int v = 0; v < norms.size(); ++v) norms[v] = stiffness.elastic(v).norm();
    const double mean = norms.mean();
    return {std::sqrt((norms - mean).square().mean()) / mean,
            (norms.maxCoeff() - norms.minCoeff()) / mean};
  };
  const Noise single = noise(0), one = noise(1), two = noise(2), three = noise(3);
  RecordProperty("single", std::to_string(single.variation));
  RecordProperty("two", std::to_string(two.variation));
  EXPECT_GT(single.variation, 0.04) << "a mesh irregular enough to show the effect";
  EXPECT_LE(two.variation, 0.015);
  EXPECT_LE(two.peakToPeak, 0.08);
  EXPECT_LT(one.variation, single.variation);
  EXPECT_LT(two.variation, one.variation);
  EXPECT_LT(three.variation, two.variation);
}

TEST_F(SurfaceStiffnessOfASphere, WhatMakesNoSenseIsRefusedWithASentence) {
  for (double rigid : {-1.0, double(NAN), double(INFINITY)})
    EXPECT_TRUE(isRefused([&] { stiffnessOf(*raw_, 2, rigid); },
                          "the rigid stiffness must be at least 0 and finite, not "));
  EXPECT_TRUE(isRefused([&] { stiffnessOf(*raw_, -2); },
                        "the radius of a pressure mask must be at least 0, not -"));
  EXPECT_TRUE(
      isRefused([&] { SurfaceStiffness(raw_->greens, icosphere(0).mesh(), MaskShape::Linear, 1); },
                "the Green's functions have 162 nodes, the surface 12 vertices"));
  GreensFunctionsInfo info = raw_->greens->info();
  info.columnNodes = {0, 1};
  const auto few = denseGreens(info, denseMatrix(*raw_->greens));
  EXPECT_TRUE(isRefused([&] { SurfaceStiffness(few, raw_->mesh, MaskShape::Linear, 1); },
                        " were not computed: name it among the columns to precompute"));
}

TEST_F(SurfaceStiffnessOfASphere, CanBeAbortedAndTellsItsProgress) {
  double last = -1;
  const auto make = [&](const ProgressCallback& progress) {
    SurfaceStiffness(raw_->greens, raw_->mesh, MaskShape::Linear, 0.3, 0, progress);
  };
  make([&](double fraction, const char*) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return true;
  });
  EXPECT_EQ(last, 1);
  EXPECT_THROW(make([](double fraction, const char*) { return fraction == 0; }), Aborted);
}

}  // namespace
}  // namespace palpate::test
