// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shell/thin_shell.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "shell/shell_curvature.h"
#include "shell/shell_warnings.h"
#include "support/refusals.h"
#include "support/thin_shells.h"

namespace palpate::test {
namespace {

bool leftEdge(const Eigen::Vector3d& x) {
  return x.x() < -0.499;
}
bool nowhere(const Eigen::Vector3d&) {
  return false;
}
Place nearTo(const std::vector<Eigen::Vector3d>& places) {
  return [=](const Eigen::Vector3d& x) {
    for (const Eigen::Vector3d& place : places)
      if ((x - place).norm() < 1e-9) return true;
    return false;
  };
}

TEST(Thickness, OfVerticesIsLinearAndOfTrianglesIsTheirOwn) {
  const auto mesh = plate(1, 2).sheet();
  const Eigen::VectorXd ofVertices = Eigen::VectorXd::LinSpaced(9, 0.1, 0.9),
                        ofTriangles = Eigen::VectorXd::LinSpaced(8, 0.1, 0.8);
  const Eigen::Matrix3Xd a = thicknessOfVertices(*mesh, ofVertices),
                         b = thicknessOfTriangles(*mesh, ofTriangles);
  for (int f = 0; f < 8; ++f)
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(a(k, f), ofVertices[mesh->triangles()(k, f)]);
      EXPECT_EQ(b(k, f), ofTriangles[f]);
    }
}

TEST(Thickness, ThatIsNoneIsRefusedByItsPlace) {
  const auto mesh = plate(1, 2).sheet();
  for (double wrong : {0., -0.1, std::numeric_limits<double>::quiet_NaN(),
                       std::numeric_limits<double>::infinity()}) {
    Eigen::VectorXd ofVertices = Eigen::VectorXd::Constant(9, 0.1), ofTriangles(8);
    ofVertices[5] = wrong;
    EXPECT_TRUE(isRefused([&] { thicknessOfVertices(*mesh, ofVertices); },
                          "the thickness at vertex 5 must be a positive number, not "));
    ofTriangles.setConstant(0.1);
    ofTriangles[7] = wrong;
    EXPECT_TRUE(isRefused([&] { thicknessOfTriangles(*mesh, ofTriangles); },
                          "the thickness at triangle 7 must be a positive number, not "));
  }
  EXPECT_TRUE(isRefused([&] { thicknessOfVertices(*mesh, Eigen::VectorXd::Constant(9, 1.5)); },
                        "at vertex 0, 1.5, is more than the whole surface is wide (1.41421)"));
  EXPECT_EQ(refusal([&] { thicknessOfVertices(*mesh, Eigen::VectorXd::Constant(8, 0.1)); }),
            "there are 8 thicknesses for 9 of the surface, one a vertex");
}

TEST(ThinShell, WithoutSupportIsRefusedByItsPiece) {
  const Shape two = plate(1, 2).with(plate(1, 2).moved({0, 0, 1}));
  EXPECT_TRUE(isRefused([&] { shellProblem(two, nowhere); },
                        "the piece of the shell with vertex 0 is not held anywhere, which leaves a "
                        "rigid motion free ("));
  EXPECT_TRUE(isRefused(
      [&] {
        shellProblem(two, [](const Eigen::Vector3d& x) { return leftEdge(x) && x.z() < 0.5; });
      },
      "the piece of the shell with vertex 9 is not held anywhere"));
  shellProblem(two, leftEdge);
}

TEST(ThinShell, HingedOnALineTurnsAboutItAndClampedDoesNot) {
  shellProblem(plate(1, 2), leftEdge);
  EXPECT_TRUE(isRefused([] { shellProblem(plate(1, 2), leftEdge, {}, false); },
                        "leaves a rigid motion free (rotation about the axis (0, "));
  // Three that are not on one line are enough.
  shellProblem(plate(1, 2), nearTo({{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0, 0.5, 0}}), {}, false);
}

TEST(ThinShell, IsHeldByASingleClampedVertex) {
  shellProblem(plate(1, 2), nearTo({{0, 0, 0}}));
  EXPECT_TRUE(isRefused(
      [] {
        shellProblem(plate(1, 2), nearTo({{0, 0, 0}}), {}, false);
      },
      "what is held of the piece of the shell with vertex 0 leaves a rigid motion free (rotation"));
}

TEST(ThinShell, SymmetryHoldsByComponents) {
  // Two mirrors leave a translation along their line, a third component ends that.
  const auto held = [](unsigned corner) {
    return [=](const Eigen::Vector3d& x) {
      unsigned bits = 0;
      if (x.x() < -0.499) bits |= kMirrorX;
      if (x.y() < -0.499) bits |= kMirrorY;
      if (bits == (kMirrorX | kMirrorY)) bits |= corner;
      return bits;
    };
  };
  EXPECT_TRUE(isRefused([&] { heldShell(plate(1, 2), held(0), {}); },
                        "leaves a rigid motion free (translation along ("));
  EXPECT_FALSE(heldShell(plate(1, 2), held(kUz), {}).model.conditions().fixedNodes().empty());
}

TEST(ThinShell, HeldComponentsThatContradictBoundaryTypesAreRefused) {
  const ElasticModel model = shellModel(plate(1, 2), leftEdge);
  const Eigen::Matrix3Xd thickness = Eigen::Matrix3Xd::Constant(3, 8, 0.1);
  HeldComponents held = heldComponents(model.conditions(), true);
  held(2, 0) = false;
  EXPECT_EQ(refusal([&] { ThinShell(model, thickness, held); }),
            "vertex 0 is fixed, but its displacement is not held");
  held = heldComponents(model.conditions(), true);
  held.col(4).head<3>() = true;
  EXPECT_EQ(refusal([&] { ThinShell(model, thickness, held); }),
            "vertex 4 is free, but its whole displacement is held: fix it");
  EXPECT_EQ(refusal([&] { ThinShell(model, 0 * thickness, true); }),
            "the thickness at triangle 0 must be a positive number, not 0");
  EXPECT_TRUE(isRefused([&] { ThinShell(model, thickness.leftCols(7), true); },
                        "thicknesses of 7 triangles, the surface has 8"));
  EXPECT_TRUE(isRefused([&] { ThinShell(model, thickness, HeldComponents(6, 8)); },
                        "held components of 8 vertices, the surface has 9"));
  const ElasticModel solid = makeModel(
      icosphere(1), [](const Eigen::Vector3d& x) { return x.z() < 0; }, 1, 0.3);
  EXPECT_TRUE(isRefused([&] { ThinShell(solid, Eigen::Matrix3Xd::Ones(3, 80), true); },
                        "not the middle of a shell"));
}

TEST(ThinShell, FingerprintKnowsThicknessSupportAndDomain) {
  const Shape shape = plate(1, 2);
  const ElasticModel model = shellModel(shape, leftEdge);
  const Eigen::Matrix3Xd thickness = Eigen::Matrix3Xd::Constant(3, 8, 0.1);
  Eigen::Matrix3Xd other = thickness;
  other(2, 7) = 0.11;
  std::set<std::uint64_t> prints;
  prints.insert(model.fingerprint());
  prints.insert(ThinShell(model, thickness, true).fingerprint(model));
  prints.insert(ThinShell(model, other, true).fingerprint(model));
  HeldComponents held = heldComponents(model.conditions(), true);
  held(5, 8) = true;
  prints.insert(ThinShell(model, thickness, held).fingerprint(model));
  held(3, 0) = false;
  prints.insert(ThinShell(model, thickness, held).fingerprint(model));
  EXPECT_EQ(prints.size(), 5u);
  const ElasticModel patch(model.sharedMesh(), model.material(),
                           BoundaryConditions(std::vector<unsigned char>(9, 0)),
                           model.smoothPatches(), Domain::HalfSpace);
  const ElasticModel sheet(model.sharedMesh(), model.material(),
                           BoundaryConditions(std::vector<unsigned char>(9, 0)),
                           model.smoothPatches(), Domain::Shell);
  EXPECT_NE(patch.fingerprint(), sheet.fingerprint());
  const ElasticModel stiffer = shellModel(shape, leftEdge, {0.1, 0.3, 5});
  EXPECT_EQ(ThinShell(stiffer, thickness, true).fingerprint(stiffer),
            ThinShell(model, thickness, true).fingerprint(model));
}

TEST(Inclinations, AreThoseOfChordsAndNotOfFolds) {
  const auto pipe = sheetOf(30, [](double a, double b) {
                      return Eigen::Vector3d(2 * std::sin(3 * a), 2 * std::cos(3 * a), b);
                    }).sheet();
  EXPECT_LT((shell::inclinations(*pipe).array() / 0.1 - 1).abs().maxCoeff(), 1e-9);
  EXPECT_LT(shell::inclinations(*jitteredPlate(1, 8, 0.3).sheet()).maxCoeff(), 1e-7);
  EXPECT_LT(shell::inclinations(*box({1, 1, 1}, {2, 2, 2}).sheet()).maxCoeff(), 1e-7);
}

TEST(MeanCurvature, OfSpheresCylindersAndPlates) {
  // Three corners of a mesh see the angles around them unevenly, a tenth at most here.
  const Eigen::VectorXd ofBall = shell::meanCurvatures(*icosphere(3).scaled(2).sheet());
  EXPECT_LT((ofBall.array() / 0.5 - 1).abs().maxCoeff(), 0.1);
  const auto pipe = sheetOf(33, [](double a, double b) {
                      return Eigen::Vector3d(2 * std::sin(3 * a), 2 * std::cos(3 * a), b);
                    }).sheet();
  const Eigen::VectorXd ofPipe = shell::meanCurvatures(*pipe);
  EXPECT_NEAR(ofPipe[pipe->triangleCount() / 2] / 0.25, 1, 0.15);
  EXPECT_LT(shell::meanCurvatures(*jitteredPlate(1, 8, 0.3).sheet()).maxCoeff(), 1e-12);
  // Folds count for none.
  EXPECT_LT(shell::meanCurvatures(*box({1, 1, 1}, {2, 2, 2}).sheet()).maxCoeff(), 1e-12);
}

/// The only warning of a shell, or nothing.
std::string warningOf(const Shape& shape, double thickness, const Place& fixed = leftEdge,
                      double defect = 0) {
  const ShellProblem problem = shellProblem(shape, fixed, {thickness});
  const auto warnings = shell::shellWarnings(problem.model, problem.shell, defect);
  EXPECT_LE(warnings.size(), 1u);
  return warnings.empty() ? "" : warnings[0];
}

TEST(ShellWarnings, SayWhatMakesAShellDoubtful) {
  EXPECT_EQ(warningOf(plate(1, 8), 0.1), "");
  EXPECT_TRUE(contains(warningOf(plate(1, 4), 0.25), "is thick (thickness over width 0.25)"));
  EXPECT_TRUE(contains(warningOf(plate(1, 16), 0.1),
                       "has edges shorter than its thickness (mean edge over thickness 0.7"));
  EXPECT_TRUE(
      contains(warningOf(plate(1, 8), 0.1, nearTo({{0, 0, 0}})), "is clamped over 0 edges only"));
  const Shape bend = sheetOf(12, [](double a, double b) {
    return Eigen::Vector3d(std::sin(1.5 * a) - 0.5, 1 - std::cos(1.5 * a), 12 * b);
  });
  EXPECT_EQ(warningOf(bend, 0.3), "");
  EXPECT_TRUE(contains(warningOf(bend, 0.5), "thick beside its radius of curvature at triangle"));
  EXPECT_TRUE(contains(warningOf(plate(1, 8), 0.1, leftEdge, 0.02), "rigid motions err by 0.02"));
}

}  // namespace
}  // namespace palpate::test
