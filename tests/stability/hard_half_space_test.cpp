// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Half-spaces: needles, graded surfaces, incompressible and auxetic materials, units.

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Eigenvalues>

#include "contact/surface_stiffness.h"
#include "contact/unilateral_contact.h"
#include "stability/hard_case.h"
#include "support/half_space.h"
#include "support/obstacles.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

HardCase hard(const std::string& name, const std::string& danger) {
  return {"half-space", name, danger};
}

/// Least over largest eigenvalue of the force compliance between nodes, scaled to a diagonal of
/// ones.
double definiteness(const HalfSpace& body) {
  Eigen::MatrixXd force = denseMatrix(*body.greens);
  for (int v = 0; v < body.mesh->vertexCount(); ++v)
    force.middleCols<3>(3 * v) /= body.greens->vertexArea(v);
  const Eigen::VectorXd scale = force.diagonal().cwiseSqrt().cwiseInverse();
  force = scale.asDiagonal() * force * scale.asDiagonal();
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(force).eigenvalues();
  return values[0] / values[values.size() - 1];
}

/// Columns of squares, one grid line moved to within `width` of the next.
Shape withNeedles(double width) {
  return plate(1, 8).mapped([=](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(std::abs(x.x() - 0.125) < 1e-9 ? width : x.x(), x.y(), 0);
  });
}

constexpr double kDepth = 0.25 * 0.25 / 100;  ///< of a ball of radius 100: a contact of 1/4

/// Force on a ball, over that on a sound surface of the same half-space.
double ballForce(const Shape& shape, double poissonRatio) {
  const HalfSpace body = halfSpace(shape, poissonRatio);
  UnilateralContact contact(body.greens, body.mesh, ball(100), still(400, 0.1));
  const RigidPose pose = at(0, 0, 100 - kDepth);
  EXPECT_LE(contact.step(&pose).residual, 1e-8);
  return contact.wrench(0).force.z() * (1 - poissonRatio * poissonRatio) /
         (4. / 3 * 10 * std::pow(kDepth, 1.5));
}

TEST(HardHalfSpaces, NeedlesBesideTheContact) {
  const double sound = ballForce(plate(1, 8), 0.3);
  double farthest = 0;
  for (double width : {1e-2, 1e-4, 1e-6, 1e-8})
    farthest = std::max(farthest, std::abs(ballForce(withNeedles(width), 0.3) / sound - 1));
  hard("needles of aspect 10 … 1e7 under a ball, 81 vertices",
       "edge integrals that cancel over needles")
      .expectAtMost("change of the force", farthest, 0.1);
  const auto warnings = halfSpace(withNeedles(1e-7)).greens->info().diagnostics.warnings;
  hard("vertices 1e−6 edges from their neighbours", "a compliance that is not positive definite")
      .expectSaid(warnings.empty() ? "" : warnings[0], "together is not positive");
}

TEST(HardHalfSpaces, AuxeticToIncompressible) {
  double farthest = 0;
  for (double nu : {-0.99, -0.9, 0., 0.49, 0.5})
    farthest = std::max(farthest, std::abs(ballForce(disc(0.32, 10), nu) - 1));
  hard("ν = −0.99 … 0.5, a ball, 331 vertices", "terms that vanish or dominate at the ends")
      .expectAtMost("error of the force, Hertz", farthest, 0.02);
}

TEST(HardHalfSpaces, GradedSurfaces) {
  // Rings at r^4: the innermost hat is a sixteenth of the next.
  const Shape graded = disc(1, 9).mapped(
      [](const Eigen::Vector3d& x) -> Eigen::Vector3d { return std::pow(x.norm(), 3) * x; });
  const HalfSpace body = halfSpace(graded);
  const HardCase grade = hard("rings graded 1 : 2500 towards the middle, 271 vertices",
                              "hats of very different sizes see each other");
  // A uniform pressure on all of it, at the middle: A12.
  const int count = body.mesh->vertexCount();
  Eigen::Matrix3Xd pressure = Eigen::Matrix3Xd::Zero(3, count);
  pressure.row(2).setOnes();
  Eigen::VectorXd out = Eigen::VectorXd::Zero(3);
  body.greens->accumulate(Eigen::VectorXi::LinSpaced(count, 0, count - 1), pressure.reshaped(),
                          Eigen::VectorXi::Constant(1, 0), out);
  grade.expectAtMost("error of the middle's displacement under a uniform pressure, closed form",
                     std::abs(out[2] / (2 * 0.91) - 1), 0.05);
  grade.expectAtLeast("least eigenvalue of the scaled compliance, over the largest",
                      definiteness(body), 1e-9);
}

TEST(HardHalfSpaces, AnyUnit) {
  const Shape shape = jitteredPlate(1, 8, 0.3);
  const auto stiffness = [&](double scale, double young) {
    const HalfSpace body = halfSpace(shape.scaled(scale), 0.3, true, young);
    return Eigen::Matrix3d(
        SurfaceStiffness(body.greens, body.mesh, MaskShape::Linear, 0.3 * scale).elastic(40) /
        (young * scale));
  };
  const Eigen::Matrix3d unit = stiffness(1, 1);
  double farthest = 0;
  for (double scale : {1e-6, 1e-3, 1e3, 1e6})
    for (double young : {1e-3, 1e12})
      farthest = std::max(farthest, (stiffness(scale, young) - unit).norm() / unit.norm());
  hard("1e−6 … 1e6 m, E = 1e−3 … 1e12", "tolerances that go by units")
      .expectAtMost("largest difference of K/(E L)", farthest, 1e-10);
}

}  // namespace
}  // namespace palpate::test
