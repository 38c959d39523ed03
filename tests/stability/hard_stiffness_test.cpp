// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The stiffness that is served, on all that is hard to mesh: symmetric, positive definite,
// continuous.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "contact/surface_stiffness.h"
#include "mesh/surface_point.h"
#include "stability/hard_case.h"
#include "support/contact_bodies.h"
#include "support/problems.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

HardCase hard(const std::string& name, const std::string& danger) {
  return {"stiffness", name, danger};
}

bool base(const Eigen::Vector3d& x) {
  return x.z() < 1e-9;
}
bool atX0(const Eigen::Vector3d& x) {
  return x.x() < 1e-9;
}
bool lower(const Eigen::Vector3d& x) {
  return x.z() < -0.6;
}

/// What is served of the free vertices of some bodies.
struct Served {
  double asymmetry = 0, leastRatio = 1;  ///< |K - K^T| / |K|; softest over stiffest direction
  int refused = 0, count = 0;

  void add(const Eigen::Matrix3d& k) {
    const Eigen::Vector3d principal =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(k).eigenvalues();
    asymmetry = std::max(asymmetry, (k - k.transpose()).norm() / k.norm());
    leastRatio = std::min(leastRatio, principal[0] / principal[2]);
  }

  /// @return the warnings of the Green's functions, in one text.
  std::string serve(const ElasticModel& model, double radius) {
    const auto greens = computeGreens(model, {});
    const SurfaceStiffness stiffness(greens, std::make_shared<SurfaceMesh>(model.mesh()),
                                     MaskShape::Linear, radius);
    for (int v : model.conditions().freeNodes()) {
      ++count;
      if (!stiffness.elastic(v).hasNaN()) {
        add(stiffness.elastic(v));
        continue;
      }
      ++refused;
      try {
        stiffness.requireServed(v);
        ADD_FAILURE() << "vertex " << v << " is not served and nobody says so";
      } catch (const std::runtime_error&) {
      }
    }
    std::string warnings;
    for (const std::string& warning : greens->info().diagnostics.warnings)
      warnings += (warnings.empty() ? "" : "; ") + warning;
    return warnings;
  }
};

const std::string kAsymmetry = "largest ‖K − Kᵀ‖/‖K‖";
const std::string kRatio = "least ratio of principal stiffnesses";
const std::string kRefused = "share of vertices refused, each with its sentence";
const std::string kWrongSign = "a compliance that is not positive definite served as a stiffness";

TEST(ServedStiffness, IsSymmetricPositiveDefiniteOnEveryHardMesh) {
  Served served;
  for (const double nu : {-0.5, 0.3, 0.499}) {
    const auto serve = [&](const Shape& shape, const Place& fixed, double radius) {
      const std::string warnings = served.serve(makeModel(shape, fixed, 1, nu), radius);
      EXPECT_EQ(warnings.find("reciprocal"), std::string::npos) << warnings;
    };
    serve(jitteredSphere(2, 0.35), lower, 0.6);
    serve(jitteredSphere(2, 0.35), lower, 0);
    serve(box({1, 1, 1}, {5, 5, 5}), base, 0.4);
    serve(box({2, 1, 0.3}, {12, 6, 2}), atX0, 0.3);
    if (nu < 0) continue;
    serve(boxWithNeedles(1e-4), base, 0.4);
    serve(boxWithNeedles(1e-6), base, 0);
  }
  const auto meshes = hard(
      "jittered spheres, cube, blade, strips of needles of aspect 2.5e3 and 2.5e5 "
      "round a cube; ν = 0.3, 0.499, all but the needles −0.5; masks and single "
      "vertices",
      "a force field that does work round a loop, a device that is pushed on");
  meshes.expectAtMost(kAsymmetry, served.asymmetry, 1e-12);
  meshes.expectAtLeast(kRatio, served.leastRatio, 1e-4);
  meshes.expectCount("vertices refused", served.refused, 0);
}

TEST(ServedStiffness, OfStripsOfNeedlesInAuxeticBodiesIsWarnedOf) {
  // Averaged collocation hardly resists a jump of displacement across a strip of needles when nu <
  // 0: isolated needles are harmless (hard_meshes_test), strips round a body are not.
  Served served;
  const std::string warnings = served.serve(makeModel(boxWithNeedles(1e-6), base, 1, -0.5), 0.4);
  const auto strips = hard("a strip of needles of aspect 2.5e5 round a cube, ν = −0.5", kWrongSign);
  strips.expectSaid(warnings, "strips of needles cross an auxetic body");
  strips.expectAtMost(kRefused, double(served.refused) / served.count, 0.5);
  strips.expectAtLeast(kRatio + " of those served", served.leastRatio, 1e-4);
}

TEST(ServedStiffness, OfPlatesThatLockIsPositiveDefiniteOrRefusedVertexByVertex) {
  const auto plate = [](Served& served, double thickness) {
    std::string said;
    for (const double nu : {0.0, 0.3})
      said = served.serve(makeModel(box({1, 1, thickness}, {8, 8, 1}), atX0, 1, nu), 0.25);
    return said;
  };
  Served thick, thin;
  plate(thick, 0.1);
  const auto tenth = hard("plate 1:10 held at a side, 8 × 8 squares, ν = 0, 0.3", kWrongSign);
  tenth.expectCount("vertices refused", thick.refused, 0);
  tenth.expectAtLeast(kRatio, thick.leastRatio, 1e-4);
  std::string said;
  for (const double thickness : {0.05, 0.02, 0.01}) said = plate(thin, thickness);
  const auto thinner = hard("plates 1:20, 1:50, 1:100, the same", kWrongSign);
  thinner.expectSaid(said, "far from reciprocal");
  thinner.expectAtMost(kAsymmetry + " of those served", thin.asymmetry, 1e-12);
  thinner.expectAtLeast(kRatio + " of those served", thin.leastRatio, 1e-9);
  // Beyond three edges to a thickness the bending of a plate is lost: served is what is left.
  thinner.expectAtMost(kRefused, double(thin.refused) / thin.count, 0.8);
}

TEST(ServedStiffness, OfABodyInsideOutIsRefused) {
  SyntheticBody synthetic;
  const auto greens = denseGreens(synthetic.info(), -synthetic.matrix());
  hard("Green's functions of the wrong sign", "a device that is pulled in")
      .expectRefused<std::runtime_error>(
          [&] {
            maskedVertexStiffness(*greens, 3, {{3}, Eigen::VectorXd::Ones(1)});
          },
          "the compliance at vertex 3 is not positive definite: the surface is inside out there");
}

TEST(ServedStiffness, OfMasksIsLevelOnAnIrregularMesh) {
  // A cavity in infinite space is equally stiff everywhere but for its mesh. NUMERICS.md section
  // 5: 7.1 % for single vertices; the paper's masks of two edges should give 1.5 % and, peak to
  // peak, 8 %.
  const Shape shape = jitteredSphere(3, 0.2);
  const TouchedBody body = touchedBody(shape, std::vector<unsigned char>(shape.points.cols(), 0),
                                       true, Domain::Exterior);
  const SurfaceStiffness stiffness(body.greens, body.mesh, MaskShape::Linear,
                                   2 * body.mesh->meanEdgeLength());
  Eigen::ArrayXd norms(body.mesh->vertexCount());
  for (int v = 0; v < norms.size(); ++v) norms[v] = stiffness.elastic(v).norm();
  const auto level =
      hard("a cavity's 642 vertices moved by up to 0.2 of an edge, masks of two edges",
           "a mesh that is felt: 7 % of variation at single vertices");
  level.expectAtMost("coefficient of variation of ‖K‖",
                     std::sqrt((norms - norms.mean()).square().mean()) / norms.mean(), 0.015);
  level.expectAtMost("peak to peak of ‖K‖ over its mean",
                     (norms.maxCoeff() - norms.minCoeff()) / norms.mean(), 0.08);
}

TEST(ServedStiffness, IsContinuousOnTheWayToTheSupport) {
  // From the pole down a meridian to the last triangle whose vertices are all free, in steps of a
  // tenth of an edge; there half of a mask would lie on the support.
  const TouchedBody body = touchedSphere(3, true);
  const double edge = body.mesh->meanEdgeLength();
  const SurfaceStiffness stiffness(body.greens, body.mesh, MaskShape::Linear, 2 * edge);
  double largest = 0, angle = 0.05;
  Eigen::Matrix3d before = Eigen::Matrix3d::Zero();
  for (;; angle += edge / 10) {
    const SurfacePoint point = nearestSurfacePoint(
        *body.mesh,
        {std::sin(angle) * std::cos(0.4), std::sin(angle) * std::sin(0.4), std::cos(angle)});
    bool free = true;
    for (int v : body.mesh->triangles().col(point.triangle)) free &= !body.greens->isFixed(v);
    if (!free) break;
    const Eigen::Matrix3d compliance =
        stiffness.elasticAt(point.triangle, point.barycentric).inverse();
    if (!before.isZero()) largest = std::max(largest, (compliance - before).norm() / before.norm());
    before = compliance;
  }
  EXPECT_GT(angle, std::acos(-0.6) - 2 * edge);
  hard("a path to the support, masks of two edges that overlap it", "a force that jumps")
      .expectAtMost("largest change of the compliance in a tenth of an edge", largest, 0.05);
}

}  // namespace
}  // namespace palpate::test
