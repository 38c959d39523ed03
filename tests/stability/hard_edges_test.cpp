// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Sharp edges and corners, where traction jumps and two fixed faces may meet.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "stability/hard_case.h"
#include "support/problems.h"

namespace palpate::test {
namespace {

HardCase hard(const std::string& name, const std::string& danger) {
  return {"edges", name, danger};
}

bool base(const Eigen::Vector3d& x) {
  return x.z() < 1e-9;
}

Shape cube(int divisions) {
  return box({1, 1, 1}, Eigen::Vector3i::Constant(divisions));
}

/// Errors of the top centre's displacement along a unit traction on the top of a unit cube, normal
/// and tangential, against NUMERICS.md section 4 (hp finite elements, 1e-5).
struct CubeErrors {
  double normal, shear, resultant;
};

/// @param perPatch  one traction a vertex and smooth patch; else one a vertex, as in [JP01].
CubeErrors cubeErrors(int divisions, bool perPatch) {
  const ElasticModel model = makeModel(cube(divisions), base, 1, 0.3, perPatch ? 30 : 180);
  BoundaryElementOptions options = raw();
  options.patchColumns = perPatch;
  const auto greens = computeGreens(model, options);
  const Eigen::Matrix3Xd& x = model.mesh().points();
  Eigen::Index centre;
  (x.colwise() - Eigen::Vector3d(0.5, 0.5, 1)).colwise().norm().minCoeff(&centre);
  const auto respond = [&](const Eigen::Vector3d& traction, Eigen::Matrix3Xd& applied) {
    if (!perPatch) {
      Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, x.cols());
      for (int v = 0; v < x.cols(); ++v)
        if (x(2, v) > 1 - 1e-9) given.col(v) = traction;
      applied = given * model.mesh().vertexAreas().asDiagonal();
      return solveReferenceProblem(*greens, given);
    }
    Eigen::Matrix3Xd onFaces = Eigen::Matrix3Xd::Zero(3, model.mesh().triangleCount());
    for (int f = 0; f < onFaces.cols(); ++f)
      if (model.mesh().triangleNormals()(2, f) > 0.9) onFaces.col(f) = traction;
    return solveFaceTractions(*greens, model.mesh(), model.smoothPatches(), onFaces, applied);
  };
  Eigen::Matrix3Xd applied;
  CubeErrors errors;
  errors.normal = std::abs(respond({0, 0, 1}, applied)(2, centre) / 0.964754 - 1);
  errors.resultant = std::abs(applied.row(2).sum() - 1);
  errors.shear = std::abs(respond({1, 0, 0}, applied)(0, centre) / 6.71156 - 1);
  return errors;
}

TEST(SharpEdges, CubeMovesAsTheFiniteElementReferenceWithOneTractionAPatch) {
  const CubeErrors errors = cubeErrors(12, true);
  const auto edges = hard("unit cube, loaded top, 12 divisions, one traction a vertex and patch",
                          "traction that cannot jump across an edge");
  edges.expectAtMost("error of u, normal load, finite elements", errors.normal, 0.01);
  edges.expectAtMost("error of u, shear load, finite elements", errors.shear, 0.01);
  edges.expectAtMost("error of the applied force", errors.resultant, 1e-12);
}

TEST(SharpEdges, CubeOfOneTractionAVertexIsFarFromTheReference) {
  // The paper's treatment, kept for comparison (--smooth-angle 180): hats wrap round the edges, and
  // so bring 4 / (2 * 12) more force.
  const CubeErrors errors = cubeErrors(12, false);
  const auto edges = hard("the same, one traction a vertex, as in the paper",
                          "hats that wrap round the edge: what patches are for");
  edges.expectAtLeast("error of u, normal load, finite elements", errors.normal, 0.05);
  edges.expectAtLeast("error of u, shear load, finite elements", errors.shear, 0.05);
  edges.expectAtMost("error of the applied force less 1/6", std::abs(errors.resultant - 1. / 6),
                     1e-12);
}

double conditionOf(const Shape& shape, const Place& fixed, double smoothAngle,
                   Collocation collocation) {
  const ElasticModel model = makeModel(shape, fixed, 1, 0.3, smoothAngle);
  BoundaryElementOptions options = raw();
  options.collocation = collocation;
  options.columns = {model.conditions().freeNodes().front()};
  return computeBoundaryElementGreensFunctions(model, options).info.diagnostics.conditionEstimate;
}

/// The worse of both kinds of collocation.
double worstCondition(const Shape& shape, const Place& fixed, double smoothAngle = 30) {
  return std::max(conditionOf(shape, fixed, smoothAngle, Collocation::Averaged),
                  conditionOf(shape, fixed, smoothAngle, Collocation::Vertex));
}

bool twoFaces(const Eigen::Vector3d& x) {
  return x.z() < 1e-9 || x.x() < 1e-9;
}
bool threeFaces(const Eigen::Vector3d& x) {
  return twoFaces(x) || x.y() < 1e-9;
}

TEST(FixedFaces, ThatMeetInEdgesAndCornersKeepTheSystemRegular) {
  const std::string condition = "larger condition estimate of both collocations";
  const std::string danger = "tractions of two faces that one equation cannot tell apart";
  double two = 0;
  for (int divisions : {4, 8}) two = std::max(two, worstCondition(cube(divisions), twoFaces));
  hard("two fixed faces that meet in an edge", danger).expectAtMost(condition, two, 1e4);
  hard("three fixed faces that meet in a corner", danger)
      .expectAtMost(condition, worstCondition(cube(6), threeFaces), 1e4);
}

Shape bumpySphere() {
  return jitteredSphere(2, 0.3).mapped([](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return x * (1 + 0.05 * std::sin(31 * x.x() + 57 * x.y() + 43 * x.z()));
  });
}

TEST(FixedFaces, OfSingleTrianglesAllOverASupportKeepTheSystemRegular) {
  const auto lower = [](const Eigen::Vector3d& x) { return x.z() < -0.6; };
  double worst = 0;
  for (const double smoothAngle : {0.0, 30.0})
    worst = std::max(worst, worstCondition(bumpySphere(), lower, smoothAngle));
  hard("a support on which every triangle is a smooth patch", "six tractions at a vertex")
      .expectAtMost("largest condition estimate of both collocations", worst, 1e4);
}

/// A wedge whose upper face rises from the edge at y = 0 by this slope; clamped at its thick end.
Shape wedge(double slope) {
  return box({1, 1, 1}, {4, 6, 1}).mapped([&](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x.x(), x.y(), slope * (0.02 + x.y()) * x.z());
  });
}

TEST(PatchTest, HoldsAtSharpEdgesCornersAndWedges) {
  // As on meshes: the integration tolerance, amplified by the solution.
  const std::string linear = "largest error of u of a linear field";
  const auto error = [](const Shape& shape, const Place& fixed, Collocation collocation) {
    BoundaryElementOptions options;
    options.collocation = collocation;
    return patchTestError(makeModel(shape, fixed, 1, 0.3), options);
  };
  const auto worse = [&](const Shape& shape, const Place& fixed) {
    return std::max(error(shape, fixed, Collocation::Averaged),
                    error(shape, fixed, Collocation::Vertex));
  };
  const std::string danger = "given and unknown tractions at one vertex";
  hard("cube on one, two, three fixed faces, both collocations", danger)
      .expectAtMost(
          linear,
          std::max({worse(cube(4), base), worse(cube(4), twoFaces), worse(cube(4), threeFaces)}),
          1e-5);
  const auto thickEnd = [](const Eigen::Vector3d& x) { return x.y() > 1 - 1e-9; };
  // The flattest is 0.001 thick at its end and bends, which amplifies the integration error.
  hard("wedges of 45°, 11°, 3° that end 0.02 from their edge", "faces that almost touch")
      .expectAtMost(linear,
                    std::max({worse(wedge(1), thickEnd), worse(wedge(0.2), thickEnd),
                              worse(wedge(0.05), thickEnd)}),
                    1e-4);
}

}  // namespace
}  // namespace palpate::test
