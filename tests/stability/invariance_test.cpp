// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The same physics under units, motions and renumbering.

#include <gtest/gtest.h>

#include <algorithm>
#include <Eigen/Geometry>
#include <numeric>
#include <random>

#include "bem/boundary_element_method.h"
#include "contact/surface_stiffness.h"
#include "support/problems.h"

namespace palpate::test {
namespace {

constexpr double kSame = 1e-8;

Shape body() {
  return icosphere(2).mapped([](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(0.06 * x.x(), 0.04 * x.y() + 0.3 * 0.06 * x.x() * x.x(), 0.03 * x.z());
  });
}
bool lower(const Eigen::Vector3d& x) {
  return x.z() < -0.02;
}

/// K_i of all free vertices under a mask, in the model's units.
std::vector<Eigen::Matrix3d> stiffnesses(const ElasticModel& model, double radius) {
  const auto greens = computeGreens(model, {});
  const SurfaceStiffness stiffness(greens, std::make_shared<SurfaceMesh>(model.mesh()),
                                   MaskShape::Linear, radius);
  std::vector<Eigen::Matrix3d> k;
  for (int v : model.conditions().freeNodes()) k.push_back(stiffness.elastic(v));
  return k;
}

double largestDifference(const std::vector<Eigen::Matrix3d>& a,
                         const std::vector<Eigen::Matrix3d>& b, double factor,
                         const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity()) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest =
        std::max(largest, (a[i] - factor * turn * b[i] * turn.transpose()).norm() / a[i].norm());
  return largest;
}

TEST(SamePhysics, InMillimetresKilometresAndMegapascals) {
  const auto reference = stiffnesses(makeModel(body(), lower, 1e4, 0.3), 0.02);
  const double condition = computeBoundaryElementGreensFunctions(makeModel(body(), lower, 1e4, 0.3))
                               .info.diagnostics.conditionEstimate;
  for (const double length : {1e3, 1e-3, 1e-9, 1e6})
    for (const double pressure : {1.0, 1e-6, 1e9}) {
      const auto fixed = [&](const Eigen::Vector3d& x) { return lower(x / length); };
      const ElasticModel model = makeModel(body().scaled(length), fixed, 1e4 * pressure, 0.3);
      EXPECT_LT(largestDifference(stiffnesses(model, 0.02 * length), reference, length * pressure),
                kSame)
          << length << " " << pressure;
      EXPECT_NEAR(computeBoundaryElementGreensFunctions(model).info.diagnostics.conditionEstimate /
                      condition,
                  1, 0.01);
    }
}

TEST(SamePhysics, TurnedAndFarFromTheOrigin) {
  const auto reference = stiffnesses(makeModel(body(), lower, 1e4, 0.3), 0.02);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Eigen::Vector3d shift(30, -50, 20);  // a thousand sizes away costs three digits of 16
  const Shape moved = body().mapped([&](const Eigen::Vector3d& x) { return turn * x + shift; });
  const auto fixed = [&](const Eigen::Vector3d& x) {
    return lower(turn.transpose() * (x - shift));
  };
  EXPECT_LT(
      largestDifference(stiffnesses(makeModel(moved, fixed, 1e4, 0.3), 0.02), reference, 1, turn),
      kSame);
}

/// Its vertices on the edge between two fixed faces carry two unknown tractions, and at its ends a
/// third that is given.
bool onTwoFaces(const Eigen::Vector3d& x) {
  return x.z() < 1e-9 || x.x() < 1e-9;
}

void expectSameUnderAnyNumbering(const Shape& shape, bool (*fixed)(const Eigen::Vector3d&),
                                 double radius) {
  std::vector<int> newNumber(shape.points.cols()), newTriangle(shape.triangles.cols());
  std::iota(newNumber.begin(), newNumber.end(), 0);
  std::iota(newTriangle.begin(), newTriangle.end(), 0);
  std::mt19937 random(7);
  std::shuffle(newNumber.begin(), newNumber.end(), random);
  std::shuffle(newTriangle.begin(), newTriangle.end(), random);
  Shape renumbered = shape;
  for (int v = 0; v < shape.points.cols(); ++v)
    renumbered.points.col(newNumber[v]) = shape.points.col(v);
  for (int f = 0; f < shape.triangles.cols(); ++f)
    for (int k = 0; k < 3; ++k)  // each triangle starts at another corner, too
      renumbered.triangles((k + f) % 3, newTriangle[f]) = newNumber[shape.triangles(k, f)];

  const ElasticModel model = makeModel(shape, fixed, 1e4, 0.3);
  const ElasticModel other = makeModel(renumbered, fixed, 1e4, 0.3);
  const SurfaceStiffness a(computeGreens(model, {}), shape.mesh(), MaskShape::Linear, radius);
  const SurfaceStiffness b(computeGreens(other, {}), renumbered.mesh(), MaskShape::Linear, radius);
  for (int v : model.conditions().freeNodes())
    EXPECT_LT((a.elastic(v) - b.elastic(newNumber[v])).norm(), kSame * a.elastic(v).norm());
}

TEST(SamePhysics, UnderAnyNumberingOfVerticesAndTriangles) {
  expectSameUnderAnyNumbering(body(), lower, 0.02);
  expectSameUnderAnyNumbering(box(Eigen::Vector3d::Ones(), Eigen::Vector3i::Constant(4)),
                              onTwoFaces, 0.3);
}

TEST(SamePhysics, ScalesExactlyWithYoungsModulus) {
  const auto soft =
      computeBoundaryElementGreensFunctions(makeModel(body(), lower, 1e4, 0.3)).take();
  const auto stiff =
      computeBoundaryElementGreensFunctions(makeModel(body(), lower, 8e4, 0.3)).take();
  const auto scaled = soft->withYoungsModulus(8e4);
  const std::vector<int>& nodes = soft->info().columnNodes;
  Eigen::MatrixXd a(3 * soft->nodeCount(), 3 * nodes.size()), b = a;
  std::vector<int> rows(soft->nodeCount());
  std::iota(rows.begin(), rows.end(), 0);
  stiff->gather(nodeList(rows), nodeList(nodes), a.data());
  scaled->gather(nodeList(rows), nodeList(nodes), b.data());
  EXPECT_LT((a - b).norm(), 1e-15 * a.norm());
}

}  // namespace
}  // namespace palpate::test
