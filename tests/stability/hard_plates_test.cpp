// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Plates of 1:10 to 1:100: integration across the thickness, and linear triangles that lock in
// bending (NUMERICS.md finding 2), which the model must say.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "stability/hard_case.h"
#include "support/problems.h"

namespace palpate::test {
namespace {

HardCase hard(const std::string& name, const std::string& danger) {
  return {"thin", name, danger};
}

bool atX0(const Eigen::Vector3d& x) {
  return x.x() < 1e-9;
}

TEST(ThinPlates, HoldThePatchTest) {
  double worst = 0;
  for (const double thickness : {0.1, 0.05, 0.02, 0.01})
    for (const Collocation collocation : {Collocation::Averaged, Collocation::Vertex}) {
      BoundaryElementOptions options;
      options.collocation = collocation;
      worst = std::max(
          worst,
          patchTestError(makeModel(box({1, 1, thickness}, {8, 8, 1}), atX0, 1, 0.3), options));
    }
  // A cantilever of 1:100 answers an imbalance of 1e-6 with bending: what it yields grows like the
  // cube of its slenderness, what the mesh lets it bend less.
  hard("plates 1:10, 1:20, 1:50, 1:100 held at one side, both collocations",
       "the far face as near as the element: errors of 0.2 … 0.44")
      .expectAtMost("largest error of u of a linear field", worst, 1e-3);
}

/// A square plate of side 1 clamped all round under unit pressure, 16 by 16 squares: its centre's
/// deflection over that of a shear-deformable plate, less 1; what is said of its walls; and their
/// ratio.
struct Bending {
  double error, wallRatio;
  std::string warning;
};

Bending bend(double thickness) {
  const ElasticModel model = makeModel(
      box({1, 1, thickness}, {16, 16, 1}),
      [](const Eigen::Vector3d& x) {
        return std::min({x.x(), x.y(), 1 - x.x(), 1 - x.y()}) < 1e-9;
      },
      1, 0.3);
  BoundaryElementOptions options = raw();
  options.patchColumns = true;
  const auto greens = computeGreens(model, options);
  Eigen::Matrix3Xd onFaces = Eigen::Matrix3Xd::Zero(3, model.mesh().triangleCount()), applied;
  for (int f = 0; f < onFaces.cols(); ++f)
    if (model.mesh().triangleNormals()(2, f) > 0.9) onFaces(2, f) = -1;
  const Eigen::Matrix3Xd response =
      solveFaceTractions(*greens, model.mesh(), model.smoothPatches(), onFaces, applied);
  Eigen::Index centre;
  (model.mesh().points().colwise() - Eigen::Vector3d(0.5, 0.5, 0))
      .colwise()
      .norm()
      .minCoeff(&centre);
  // Kirchhoff's .00126532 q L^4 / D and its correction for shear, which is 19 % at 1:10 (.001505,
  // both from tables of clamped Mindlin plates) and falls with the square of the thickness.
  const double rigidity = std::pow(thickness, 3) / (12 * (1 - 0.3 * 0.3));
  const double exact = (0.00126532 + 0.024 * thickness * thickness) / rigidity;
  Bending bending{-response(2, centre) / exact - 1, 0, ""};
  for (const std::string& warning : greens->info().diagnostics.warnings)
    if (warning.find("wall") != std::string::npos) bending.warning += warning;
  bending.wallRatio = greens->info().diagnostics.wallRatio;
  return bending;
}

TEST(ThinPlates, ThatLockInBendingSaySo) {
  const std::string danger = "linear triangles lock in bending, and no condition number says so";
  const std::string deflection = "deflection's error in size, plate theory";
  const Bending tenth = bend(0.1), twentieth = bend(0.05), fiftieth = bend(0.02),
                hundredth = bend(0.01);
  // Where the warning is the mild one, the deflection is good to what the plate theory is, 5 %;
  // where it says that the wall is too stiff, it may be anything below: the last two show that it
  // is.
  const auto mild = hard("clamped plate 1:10, 16 × 16 squares, edge over thickness 0.88", danger);
  mild.expectSaid(tenth.warning, "is thin for the mesh (edge over thickness 0.884): if it bends");
  mild.expectAtMost(deflection, std::abs(tenth.error), 0.05);
  const auto half = hard("1:20, edge over thickness 1.77", danger);
  half.expectSaid(twentieth.warning, "(edge over thickness 1.77): it is too stiff in bending");
  half.expectAtMost(deflection, std::abs(twentieth.error), 0.1);
  const auto strong = hard("1:50, edge over thickness 4.42", danger);
  strong.expectSaid(fiftieth.warning, "(edge over thickness 4.42): it is too stiff in bending");
  strong.expectAtLeast(deflection, -fiftieth.error, 0.1);
  const auto worst = hard("1:100, edge over thickness 8.84", danger);
  worst.expectSaid(hundredth.warning, "(edge over thickness 8.84): it is too stiff in bending");
  worst.expectAtLeast(deflection, -hundredth.error, 0.5);
}

TEST(ThickBlocks, AreNotWarnedOf) {
  const ElasticModel model = makeModel(box({1, 1, 1}, {8, 8, 8}), atX0, 1, 0.3);
  double wallRatio = 0, width = 0;
  hard("a solid cube of 8 divisions", "a warning that is always there")
      .expectCount("warnings", static_cast<long>(modelWarnings(model, wallRatio, width).size()), 0);
}

}  // namespace
}  // namespace palpate::test
