// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The same physics under units, motions and renumbering.

#include <gtest/gtest.h>

#include <algorithm>
#include <Eigen/Geometry>
#include <functional>
#include <numeric>
#include <random>

#include "bem/boundary_element_method.h"
#include "contact/capacitance_solver.h"
#include "contact/surface_stiffness.h"
#include "contact/variational_mask.h"
#include "stability/hard_case.h"
#include "support/problems.h"

namespace palpate::test {
namespace {

// NUMERICS.md section 6: what rounding may cost, coordinates of 16 digits far from the origin
// included.
constexpr double kSame = 1e-8;

HardCase hard(const std::string& name, const std::string& danger) {
  return {"scale", name, danger};
}

/// Its diagonal is 0.16.
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

/// Calls with lengths that make the body a micrometre to a thousand kilometres large, and pressures
/// that make its modulus 1e-3 to 1e12, from 1e4.
void forEachUnit(const std::function<void(double length, double pressure)>& call) {
  for (const double size : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    for (const double modulus : {1e-3, 1.0, 1e6, 1e12}) call(size / 0.16, modulus / 1e4);
}

ElasticModel inUnits(double length, double pressure) {
  return makeModel(
      body().scaled(length), [&](const Eigen::Vector3d& x) { return lower(x / length); },
      1e4 * pressure, 0.3);
}

TEST(SamePhysics, InAnyUnitOfLengthAndPressure) {
  const auto reference = stiffnesses(inUnits(1, 1), 0.02);
  const double condition =
      computeBoundaryElementGreensFunctions(inUnits(1, 1)).info.diagnostics.conditionEstimate;
  double stiffness = 0, conditions = 0;
  forEachUnit([&](double length, double pressure) {
    const ElasticModel model = inUnits(length, pressure);
    stiffness = std::max(stiffness, largestDifference(stiffnesses(model, 0.02 * length), reference,
                                                      length * pressure));
    const double other =
        computeBoundaryElementGreensFunctions(model).info.diagnostics.conditionEstimate;
    conditions = std::max(conditions, std::abs(other / condition - 1));
  });
  const auto units = hard("1e−6 … 1e6 m, E = 1e−3 … 1e12",
                          "raw conditions between 52 and 2e12: tolerances that go by units");
  units.expectAtMost("largest difference of K/(E L)", stiffness, kSame);
  units.expectAtMost("largest relative change of the condition estimate", conditions, 0.01);
}

TEST(SamePhysics, OfContactsInAnyUnit) {
  // Displacements of ten nodes, and of a released one its traction.
  const auto press = [](double length, double pressure) {
    const ElasticModel model = inUnits(length, pressure);
    const auto greens = computeGreens(model, rawWithAllColumns(model));
    std::vector<int> nodes = model.conditions().freeNodes();
    nodes.resize(10);
    BoundaryValues values = switchWholeNodes(nodes, 0.1 * model.mesh().points()(Eigen::all, nodes));
    for (int k = 0; k < 3; ++k)
      values.switches.push_back(
          {model.conditions().fixedNodes().front(), Eigen::Vector3d::Unit(k)});
    values.prescribed.conservativeResize(values.switches.size());
    values.prescribed.tail<3>().setConstant(100 * pressure);
    CapacitanceSolver solver(greens, std::make_shared<SurfaceMesh>(model.mesh()));
    BoundarySolution solution = solver.solve(values);
    solution.traction /= pressure;
    solution.displacement /= length;
    return solution;
  };
  const BoundarySolution reference = press(1, 1);
  double difference = 0, condition = 0;
  forEachUnit([&](double length, double pressure) {
    const BoundarySolution solution = press(length, pressure);
    difference = std::max(
        {difference, (solution.traction - reference.traction).norm() / reference.traction.norm(),
         (solution.displacement - reference.displacement).norm() / reference.displacement.norm()});
    condition = std::max(condition, std::abs(solution.condition / reference.condition - 1));
  });
  const auto contacts =
      hard("1e−6 … 1e6 m, E = 1e−3 … 1e12: ten nodes pressed and a support released",
           "a capacitance matrix of metres beside pascals");
  contacts.expectAtMost("largest difference of p/E and u/L", difference, kSame);
  contacts.expectAtMost("largest relative change of cond(C)", condition, 0.01);
}

TEST(SamePhysics, OfMasksInAnyUnitOfLength) {
  const auto mesh = body().mesh();
  const BoundaryConditions conditions(fixedWhere(body(), lower));
  const int vertex = conditions.freeNodes().front();
  double radial = 0, variational = 0;
  for (const double size : {1e-6, 1e-3, 1e3, 1e6}) {
    const double length = size / 0.16;
    const auto scaled = body().scaled(length).mesh();
    const auto difference = [&](const VertexMask& mask, const VertexMask& of) {
      if (mask.nodes != of.nodes) return 1.0;
      return (mask.density * length * length - of.density).norm() / of.density.norm();
    };
    for (const MaskShape shape :
         {MaskShape::Linear, MaskShape::Uniform, MaskShape::Gaussian, MaskShape::Hertzian})
      radial = std::max(
          radial, difference(PressureMasks(*scaled, conditions, shape, 0.02 * length).at(vertex),
                             PressureMasks(*mesh, conditions, shape, 0.02).at(vertex)));
    for (const MaskPenalty penalty : {MaskPenalty::Gradient, MaskPenalty::Biharmonic})
      variational = std::max(
          variational,
          difference(VariationalMasks(*scaled, conditions, penalty, 0.01 * length).at(vertex),
                     VariationalMasks(*mesh, conditions, penalty, 0.01).at(vertex)));
  }
  const auto masks =
      hard("masks of bodies of 1e−6 … 1e6 m", "densities of 1e12 / m² and 1e−12 / m²");
  masks.expectAtMost("largest difference of ρ L², radial masks", radial, 1e-12);
  masks.expectAtMost("largest difference of ρ L², variational masks", variational, kSame);
}

TEST(SamePhysics, InSinglePrecisionInAnyUnit) {
  BoundaryElementOptions single;
  single.precision = Precision::Float;
  const auto matrix = [&](double length, double pressure) {
    // Between free nodes, metres a pascal.
    const ComputedGreensFunctions result =
        computeBoundaryElementGreensFunctions(inUnits(length, pressure), single);
    Eigen::MatrixXd stored = Eigen::Map<const Eigen::MatrixXf>(
                                 result.floatMatrix.data(), 3 * result.info.conditions.nodeCount(),
                                 3 * result.info.columnNodes.size())
                                 .cast<double>();
    for (int node = 0; node < result.info.conditions.nodeCount(); ++node)
      if (!result.info.conditions.isFixed(node))
        stored.middleRows<3>(3 * node) *= pressure / length;
    return stored;
  };
  const Eigen::MatrixXd reference = matrix(1, 1);
  double worst = 0;
  forEachUnit([&](double length, double pressure) {
    worst = std::max(worst, (matrix(length, pressure) - reference).norm() / reference.norm());
  });
  // README.md: single precision to 1e-5 of the largest entries.
  hard("bodies of 1e−6 … 1e6 m, E = 1e−3 … 1e12, in single precision", "floats end at 1e±38")
      .expectAtMost("largest difference of Ξ E/L", worst, 1e-5);
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
  hard("turned, and a thousand sizes from the origin", "differences of large coordinates")
      .expectAtMost("largest difference of K",
                    largestDifference(stiffnesses(makeModel(moved, fixed, 1e4, 0.3), 0.02),
                                      reference, 1, turn),
                    kSame);
}

/// Its vertices on the edge between two fixed faces carry two unknown tractions, and at its ends a
/// third that is given.
bool onTwoFaces(const Eigen::Vector3d& x) {
  return x.z() < 1e-9 || x.x() < 1e-9;
}

/// Largest difference of K under another numbering.
double renumberingDifference(const Shape& shape, bool (*fixed)(const Eigen::Vector3d&),
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
  double worst = 0;
  for (int v : model.conditions().freeNodes())
    worst = std::max(worst, (a.elastic(v) - b.elastic(newNumber[v])).norm() / a.elastic(v).norm());
  return worst;
}

TEST(SamePhysics, UnderAnyNumberingOfVerticesAndTriangles) {
  hard("vertices, triangles and corners renumbered", "results that go by the order of a file")
      .expectAtMost(
          "largest difference of K",
          std::max(renumberingDifference(body(), lower, 0.02),
                   renumberingDifference(box(Eigen::Vector3d::Ones(), Eigen::Vector3i::Constant(4)),
                                         onTwoFaces, 0.3)),
          kSame);
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
