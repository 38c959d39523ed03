// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Thin shells: very thin ones, bad triangles, thickness that jumps, any material and unit, supports
// that do not hold.

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Eigenvalues>

#include "contact/surface_stiffness.h"
#include "stability/hard_case.h"
#include "support/synthetic_greens.h"
#include "support/thin_shells.h"

namespace palpate::test {
namespace {

HardCase hard(const std::string& name, const std::string& danger) {
  return {"shells", name, danger};
}

bool leftEdge(const Eigen::Vector3d& x) {
  return x.x() < -0.499;
}
bool rim(const Eigen::Vector3d& x) {
  return x.head<2>().cwiseAbs().maxCoeff() > 0.499;
}

/// A saddle over a flat shape, curved both ways, so that bending and stretching go together.
Shape saddle(const Shape& flat) {
  return flat.mapped([](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x.x(), x.y(), 0.4 * x.x() * x.x() - 0.3 * x.y() * x.y());
  });
}

/// The deflection of a middle under a unit pressure.
double middleDeflection(const ShellProblem& problem) {
  return displacementAt(problem, vertexNear(problem.mesh(), {0, 0, 0}), 2,
                        spreadEvenly(problem.mesh(), {0, 0, 1}));
}

/// Least eigenvalue of the force compliance between free nodes, scaled to a diagonal of ones.
double definiteness(const ShellProblem& problem) {
  const auto greens = problem.greens();
  const std::vector<int> free = problem.model.conditions().freeNodes();
  Eigen::MatrixXd force(3 * free.size(), 3 * free.size());
  greens->gather(nodeList(free), nodeList(free), force.data());
  for (std::size_t i = 0; i < free.size(); ++i)
    force.middleCols<3>(3 * i) /= greens->vertexArea(free[i]);
  const Eigen::VectorXd scale = force.diagonal().cwiseSqrt().cwiseInverse();
  force = scale.asDiagonal() * force * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(force).eigenvalues()[0];
}

TEST(HardShells, ThinOnes) {
  double rigid = 0, asymmetry = 0;
  for (double thickness : {1e-3, 1e-4}) {
    const ShellProblem problem = shellProblem(saddle(plate(1, 12)), leftEdge, {thickness});
    ShellOptions raw;
    raw.reciprocal = false;
    const Diagnostics diagnostics = problem.greens(raw)->info().diagnostics;
    rigid = std::max(rigid, diagnostics.rotationDefect);
    asymmetry = std::max(asymmetry, diagnostics.reciprocityDefect);
  }
  const HardCase thin = hard("a saddle clamped at one edge, t/L = 1e−3, 1e−4, 169 vertices",
                             "stretching is 1e8 times as stiff as bending: rounding");
  thin.expectAtMost("largest error of rigid motions", rigid, 1e-6);
  thin.expectAtMost("largest reciprocity defect, not symmetrised", asymmetry, 1e-12);
  // Kirchhoff's plate under a pressure: w goes by 1 / t^3.
  const auto scaled = [](double t) {
    return middleDeflection(shellProblem(plate(1, 12), rim, {t})) * t * t * t / 12 / 0.91;
  };
  double farthest = 0;
  for (double t : {1e-3, 1e-4, 1e-5, 1e-6})
    farthest = std::max(farthest, std::abs(scaled(t) / 0.00126532 - 1));
  hard("a clamped square, t/L = 1e−3 … 1e−6, 169 vertices", "triangles that lock as they get thin")
      .expectAtMost("error of the middle's deflection, closed form", farthest, 0.02);
}

TEST(HardShells, BadTriangles) {
  const double sound = middleDeflection(shellProblem(plate(1, 12), rim, {1e-3}));
  double farthest = 0;
  for (unsigned seed : {1, 2, 3})
    farthest = std::max(
        farthest,
        std::abs(middleDeflection(shellProblem(jitteredPlate(1, 12, 0.4, seed), rim, {1e-3})) /
                     sound -
                 1));
  hard("vertices moved by up to 0.4 of an edge, t/L = 1e−3, 169 vertices",
       "triangles that are right on regular meshes alone")
      .expectAtMost("change of the middle's deflection", farthest, 0.01);
  // One grid line beside the one in the middle.
  const auto withNeedles = [](double width) {
    return shellProblem(plate(1, 12).mapped([=](const Eigen::Vector3d& x) {
      return Eigen::Vector3d(std::abs(x.x() - 1. / 12) < 1e-9 ? width : x.x(), x.y(), 0);
    }),
                        rim, {1e-3});
  };
  double needles = 0;
  for (double width : {1e-2, 1e-3, 1e-4})
    needles = std::max(needles, std::abs(middleDeflection(withNeedles(width)) / sound - 1));
  hard("needles of aspect 10 … 1e3 across a plate, t/L = 1e−3, 169 vertices",
       "stiffnesses of needles, (aspect)³ of the others, swallow these")
      .expectAtMost("change of the middle's deflection", needles, 0.002);
  const auto warnings = withNeedles(1e-5).greens()->info().diagnostics.warnings;
  hard("needles of aspect 1e4 across a plate", "stiffnesses of needles swallow some of the others'")
      .expectSaid(warnings.empty() ? "" : warnings[0], "rounding shows: rigid motions err by");
  hard("needles of aspect 1e5 and 1e6 across a plate", "stiffnesses of needles swallow all others'")
      .expectAllRefused<std::runtime_error>(
          {[&] { withNeedles(1e-7).greens(); }, [&] { withNeedles(1e-6).greens(); }},
          "rounding shows: ");
}

TEST(HardShells, ThicknessThatVaries) {
  // Every triangle has another thickness, 1 : 100 in all.
  const Shape shape = saddle(jitteredPlate(1, 8, 0.3));
  const ElasticModel model = shellModel(shape, leftEdge, {});
  Eigen::VectorXd thickness(model.mesh().triangleCount());
  for (Eigen::Index f = 0; f < thickness.size(); ++f)
    thickness[f] = 1e-3 * std::pow(100., (f * 37 % 64) / 63.);
  const ShellProblem problem{model,
                             ThinShell(model, thicknessOfTriangles(model.mesh(), thickness), true)};
  const HardCase jumps = hard("thicknesses of 1e−3 … 1e−1 from triangle to triangle, 81 vertices",
                              "stiffnesses of 1 : 1e6 beside each other");
  jumps.expectAtMost("error of rigid motions", problem.greens()->info().diagnostics.rotationDefect,
                     1e-6);
  jumps.expectAtLeast("least eigenvalue of the scaled compliance", definiteness(problem), 1e-6);
}

TEST(HardShells, AnyMaterial) {
  double farthest = 0, least = 1;
  for (double nu : {-0.99, -0.5, 0., 0.49, 0.5}) {
    const ShellProblem square = shellProblem(plate(1, 12), rim, {1e-3, nu});
    // Clamped all round, it goes by D alone: E t^3 / 12 / (1 - nu^2).
    farthest = std::max(
        farthest, std::abs(middleDeflection(square) * 1e-9 / 12 / (1 - nu * nu) / 0.00126532 - 1));
    least = std::min(least, definiteness(shellProblem(saddle(plate(1, 6)), leftEdge, {1e-2, nu})));
  }
  const HardCase materials = hard("ν = −0.99 … 0.5", "drilling rotations that nothing resists");
  materials.expectAtMost("error of a clamped square's deflection, closed form", farthest, 0.03);
  materials.expectAtLeast("least eigenvalue of a saddle's scaled compliance", least, 1e-6);
}

TEST(HardShells, AnyUnit) {
  const Shape shape = saddle(jitteredPlate(1, 8, 0.3));
  const auto stiffness = [&](double scale, double young) {
    const ShellProblem problem = shellProblem(
        shape.scaled(scale), [&](const Eigen::Vector3d& x) { return leftEdge(x / scale); },
        {1e-3 * scale, 0.3, young});
    return Eigen::Matrix3d(SurfaceStiffness(problem.greens(), problem.model.sharedMesh(),
                                            MaskShape::Linear, 0.3 * scale)
                               .elastic(40) /
                           (young * scale));
  };
  const Eigen::Matrix3d unit = stiffness(1, 1);
  double farthest = 0;
  for (double scale : {1e-6, 1e-3, 1e3, 1e6})
    for (double young : {1e-3, 1e12})
      farthest = std::max(farthest, (stiffness(scale, young) - unit).norm() / unit.norm());
  hard("1e−6 … 1e6 m, E = 1e−3 … 1e12, t/L = 1e−3", "tolerances that go by units")
      .expectAtMost("largest difference of K/(E L)", farthest, 1e-8);
}

TEST(HardShells, SupportsThatDoNotHold) {
  hard("a plate hinged along one edge", "a stiffness matrix that is singular to rounding")
      .expectRefused([] { shellProblem(plate(1, 4), leftEdge, {}, false); },
                     "leaves a rigid motion free (rotation about the axis");
  const ShellProblem nail =
      shellProblem(plate(1, 8), [](const Eigen::Vector3d& x) { return x.norm() < 1e-9; }, {1e-2});
  hard("a plate clamped at one vertex", "its rotation there depends on the mesh")
      .expectSaid(nail.greens()->info().diagnostics.warnings.at(0), "is clamped over 0 edges only");
}

}  // namespace
}  // namespace palpate::test
