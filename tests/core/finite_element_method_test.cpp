// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fem/finite_element_method.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <numeric>

#include "contact/pressure_mask.h"
#include "support/mask_compliances.h"
#include "support/refusals.h"
#include "support/solids.h"

namespace palpate::test {
namespace {

bool base(const Eigen::Vector3d& x) {
  return x.z() < 1e-9;
}

Elasticity fibres() {
  return Elasticity::transverselyIsotropic({1, 2, 3}, 60, 0.3, 20, 0.4, 9);
}

/// The columns as one matrix, 3 #nodes by 3 #columns.
Eigen::MatrixXd columnsOf(const GreensFunctions& greens, const std::vector<int>& columns) {
  std::vector<int> rows(greens.nodeCount());
  std::iota(rows.begin(), rows.end(), 0);
  Eigen::MatrixXd result(3 * rows.size(), 3 * columns.size());
  greens.gather(nodeList(rows), nodeList(columns), result.data());
  return result;
}

/// The vertex nearest to a place.
int vertexAt(const SurfaceMesh& mesh, const Eigen::Vector3d& x) {
  Eigen::Index vertex;
  (mesh.points().colwise() - x).colwise().squaredNorm().minCoeff(&vertex);
  return static_cast<int>(vertex);
}

bool isTop(const SurfaceMesh& mesh, int triangle) {
  return mesh.triangleNormals()(2, triangle) > 0.5;
}

/// Each triangle of the top is a patch of its own, so that each vertex there has patch columns and
/// any traction on the top is the elements' exactly.
ElasticModel withPatchesOnTop(const ElasticModel& model) {
  Eigen::VectorXi patches = model.smoothPatches();
  const int first = patches.maxCoeff() + 1;
  for (int f = 0; f < patches.size(); ++f)
    if (isTop(model.mesh(), f)) patches[f] = first + f;
  return ElasticModel(model.sharedMesh(), model.material(), model.conditions(), patches);
}

/// The answer to this traction on all of the top, while fixed vertices move as given.
Eigen::Matrix3Xd pulled(const ElasticModel& model, const GreensFunctions& greens,
                        const Eigen::Vector3d& traction, const Eigen::Matrix3Xd& given) {
  Eigen::Matrix3Xd tractions = Eigen::Matrix3Xd::Zero(3, model.mesh().triangleCount()), applied;
  double area = 0;
  for (int f = 0; f < tractions.cols(); ++f)
    if (isTop(model.mesh(), f)) {
      tractions.col(f) = traction;
      area += model.mesh().triangleAreas()[f];
    }
  const Eigen::Matrix3Xd answer =
      solveFaceTractions(greens, model.mesh(), model.smoothPatches(), tractions, applied);
  EXPECT_LT((applied.rowwise().sum() - area * traction).norm(), 1e-12 * area);
  return answer + solveReferenceProblem(greens, given);
}

/// Whether a vertex of the box [0, size] is on one side of it alone.
bool isInsideASide(const Eigen::Vector3d& x, const Eigen::Vector3d& size) {
  const Eigen::Array3d place = x.array() / size.array();
  return (place < 1e-9 || place > 1 - 1e-9).count() == 1;
}

/// What fills a body, and with which elements.
struct Filling {
  const char* name;
  Elasticity elasticity;
  double poissonRatio;  ///< of the model, where the material is isotropic
  SolidElement element;
};

const Filling kFillings[] = {
    {"Compressible", Elasticity(Material(1, 0.3)), 0.3, SolidElement::Quadratic},
    {"CompressibleOfLinearElements", Elasticity(Material(1, 0.3)), 0.3, SolidElement::Linear},
    {"NearlyIncompressible", Elasticity(Material(1, 0.4999)), 0.4999, SolidElement::Quadratic},
    {"Incompressible", Elasticity(Material(1, 0.5)), 0.5, SolidElement::Quadratic},
    {"Fibrous", fibres(), 0.3, SolidElement::Quadratic},
    {"FibrousOfLinearElements", fibres(), 0.3, SolidElement::Linear},
};

class FiniteElementsOf : public testing::TestWithParam<Filling> {
 protected:
  /// A block, no edge of whose cells is along another's.
  SolidProblem skewBlock() const {
    const TetrahedralMesh mesh =
        kuhnBox({1, 1.2, 1.4}, {3, 3, 4})
            .mapped([](const Eigen::Vector3d& x) -> Eigen::Vector3d {
              return x + 0.1 * x.z() * Eigen::Vector3d(x.y(), 0.3 + x.x() * x.x(), -0.2 * x.y());
            })
            .mesh();
    const ElasticModel model = makeModel(boundaryOf(mesh), base, 1, GetParam().poissonRatio);
    return {model, SolidBody(model.mesh(), mesh, {GetParam().elasticity})};
  }
};

TEST_P(FiniteElementsOf, AFillingAreReciprocalAndRigidOnesMoveRigidly) {
  const SolidProblem problem = skewBlock();
  FiniteElementOptions options;
  options.element = GetParam().element;
  const auto greens = problem.greens(options);
  // Before symmetrising: the Schur complement of a symmetric matrix, to rounding times condition.
  EXPECT_LT(greens->info().diagnostics.reciprocityDefect, 1e-12);
  EXPECT_LT(greens->info().diagnostics.rotationDefect, 1e-10);
  EXPECT_GE(greens->info().diagnostics.rotationDefect, 0);
  EXPECT_TRUE(greens->info().reciprocal);
}

TEST_P(FiniteElementsOf, AFillingMoveAlongWithTheirSupportWithoutReaction) {
  const SolidProblem problem = skewBlock();
  FiniteElementOptions options = allColumns(problem.model);
  options.element = GetParam().element;
  const auto greens = problem.greens(options);
  const Eigen::Vector3d shift(0.3, -0.5, 0.8);
  Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, greens->nodeCount());
  for (int v : problem.model.conditions().fixedNodes()) given.col(v) = shift;
  const Eigen::Matrix3Xd found = solveReferenceProblem(*greens, given);
  const double stiffest = problem.body.largestStiffness();
  for (int v = 0; v < greens->nodeCount(); ++v)
    if (greens->isFixed(v))  // sums of reactions of about stiffness / edge each
      EXPECT_LT(found.col(v).norm(), 1e-9 * stiffest);
    else
      EXPECT_LT((found.col(v) - shift).norm(), 1e-10);
}

TEST_P(FiniteElementsOf, AFillingReactWithTheWholeForceThatIsApplied) {
  const SolidProblem problem = skewBlock();
  FiniteElementOptions options;
  options.element = GetParam().element;
  options.patchColumns = true;
  const auto greens = problem.greens(options);
  const std::vector<int> free = problem.model.conditions().freeNodes();
  const Eigen::MatrixXd columns = columnsOf(*greens, free);
  const auto totalReaction = [&](const auto& column) {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    for (int v : problem.model.conditions().fixedNodes())
      force += greens->vertexArea(v) * column.template segment<3>(3 * v);
    return force;
  };
  for (std::size_t c = 0; c < free.size(); ++c)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d force = greens->vertexArea(free[c]) * Eigen::Vector3d::Unit(k);
      EXPECT_LT((totalReaction(columns.col(3 * c + k)) + force).norm(), 1e-10 * force.norm());
    }
  // A traction on one patch presses a third of the patch's triangles there.
  const auto& patches = greens->info().patchColumns;
  ASSERT_GT(patches.size(), 20u);
  for (std::size_t c = 0; c < patches.size(); ++c) {
    double area = 0;
    for (int f : problem.model.mesh().trianglesOfVertex(patches[c].node))
      if (problem.model.smoothPatches()[f] == patches[c].patch)
        area += problem.model.mesh().triangleAreas()[f] / 3;
    Eigen::VectorXd column = Eigen::VectorXd::Zero(3 * greens->nodeCount());
    greens->accumulatePatches(nodeList({static_cast<int>(c)}), Eigen::Vector3d(1, 0, 0), column);
    EXPECT_NEAR(totalReaction(column).x(), -area, 1e-10 * area);
  }
}

/// The linear field of a unit tension along z: u = gradient x.
Eigen::Matrix3d tensionGradient(const Filling& filling) {
  const double nu = filling.poissonRatio;
  Eigen::Matrix<double, 6, 1> strain;
  strain << -nu, -nu, 1, 0, 0, 0;
  if (!filling.elasticity.isSplit())
    strain = filling.elasticity.stiffness().inverse() * Eigen::Matrix<double, 6, 1>::Unit(2);
  Eigen::Matrix3d gradient;
  gradient << strain[0], strain[5] / 2, strain[4] / 2,  //
      strain[5] / 2, strain[1], strain[3] / 2,          //
      strain[4] / 2, strain[3] / 2, strain[2];
  return gradient;
}

/// Error of each vertex of a bar under tension whose base contracts as the rest of it, over the
/// largest displacement.
Eigen::VectorXd tensionErrors(const Filling& filling, int divisions, bool reciprocal,
                              ElasticModel& model) {
  const TetrahedralMesh mesh = kuhnBox({1, 1, 2}, {divisions, divisions, 2 * divisions}).mesh();
  model = withPatchesOnTop(makeModel(boundaryOf(mesh), base, 1, filling.poissonRatio));
  FiniteElementOptions options = allColumns(model);
  options.element = filling.element;
  options.patchColumns = true;
  options.reciprocal = reciprocal;
  const auto greens =
      SolidProblem{model, SolidBody(model.mesh(), mesh, {filling.elasticity})}.greens(options);
  const Eigen::Matrix3Xd exact = tensionGradient(filling) * model.mesh().points();
  Eigen::Matrix3Xd given = Eigen::Matrix3Xd::Zero(3, exact.cols());
  for (int v : model.conditions().fixedNodes()) given.col(v) = exact.col(v);
  Eigen::VectorXd errors =
      (pulled(model, *greens, Eigen::Vector3d::UnitZ(), given) - exact).colwise().norm();
  for (int v : model.conditions().fixedNodes()) errors[v] = 0;
  return errors / exact.colwise().norm().maxCoeff();
}

/// A vertex's displacement is half of a mean under its hat: that of a linear field is its own value
/// where the hat is symmetric, inside the sides, and beside it by part of an edge at the rims.
TEST_P(FiniteElementsOf, AFillingHoldTheLinearFieldOfUniformTensionExactly) {
  ElasticModel model = skewBlock().model;
  const Eigen::VectorXd coarse = tensionErrors(GetParam(), 2, true, model);
  const double atRims = coarse.maxCoeff();
  const Eigen::VectorXd fine = tensionErrors(GetParam(), 4, true, model);
  int inside = 0;
  for (int v : model.conditions().freeNodes())
    if (isInsideASide(model.mesh().points().col(v), {1, 1, 2})) {
      EXPECT_LT(fine[v], 1e-10) << v;  // rounding times condition
      ++inside;
    }
  EXPECT_EQ(inside, 4 * 3 * 7 + 3 * 3);
  EXPECT_NEAR(fine.maxCoeff() / atRims, 0.5, 0.01);  // in proportion to edges
}

TEST_P(FiniteElementsOf, AFillingHoldItExactlyAtRimsTooWhereTheyAreRaw) {
  ElasticModel model = skewBlock().model;
  EXPECT_LT(tensionErrors(GetParam(), 2, false, model).maxCoeff(), 1e-10);  // rounding
}

TEST_P(FiniteElementsOf, AFillingSolveFewColumnsAsTheyCondenseAll) {
  const SolidProblem problem = skewBlock();
  FiniteElementOptions options;
  options.element = GetParam().element;
  const std::vector<int> free = problem.model.conditions().freeNodes(),
                         fixed = problem.model.conditions().fixedNodes();
  options.columns = {fixed[1], free[2], free[20]};
  FiniteElementOptions all = allColumns(problem.model);
  all.element = options.element;
  const auto few = problem.greens(options), many = problem.greens(all);
  EXPECT_EQ(few->columnCount(), 3);
  for (int column : options.columns) {
    const Eigen::MatrixXd a = columnsOf(*few, {column}), b = columnsOf(*many, {column});
    EXPECT_LT((a - b).norm(), 1e-9 * b.norm()) << column;  // rounding times condition
  }
}

INSTANTIATE_TEST_SUITE_P(Fillings, FiniteElementsOf, testing::ValuesIn(kFillings),
                         [](const auto& info) { return info.param.name; });

/// A column spreads a force, F = a p, by R = (M^-1 + 1 / a) / 2: its hats' responses are the
/// columns times 1 / a and R^-1.
TEST(FiniteElementPatchColumns, OfAVertexAddUpToTheResponseToItsHat) {
  const SolidProblem problem = solidProblem(kuhnBox({1, 1, 1}, {2, 2, 2}).mesh(), base, 1, 0.3);
  const SurfaceMesh& mesh = problem.model.mesh();
  FiniteElementOptions options;
  options.patchColumns = true;
  const auto greens = problem.greens(options);
  const std::vector<int> free = problem.model.conditions().freeNodes();
  const int n = static_cast<int>(free.size());
  std::vector<int> number(mesh.vertexCount(), -1);
  for (int i = 0; i < n; ++i) number[free[i]] = i;
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd areas(n);
  for (int i = 0; i < n; ++i) areas[i] = mesh.vertexAreas()[free[i]];
  for (int f = 0; f < mesh.triangleCount(); ++f)
    for (int i : mesh.triangles().col(f))
      for (int j : mesh.triangles().col(f))
        if (number[i] >= 0 && number[j] >= 0)
          products(number[i], number[j]) += mesh.triangleAreas()[f] / (i == j ? 6 : 12);
  const Eigen::MatrixXd spread =
      (products.inverse() + Eigen::MatrixXd(areas.cwiseInverse().asDiagonal())) / 2;
  const Eigen::MatrixXd ofHats = areas.cwiseInverse().asDiagonal() * spread.inverse();
  const Eigen::MatrixXd columns = columnsOf(*greens, free);
  int edges = 0;
  for (int v : free) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(columns.rows()), expected = sum;
    int patches = 0;
    for (std::size_t c = 0; c < greens->info().patchColumns.size(); ++c)
      if (greens->info().patchColumns[c].node == v) {
        greens->accumulatePatches(nodeList({static_cast<int>(c)}), Eigen::Vector3d(0, 0, 1), sum);
        ++patches;
      }
    if (patches == 0) continue;
    ++edges;
    for (int i = 0; i < n; ++i) expected += ofHats(i, number[v]) * columns.col(3 * i + 2);
    for (int w : free)
      EXPECT_LT((sum - expected).segment<3>(3 * w).norm(), 1e-11 * expected.norm()) << v;
  }
  EXPECT_EQ(edges, 8 + 4);  // of the top, and between base and top
}

/// Two slabs on top of each other: without lateral contraction each strains on its own.
TEST(FiniteElementsOfTwoMaterials, StrainInARowAsOneOverTheirModuli) {
  for (double contrast : {1e-6, 1.0, 1e3, 1e6}) {
    const TetrahedralMesh mesh = kuhnBox({1, 1, 1}, {2, 2, 4}).mesh();
    const ElasticModel model = withPatchesOnTop(makeModel(boundaryOf(mesh), base, 1, 0));
    std::vector<int> number(mesh.cellCount());
    for (int t = 0; t < mesh.cellCount(); ++t) {
      double height = 0;
      for (int corner : mesh.tetrahedra().col(t)) height += mesh.points()(2, corner) / 4;
      number[t] = height > 0.5;
    }
    const SolidProblem problem{
        model, SolidBody(model.mesh(), mesh,
                         {Elasticity(Material(1, 0)), Elasticity(Material(contrast, 0))}, number)};
    FiniteElementOptions options;
    options.patchColumns = true;
    const auto greens = problem.greens(options);
    // Rounding times a condition of about 100 times the contrast.
    EXPECT_LT(greens->info().diagnostics.reciprocityDefect, 1e-9);
    EXPECT_LT(greens->info().diagnostics.rotationDefect, 1e-7);
    ASSERT_TRUE(columnsOf(*greens, model.conditions().freeNodes()).allFinite());
    const Eigen::Matrix3Xd found = pulled(model, *greens, Eigen::Vector3d::UnitZ(),
                                          Eigen::Matrix3Xd::Zero(3, model.mesh().vertexCount()));
    for (int v : model.conditions().freeNodes()) {
      const Eigen::Vector3d x = model.mesh().points().col(v);
      // Between the slabs the strain jumps under the hat.
      if (!isInsideASide(x, {1, 1, 1}) || std::abs(x.z() - 0.5) < 0.1) continue;
      const double exact = std::min(x.z(), 0.5) + std::max(0.0, x.z() - 0.5) / contrast;
      EXPECT_NEAR(found(2, v) / exact, 1, 1e-8) << contrast;
    }
  }
}

TEST(FiniteElementsOfTwoMaterials, StaySymmetricWhereBothAreNearlyIncompressible) {
  const TetrahedralMesh mesh = kuhnBox({1, 1, 1}, {2, 2, 4}).mesh();
  const ElasticModel model = makeModel(boundaryOf(mesh), base, 1, 0.499);
  std::vector<int> number(mesh.cellCount());
  for (int t = 0; t < mesh.cellCount(); ++t)
    number[t] = mesh.points().row(2)(mesh.tetrahedra().col(t)).mean() > 0.5;
  for (double contrast : {1e-6, 1e6}) {
    const SolidProblem problem{
        model,
        SolidBody(model.mesh(), mesh,
                  {Elasticity(Material(1, 0.499)), Elasticity(Material(contrast, 0.5))}, number)};
    const auto greens = problem.greens();
    EXPECT_LT(greens->info().diagnostics.reciprocityDefect, 1e-9);  // as above
    EXPECT_LT(greens->info().diagnostics.rotationDefect, 1e-7);
    EXPECT_TRUE(columnsOf(*greens, model.conditions().freeNodes()).allFinite());
  }
}

TEST(FiniteElementsOfTwoMaterials, HangingOnNextToNothingAreRefused) {
  const TetrahedralMesh mesh = kuhnBox({1, 1, 1}, {2, 2, 4}).mesh();
  const ElasticModel model = makeModel(boundaryOf(mesh), base, 1, 0);
  std::vector<int> number(mesh.cellCount());
  for (int t = 0; t < mesh.cellCount(); ++t)
    number[t] = mesh.points().row(2)(mesh.tetrahedra().col(t)).mean() > 0.5;
  const SolidProblem problem{
      model, SolidBody(model.mesh(), mesh,
                       {Elasticity(Material(1e-18, 0)), Elasticity(Material(1, 0))}, number)};
  EXPECT_THROW(problem.greens(allColumns(model)), std::runtime_error);
}

class FiniteElementScales : public testing::TestWithParam<double> {};

TEST_P(FiniteElementScales, OfLengthAndStiffnessScaleTheColumnsAlone) {
  const double nu = GetParam(), length = 1000, young = 3e4;
  const Solid block = kuhnBox({1, 1.3, 0.9}, {3, 3, 3});
  const SolidProblem one = solidProblem(block.mesh(), base, 1, nu);
  const SolidProblem other = solidProblem(
      block.mapped([&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return length * x; }).mesh(),
      base, young, nu);
  const auto a = one.greens(allColumns(one.model)), b = other.greens(allColumns(other.model));
  const std::vector<int> free = one.model.conditions().freeNodes(),
                         fixed = one.model.conditions().fixedNodes();
  const auto blocks = [](const GreensFunctions& greens, const std::vector<int>& rows,
                         const std::vector<int>& columns) {
    Eigen::MatrixXd result(3 * rows.size(), 3 * columns.size());
    greens.gather(nodeList(rows), nodeList(columns), result.data());
    return result;
  };
  const auto expectScaled = [&](const std::vector<int>& rows, const std::vector<int>& columns,
                                double factor) {
    const Eigen::MatrixXd before = blocks(*a, rows, columns), after = blocks(*b, rows, columns);
    EXPECT_LT((after / factor - before).norm(), 1e-9 * before.norm());  // rounding, condition 1e5
  };
  expectScaled(free, free, length / young);
  expectScaled(fixed, free, 1);
  expectScaled(free, fixed, 1);
  expectScaled(fixed, fixed, young / length);
}

INSTANTIATE_TEST_SUITE_P(Materials, FiniteElementScales, testing::Values(0.0, 0.3, 0.499, 0.5));

/// Displacement of the middle of the top of [0, size] under a unit traction on all of it.
Eigen::Vector3d topDisplacement(const Eigen::Vector3d& size, const Eigen::Vector3i& divisions,
                                const Eigen::Vector3d& direction,
                                SolidElement element = SolidElement::Quadratic) {
  const SolidProblem sides = solidProblem(kuhnBox(size, divisions).mesh(), base, 1, 0.3);
  const SolidProblem problem{withPatchesOnTop(sides.model), sides.body};
  const SurfaceMesh& mesh = problem.model.mesh();
  FiniteElementOptions options;
  options.element = element;
  options.patchColumns = true;
  options.columns = {vertexAt(mesh, size)};
  const Eigen::Matrix3Xd found = pulled(problem.model, *problem.greens(options), direction,
                                        Eigen::Matrix3Xd::Zero(3, mesh.vertexCount()));
  return found.col(vertexAt(mesh, {size.x() / 2, size.y() / 2, size.z()}));
}

TEST(FiniteElementCantilever, BendsAndStretchesAsTheReferenceOfItsProportions) {
  // hp finite elements: 2055.45 in shear, 7.97048 along the axis.
  const auto errors = [](int across) {
    const Eigen::Vector3i divisions(across, across, 4 * across);
    return Eigen::Vector2d(
        topDisplacement({1, 1, 8}, divisions, Eigen::Vector3d::UnitX()).x() / 2055.45 - 1,
        topDisplacement({1, 1, 8}, divisions, Eigen::Vector3d::UnitZ()).z() / 7.97048 - 1);
  };
  const Eigen::Vector2d coarse = errors(2), fine = errors(4);
  EXPECT_LT(std::abs(coarse[1]), 0.02);
  EXPECT_LT(std::abs(fine[0]), std::abs(coarse[0]));
  EXPECT_LT(std::abs(fine[1]), std::abs(coarse[1]));
  EXPECT_LT(std::abs(fine[0]), 0.005);
  EXPECT_LT(std::abs(fine[1]), 0.005);
}

TEST(FiniteElementCube, YieldsUnderItsTopsTractionAsTheReference) {
  // hp finite elements: .964754 normal, 6.71156 shear.
  const auto errors = [](int divisions) {
    const Eigen::Vector3i all = Eigen::Vector3i::Constant(divisions);
    return Eigen::Vector2d(
        topDisplacement({1, 1, 1}, all, Eigen::Vector3d::UnitZ()).z() / 0.964754 - 1,
        topDisplacement({1, 1, 1}, all, Eigen::Vector3d::UnitX()).x() / 6.71156 - 1);
  };
  const Eigen::Vector2d coarse = errors(4), fine = errors(8);
  EXPECT_LT(fine.cwiseAbs().maxCoeff(), coarse.cwiseAbs().maxCoeff());
  EXPECT_LT(fine.cwiseAbs().maxCoeff(), 0.01);
}

TEST(FiniteElements, LinearOnesAreStifferThanQuadraticOnes) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const double linear = topDisplacement({1, 1, 4}, {2, 2, 8}, x, SolidElement::Linear).x();
  const double finer = topDisplacement({1, 1, 4}, {4, 4, 16}, x, SolidElement::Linear).x();
  const double quadratic = topDisplacement({1, 1, 4}, {2, 2, 8}, x).x();
  EXPECT_LT(linear, 0.8 * quadratic);
  EXPECT_LT(linear, finer);
  EXPECT_LT(finer, quadratic);
}

TEST(FiniteElements, AgreeWithBoundaryElementsAsBothAreRefined) {
  const auto difference = [](int divisions) {
    const SolidProblem problem =
        solidProblem(kuhnBox({1, 1, 1}, Eigen::Vector3i::Constant(divisions)).mesh(), base, 1, 0.3);
    const PressureMasks masks(problem.model.mesh(), problem.model.conditions(), MaskShape::Linear,
                              0.4);
    const VertexMask mask = masks.at(vertexAt(problem.model.mesh(), {0.5, 0.5, 1}));
    FiniteElementOptions options;
    options.columns = mask.nodes;
    BoundaryElementOptions boundaryOptions;
    boundaryOptions.columns = mask.nodes;
    const Eigen::Matrix3d fem = meanCompliance(*problem.greens(options), mask);
    const Eigen::Matrix3d bem =
        meanCompliance(*computeGreens(problem.model, boundaryOptions), mask);
    return (fem - bem).norm() / bem.norm();
  };
  const double coarse = difference(4), fine = difference(8);
  EXPECT_LT(fine, coarse / 2);
  EXPECT_LT(fine, 0.005);
}

TEST(FiniteElements, RefuseWhatTheyCannotDo) {
  const TetrahedralMesh mesh = kuhnBox({1, 1, 1}, {2, 2, 2}).mesh();
  const auto refused = [](const SolidProblem& problem, const FiniteElementOptions& options,
                          const char* sentence) {
    return isRefused([&] { problem.greens(options); }, sentence);
  };
  FiniteElementOptions options;
  options.element = SolidElement::Linear;
  for (double nu : {0.45, 0.5})
    EXPECT_TRUE(refused(solidProblem(mesh, base, 1, nu), options,
                        "linear tetrahedra lock in nearly incompressible materials (Poisson's "
                        "ratio from 0.45 on): use quadratic ones"));
  EXPECT_NO_THROW(solidProblem(mesh, base, 1, 0.449).greens(options));
  options = {};
  const SolidProblem inside = solidProblem(mesh, base, 1, 0.3);
  const int nodes = inside.model.mesh().vertexCount();
  for (int column : {-1, nodes}) {
    options.columns = {column};
    EXPECT_THROW(inside.greens(options), std::invalid_argument) << column;
  }
  const ElasticModel outside = makeModel(boundaryOf(mesh), base, 1, 0.3, 30, Domain::Exterior);
  EXPECT_TRUE(refused({outside, inside.body}, {},
                      "finite elements fill the inside of a surface, no other domain"));
}

TEST(FiniteElements, ReportProgressAndCanBeAborted) {
  const SolidProblem problem = solidProblem(kuhnBox({1, 1, 1}, {3, 3, 3}).mesh(), base, 1, 0.3);
  for (bool few : {false, true}) {
    FiniteElementOptions options;
    if (few) options.columns = {problem.model.conditions().freeNodes()[0]};
    std::vector<double> fractions;
    const auto record = [&](double fraction, const char*) {
      fractions.push_back(fraction);
      return true;
    };
    computeFiniteElementGreensFunctions(problem.model, problem.body, options, record);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_EQ(fractions.back(), 1);
    for (std::size_t stopAt = 1; stopAt < fractions.size(); ++stopAt) {
      std::size_t calls = 0;
      const auto stop = [&](double, const char*) { return ++calls < stopAt; };
      EXPECT_TRUE(isRefused<Aborted>(
          [&] { computeFiniteElementGreensFunctions(problem.model, problem.body, options, stop); },
          "aborted on request"));
      EXPECT_EQ(calls, stopAt);
    }
  }
}

TEST(FiniteElements, SayHowTheyWereMade) {
  const SolidProblem problem = solidProblem(kuhnBox({1, 1, 1}, {2, 2, 2}).mesh(), base, 1, 0.3);
  const auto greens = problem.greens();
  EXPECT_EQ(greens->info().source, "finite elements (quadratic tetrahedra, 48 of them)");
  EXPECT_EQ(greens->info().fingerprint, problem.model.fingerprint());
  EXPECT_EQ(greens->columnCount(), static_cast<int>(problem.model.conditions().freeNodes().size()));
  EXPECT_GT(greens->info().diagnostics.peakBytes, 0u);
  EXPECT_GT(greens->info().diagnostics.rockingCompliance, 0);
}

}  // namespace
}  // namespace palpate::test
