// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/elastic_foundation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "bem/interior_probes.h"
#include "contact/capacitance_matrix.h"
#include "greens/gravity.h"
#include "support/problems.h"
#include "support/refusals.h"
#include "support/solids.h"

namespace palpate::test {
namespace {

constexpr double kModulus = 2;

bool onBase(const Eigen::Vector3d& x) {
  return x.z() < 1e-9;
}

Eigen::MatrixXd matrixOf(const GreensFunctions& greens, const std::vector<int>& nodes) {
  Eigen::MatrixXd matrix(3 * nodes.size(), 3 * nodes.size());
  greens.gather(nodeList(nodes), nodeList(nodes), matrix.data());
  return matrix;
}

struct Block {
  SolidProblem problem;
  std::shared_ptr<const GreensFunctions> greens;

  Block(const Eigen::Vector3d& size, const Eigen::Vector3i& divisions, double poissonRatio,
        bool reciprocal = true)
      : problem(solidProblem(kuhnBox(size, divisions).mesh(), onBase, kModulus, poissonRatio)) {
    FiniteElementOptions options = allColumns(problem.model);
    options.reciprocal = reciprocal;
    greens = problem.greens(options);
  }
  const ElasticModel& model() const { return problem.model; }
  const SurfaceMesh& mesh() const { return problem.model.mesh(); }
  FoundedGreensFunctions on(double normal, double shear) const {
    return on(foundationSprings(mesh(), model().conditions().fixedNodes(), normal, shear));
  }
  FoundedGreensFunctions on(const Eigen::Matrix3Xd& springs) const {
    return onElasticFoundation(*greens, model(), springs);
  }
};

TEST(ElasticFoundation, HasTheStiffnessOfItsArea) {
  const Block block({1, 2, 1}, {2, 3, 2}, 0.3);
  const Eigen::Matrix3Xd springs =
      foundationSprings(block.mesh(), block.model().conditions().fixedNodes(), 3, 0.5);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int v = 0; v < block.mesh().vertexCount(); ++v) sum += springs.middleCols<3>(3 * v);
  EXPECT_LT((sum - Eigen::Vector3d(1, 1, 6).asDiagonal().toDenseMatrix()).norm(), 1e-12);
  const Eigen::Matrix3Xd alone = foundationSprings(block.mesh(), {3}, 4, 4);
  EXPECT_LT(
      (alone.middleCols<3>(9) - 4 * block.mesh().vertexAreas()[3] * Eigen::Matrix3d::Identity())
          .norm(),
      1e-12);
}

TEST(ElasticFoundation, SinksUnderItsLoadAndWeightByThatOverItsStiffness) {
  // Whatever its shape does, the mean of the base's displacement is force over stiffness.
  const Block block({1, 1, 2}, {2, 2, 3}, 0.3);
  const double normal = 5, shear = 0.7;
  const auto greens = block.on(normal, shear).greens.take();
  EXPECT_EQ(greens->info().domain, Domain::Given);
  EXPECT_TRUE(greens->info().conditions.fixedNodes().empty());
  const Eigen::Matrix3Xd springs =
      foundationSprings(block.mesh(), block.model().conditions().fixedNodes(), normal, shear);
  const auto meanOfBase = [&](const Eigen::Matrix3Xd& u) {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    for (int v = 0; v < u.cols(); ++v) force += springs.middleCols<3>(3 * v) * u.col(v);
    return force;
  };
  Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, block.mesh().vertexCount());
  const int top = 3;
  for (int v = 0; v < given.cols(); ++v)
    if (block.mesh().points()(2, v) > 1.9) given.col(v) = Eigen::Vector3d(0.2, -0.1, -1);
  Eigen::Vector3d load = Eigen::Vector3d::Zero();
  for (int v = 0; v < given.cols(); ++v) load += block.mesh().vertexAreas()[v] * given.col(v);
  ASSERT_GT(load.norm(), top * 0.1);
  EXPECT_LT((meanOfBase(solveReferenceProblem(*greens, given)) - load).norm(), 1e-9 * load.norm());
  const Eigen::Vector3d weight(0.1, 0.3, -1);
  const Eigen::Matrix3Xd sag =
      gravityDisplacement(*greens, block.mesh(), block.model().smoothPatches(), weight);
  EXPECT_LT((meanOfBase(sag) - 2 * weight).norm(), 1e-9);
}

TEST(ElasticFoundation, OfNoGiveIsAFixedSupportAndOneOfAllGiveAlmostNone) {
  const Block block({1, 1, 1}, {2, 2, 2}, 0.3);
  const std::vector<int> free = block.model().conditions().freeNodes();
  const Eigen::MatrixXd fixed = matrixOf(*block.greens, free);
  double before = 0;
  for (double stiffness : {1e3, 1e4, 1e5}) {
    const auto greens = block.on(stiffness, stiffness).greens.take();
    const double difference = (matrixOf(*greens, free) - fixed).norm() / fixed.norm();
    if (before > 0) {
      EXPECT_NEAR(before / difference, 10, 0.5);  // as 1 / stiffness
    }
    before = difference;
  }
  EXPECT_LT(before, 1e-3);
  // Soft: it moves as a rigid body does, the rest is small beside it.
  const double soft = 1e-6;
  const auto greens = block.on(soft, soft).greens.take();
  Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, block.mesh().vertexCount());
  for (int v = 0; v < given.cols(); ++v) given.col(v) = Eigen::Vector3d::UnitX();
  const Eigen::Matrix3Xd u = solveReferenceProblem(*greens, given);
  // Six faces push sideways, at half the height on average: it slides by F / k and tilts.
  double mean = 0;
  for (int v : block.model().conditions().fixedNodes()) mean += u(0, v) / 9;
  EXPECT_NEAR(mean * soft, 6, 0.01);
}

TEST(ElasticFoundation, AgreesWithSpringsOfTheCapacitanceMatrix) {
  // Springs along the axes, as switches of released nodes that give way.
  const Block block({1, 1, 1}, {2, 2, 2}, 0.3, false);
  const std::vector<int> fixed = block.model().conditions().fixedNodes();
  Eigen::Matrix3Xd springs = Eigen::Matrix3Xd::Zero(3, 3 * block.mesh().vertexCount());
  std::vector<ConstraintSwitch> switches = switchesOfNodes(fixed);
  for (ConstraintSwitch& s : switches) {
    const double stiffness = 0.5 + 0.1 * s.node + s.direction.z();
    s.yield = stiffness / block.greens->vertexArea(s.node);
    springs.middleCols<3>(3 * s.node) += stiffness * s.direction * s.direction.transpose();
  }
  const auto founded = block.on(springs).greens.take();
  const int loaded = block.model().conditions().freeNodes().back();
  Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, block.mesh().vertexCount());
  given.col(loaded) = Eigen::Vector3d(1, 2, 3);
  Eigen::Matrix3Xd expected = solveReferenceProblem(*block.greens, given);
  const CapacitanceMatrix capacitance(block.greens, switches);
  Eigen::VectorXd right(switches.size()), values(switches.size());
  for (std::size_t i = 0; i < switches.size(); ++i)
    right[i] = -switches[i].direction.dot(expected.col(switches[i].node));
  capacitance.solve(right.data(), values.data());
  Eigen::Matrix3Xd moved = Eigen::Matrix3Xd::Zero(3, given.cols());
  for (std::size_t i = 0; i < switches.size(); ++i)
    moved.col(switches[i].node) += values[i] * switches[i].direction;
  expected += solveReferenceProblem(*block.greens, moved);
  for (int v : fixed) expected.col(v) = moved.col(v);
  const Eigen::Matrix3Xd found = solveReferenceProblem(*founded, given);
  EXPECT_LT((found - expected).norm(), 1e-9 * expected.norm());
}

TEST(ElasticFoundation, TakesPartOfWhatActsOnFreeVertices) {
  // (C^-1 + S)^-1, whichever way.
  const Block block({1, 1, 1}, {2, 2, 2}, 0.3);
  const std::vector<int> free = block.model().conditions().freeNodes();
  Eigen::MatrixXd compliance = matrixOf(*block.greens, free);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(compliance.rows(), compliance.cols());
  Eigen::Matrix3Xd springs = Eigen::Matrix3Xd::Zero(3, 3 * block.mesh().vertexCount());
  for (std::size_t i = 0; i < free.size(); ++i) {
    compliance.middleCols<3>(3 * i) /= block.greens->vertexArea(free[i]);
    if (i % 3 != 0) continue;
    const Eigen::Vector3d direction = Eigen::Vector3d(1, 0.3 * i, -1).normalized();
    springs.middleCols<3>(3 * free[i]) = 4 * direction * direction.transpose();
    stiffness.block<3, 3>(3 * i, 3 * i) = springs.middleCols<3>(3 * free[i]);
  }
  const Eigen::MatrixXd expected = (compliance.inverse() + stiffness).inverse();
  const auto founded = block.on(springs).greens.take();
  EXPECT_FALSE(founded->info().conditions.fixedNodes().empty());
  Eigen::MatrixXd found = matrixOf(*founded, free);
  for (std::size_t i = 0; i < free.size(); ++i)
    found.middleCols<3>(3 * i) /= block.greens->vertexArea(free[i]);
  EXPECT_LT((found - expected).norm(), 1e-9 * expected.norm());
  EXPECT_LT((found - found.transpose()).norm(), 1e-12 * found.norm());
}

TEST(ElasticFoundation, KeepsTheProbesOfItsBody) {
  // A bar without contraction between an even pull p and springs: below it, and also at its top.
  constexpr double height = 4, normal = 0.8, onTop = 0.6;
  const Eigen::Vector3d place(0.4, 0.55, 1.2);
  SolidProblem bar = solidProblem(kuhnBox({1, 1, height}, {3, 3, 12}).mesh(), onBase, kModulus, 0);
  FiniteElementOptions options = allColumns(bar.model);
  options.probes = place;
  const auto firm = bar.greens(options);
  const SurfaceMesh& mesh = bar.model.mesh();
  std::vector<double> topArea(mesh.vertexCount(), 0);
  for (int f = 0; f < mesh.triangleCount(); ++f)
    if (mesh.triangleNormals()(2, f) > 0.5)
      for (int v : mesh.triangles().col(f)) topArea[v] += mesh.triangleAreas()[f] / 3;
  for (const bool isHeldAbove : {false, true}) {
    Eigen::Matrix3Xd springs =
        foundationSprings(mesh, bar.model.conditions().fixedNodes(), normal, normal);
    for (int v = 0; v < mesh.vertexCount() && isHeldAbove; ++v)
      springs(2, 3 * v + 2) += onTop * topArea[v];
    const auto greens = onElasticFoundation(*firm, bar.model, springs).greens.take();
    const auto stiffer = greens->withYoungsModulus(3 * kModulus);  // springs and all
    // p = stress + onTop u(height), where u(z) = stress (1 / normal + z / E).
    const double stress = 1 / (1 + (isHeldAbove ? onTop * (1 / normal + height / kModulus) : 0));
    for (const auto& [served, scale] : {std::pair(greens, 1.), std::pair(stiffer, 3.)}) {
      const ProbeRows& rows = *served->info().probes;
      ProbeValues values = ProbeValues::Zero();
      for (int v = 0; v < mesh.vertexCount(); ++v)
        rows.accumulate(0, v, Eigen::Vector3d(0, 0, topArea[v] / mesh.vertexAreas()[v]), values);
      const ProbedField field = fieldOf(values, rows.stiffness(0));
      EXPECT_NEAR(field.stress(2, 2) / stress, 1, 0.02);  // the pull is uneven at the top's edges
      EXPECT_NEAR(scale * field.displacement.z() / (stress * (1 / normal + place.z() / kModulus)),
                  1, 0.01);
      EXPECT_LT(std::abs(field.stress(0, 2)) + std::abs(field.stress(0, 0)), 0.05);
    }
  }
}

TEST(ElasticFoundation, ProbesFollowASupportThatIsMoved) {
  // What a fixed vertex' column does inside: moved as one, the support takes the body with it, also
  // where only some of it has been released, onto springs that are too soft to be felt.
  SolidProblem block = solidProblem(kuhnBox({1, 1, 1}, {2, 2, 2}).mesh(), onBase, kModulus, 0.48);
  FiniteElementOptions options = allColumns(block.model);
  options.probes = Eigen::Vector3d(0.3, 0.6, 0.4);
  const auto firm = block.greens(options);
  const int released = block.model.conditions().fixedNodes().front();
  Eigen::Matrix3Xd springs = Eigen::Matrix3Xd::Zero(3, 3 * block.model.mesh().vertexCount());
  springs.middleCols<3>(3 * released).diagonal().setConstant(1e-9);
  const auto loosened = onElasticFoundation(*firm, block.model, springs).greens.take();
  const auto stiffer = firm->withYoungsModulus(5 * kModulus);
  const Eigen::Vector3d shift(0.1, -0.2, 0.3);
  for (const auto& greens : {firm, loosened, stiffer}) {
    ProbeValues values = ProbeValues::Zero();
    for (int v : greens->info().conditions.fixedNodes())
      greens->info().probes->accumulate(0, v, shift, values);
    EXPECT_LT((values.head<3>() - shift).norm(), 1e-7);
    EXPECT_LT(values.tail<10>().norm(), 1e-7);
  }
}

TEST(ElasticFoundation, HoldsAnUnsupportedBodyAsItHoldsAReleasedOne) {
  // The same springs by two ways: a support released, and a body that nothing held. What differs is
  // how each discretisation has the support's edge.
  double differences[2];
  for (int level = 2; level <= 3; ++level) {
    const ElasticModel held = makeModel(icosphere(level), cap, kModulus, 0.3);
    const ElasticModel loose = makeModel(
        icosphere(level), [](const auto&) { return false; }, kModulus, 0.3, 30,
        Domain::Unsupported);
    BoundaryElementOptions all;
    for (int v = 0; v < held.mesh().vertexCount(); ++v) all.columns.push_back(v);
    const auto ofHeld = computeBoundaryElementGreensFunctions(held, all).take();
    const auto ofLoose = computeBoundaryElementGreensFunctions(loose).take();
    const Eigen::Matrix3Xd springs =
        foundationSprings(held.mesh(), held.conditions().fixedNodes(), 3, 1);
    const auto a = onElasticFoundation(*ofHeld, held, springs).greens.take(),
               b = onElasticFoundation(*ofLoose, loose, springs).greens.take();
    Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, held.mesh().vertexCount());
    for (int v = 0; v < given.cols(); ++v)
      if (held.mesh().points()(2, v) > 0.7) given.col(v) = Eigen::Vector3d(0.3, 0, -1);
    const Eigen::Matrix3Xd u = solveReferenceProblem(*a, given),
                           w = solveReferenceProblem(*b, given);
    differences[level - 2] = (u - w).norm() / u.norm();
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), load = force;
    for (int v = 0; v < given.cols(); ++v) {
      force += springs.middleCols<3>(3 * v) * w.col(v);
      load += held.mesh().vertexAreas()[v] * given.col(v);
    }
    EXPECT_LT((force - load).norm(), 1e-9 * load.norm());
  }
  EXPECT_LT(differences[1], 0.02);
  EXPECT_LT(differences[1], differences[0]);
}

/// Springs' forces and their moments about the origin.
Eigen::Matrix<double, 6, 1> resultantOf(const SurfaceMesh& mesh, const Eigen::Matrix3Xd& springs,
                                        const Eigen::Matrix3Xd& displacement) {
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (int v = 0; v < mesh.vertexCount(); ++v) {
    const Eigen::Vector3d force = springs.middleCols<3>(3 * v) * displacement.col(v);
    const Eigen::Vector3d place = mesh.points().col(v);
    sum += (Eigen::Matrix<double, 6, 1>() << force, place.cross(force)).finished();
  }
  return sum;
}

TEST(ElasticFoundation, BearsTheWeightOfAnUnsupportedBodyOfTwoDensities) {
  // The lower half of a bar is three times as dense as the upper: its middle is at 5/8 of 2 / 2.
  const Eigen::Vector3d size(1, 1, 2), weight(0.2, -0.1, -0.7), probe(0.4, 0.6, 0.9);
  const Eigen::Vector3d middle(0.5, 0.5, (1.5 * 0.5 + 0.5 * 1.5) / 2);
  double differences[2], inside[2];
  for (int level = 0; level < 2; ++level) {
    const int n = level ? 4 : 2;
    const TetrahedralMesh mesh = kuhnBox(size, {n, n, 2 * n}).mesh();
    Eigen::VectorXd densities(mesh.cellCount());
    for (int cell = 0; cell < mesh.cellCount(); ++cell)
      densities[cell] = mesh.points()(2, mesh.tetrahedra().col(cell)).mean() < 1 ? 3 : 1;
    std::shared_ptr<const GreensFunctions> founded[2];
    const ElasticModel held = makeModel(boundaryOf(mesh), onBase, kModulus, 0.3);
    const Eigen::Matrix3Xd springs =
        foundationSprings(held.mesh(), held.conditions().fixedNodes(), 4, 1);
    Eigen::Matrix3Xd sunk[2];
    ProbeValues values[2];
    for (const bool isLoose : {false, true}) {
      const ElasticModel model = isLoose ? makeModel(
                                               boundaryOf(mesh), [](const auto&) { return false; },
                                               kModulus, 0.3, 30, Domain::Unsupported)
                                         : held;
      const SolidBody body(model.mesh(), mesh, {Elasticity(Material(kModulus, 0.3))}, {},
                           densities);
      FiniteElementOptions options;
      if (!isLoose) options = allColumns(model);
      options.probes = probe;
      const auto greens = computeFiniteElementGreensFunctions(model, body, options).take();
      founded[isLoose] = onElasticFoundation(*greens, model, springs).greens.take();
      sunk[isLoose] =
          gravityDisplacement(*founded[isLoose], model.mesh(), model.smoothPatches(), weight);
      values[isLoose].setZero();
      for (int v = 0; v < model.mesh().vertexCount(); ++v)
        if (model.mesh().points()(2, v) > 1.9)
          founded[isLoose]->info().probes->accumulate(0, v, Eigen::Vector3d(0.3, 0, -1),
                                                      values[isLoose]);
      if (isLoose) {
        EXPECT_TRUE(isRefused(
            [&] { gravityDisplacement(*greens, model.mesh(), model.smoothPatches(), weight); },
            "falls freely"));
      }
    }
    const Eigen::Matrix<double, 6, 1> borne = resultantOf(held.mesh(), springs, sunk[1]);
    EXPECT_LT((borne.head<3>() - 2 * weight).norm(), 1e-9);
    EXPECT_LT((borne.tail<3>() - middle.cross(2 * weight)).norm(), 1e-9);
    differences[level] = (sunk[1] - sunk[0]).norm() / sunk[0].norm();
    inside[level] = (values[1] - values[0]).norm() / values[0].norm();
  }
  // What differs is how each discretisation has the support's edge: of first order.
  EXPECT_LT(differences[1], 0.04);
  EXPECT_LT(differences[1], 0.7 * differences[0]);
  EXPECT_LT(inside[1], 0.05);
  EXPECT_LT(inside[1], 0.7 * inside[0]);
}

TEST(ElasticFoundation, OfAnUnsupportedBallByItsSurfaceAloneBearsItsWeightAndIsSeenInside) {
  const ElasticModel loose = makeModel(
      icosphere(3), [](const auto&) { return false; }, kModulus, 0.3, 30, Domain::Unsupported);
  const SurfaceMesh& mesh = loose.mesh();
  const auto greens = computeBoundaryElementGreensFunctions(loose).take();
  const Eigen::Vector3d weight(0.1, 0.2, -0.5), probe(0.1, -0.2, 0.3);
  std::vector<int> below;
  for (int v = 0; v < mesh.vertexCount(); ++v)
    if (cap(mesh.points().col(v))) below.push_back(v);
  const Eigen::Matrix3Xd springs = foundationSprings(mesh, below, 3, 1);
  const auto probes = std::make_shared<const ProbeRows>(probeRows(*greens, loose, probe));
  const auto founded = onElasticFoundation(*greens, loose, springs, probes).greens.take();
  const Eigen::Matrix3Xd sunk = gravityDisplacement(*founded, mesh, loose.smoothPatches(), weight);
  double volume = 0;
  for (int f = 0; f < mesh.triangleCount(); ++f)
    volume += mesh.triangleAreas()[f] / 3 *
              mesh.triangleNormals().col(f).dot(mesh.points().col(mesh.triangles()(0, f)));
  const Eigen::Matrix<double, 6, 1> borne = resultantOf(mesh, springs, sunk);
  EXPECT_LT((borne.head<3>() - volume * weight).norm(), 1e-9 * volume);
  EXPECT_LT(borne.tail<3>().norm(), 1e-3 * volume);  // loads of triangles are shared to corners
  // Under no force but its springs', moved rigidly, and under a push that the springs bear.
  Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, mesh.vertexCount());
  for (int v = 0; v < given.cols(); ++v)
    if (mesh.points()(2, v) > 0.7) given.col(v) = Eigen::Vector3d(0.3, 0, -1);
  const Eigen::Matrix3Xd u = solveReferenceProblem(*founded, given);
  Eigen::Matrix3Xd traction = given;
  for (int v : below)
    traction.col(v) -= springs.middleCols<3>(3 * v) * u.col(v) / mesh.vertexAreas()[v];
  const ProbedField expected = InteriorProbes(loose, probe).evaluate(u, traction).front();
  ProbeValues values = ProbeValues::Zero();
  for (int v = 0; v < given.cols(); ++v)
    founded->info().probes->accumulate(0, v, given.col(v), values);
  const ProbedField found = fieldOf(values, founded->info().probes->stiffness(0));
  EXPECT_LT((found.displacement - expected.displacement).norm(), 1e-9 * u.norm());
  EXPECT_LT((found.stress - expected.stress).norm(), 1e-7 * expected.stress.norm());
}

TEST(ElasticFoundation, RefusesWhatDoesNotHold) {
  const Block block({1, 1, 1}, {1, 1, 1}, 0.3);
  const int nodes = block.mesh().vertexCount();
  const auto springsOf = [&](int vertex, const Eigen::Matrix3d& spring) {
    Eigen::Matrix3Xd springs = Eigen::Matrix3Xd::Zero(3, 3 * nodes);
    springs.middleCols<3>(3 * vertex) = spring;
    return springs;
  };
  const int fixed = block.model().conditions().fixedNodes().front(),
            free = block.model().conditions().freeNodes().front();
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  EXPECT_TRUE(isRefused([&] { block.on(springsOf(fixed, 0 * identity)); }, "no spring"));
  EXPECT_TRUE(isRefused([&] { block.on(springsOf(free, -identity)); }, "negative stiffness -1"));
  EXPECT_TRUE(isRefused([&] { block.on(springsOf(fixed, Eigen::Vector3d(1, 1, 0).asDiagonal())); },
                        "resists some directions only"));
  Eigen::Matrix3d skew = identity;
  skew(0, 1) = 0.5;
  EXPECT_TRUE(isRefused([&] { block.on(springsOf(free, skew)); }, "is not symmetric"));
  EXPECT_TRUE(isRefused([&] { block.on(springsOf(free, NAN * identity)); }, "is not finite"));
  EXPECT_TRUE(isRefused([&] { block.on(Eigen::Matrix3Xd::Zero(3, 6)); }, "for 2 vertices of 8"));
  EXPECT_TRUE(isRefused([&] { block.on(-1, 1); }, "at least 0, not -1"));
  const auto freeOnly = block.problem.greens();
  EXPECT_TRUE(
      isRefused([&] { onElasticFoundation(*freeOnly, block.model(), springsOf(fixed, identity)); },
                "were not computed"));
  const ElasticModel loose = makeModel(
      icosphere(1), [](const auto&) { return false; }, kModulus, 0.3, 30, Domain::Unsupported);
  const auto ofLoose = computeBoundaryElementGreensFunctions(loose).take();
  Eigen::Matrix3Xd two = Eigen::Matrix3Xd::Zero(3, 3 * loose.mesh().vertexCount());
  two.middleCols<6>(0) << identity, identity;  // it can turn about the line through both
  EXPECT_TRUE(isRefused([&] { onElasticFoundation(*ofLoose, loose, two); },
                        "leave a motion of the body free"));
}

}  // namespace
}  // namespace palpate::test
