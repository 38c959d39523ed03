// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/dense_greens_functions.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/allocation_count.h"
#include "support/refusals.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

/// Green's functions of `nodes` nodes, every third one fixed, of which `columns` have columns in
/// random order; with three patch columns.
template <class Scalar>
struct Example {
  Example(int nodes, int columns, unsigned seed = 1) : random(seed) {
    for (int node = 0; node < nodes; node += 3) body.fixed.push_back(node);
    body.nodes = nodes;
    body.seed = seed;
    body.columns = randomSubset(nodes, columns, random);
    body.patchColumns = {{1 % nodes, 0}, {1 % nodes, 1}, {2 % nodes, 4}};
    body.youngsModulus = 3;
    GreensFunctionsInfo info = body.info();
    info.columnNodes = body.columns;  // none at all where `columns` is 0
    patches = randomVectors(nodes * 9, random).reshaped(3 * nodes, 9);
    greens = denseGreens<Scalar>(info, body.matrix(), patches);
    // What is stored, and nothing more.
    matrix = body.matrix().cast<Scalar>().template cast<double>();
    patches = patches.cast<Scalar>().template cast<double>().eval();
  }

  double fixedFactor(int node, double factor) const { return greens->isFixed(node) ? factor : 1; }

  /// Xi of a body s times as stiff, by the definition: p scales with s, u with nothing.
  Eigen::MatrixXd scaled(double s) const {
    Eigen::MatrixXd out = matrix;
    for (int node = 0; node < greens->nodeCount(); ++node) {
      out.middleRows<3>(3 * node) *= fixedFactor(node, s);
      out.middleCols<3>(3 * node) *= greens->isFixed(node) ? 1 : 1 / s;
    }
    return out;
  }
  Eigen::MatrixXd scaledPatches(double s) const {
    Eigen::MatrixXd out = patches / s;
    for (int node = 0; node < greens->nodeCount(); ++node)
      out.middleRows<3>(3 * node) *= fixedFactor(node, s);
    return out;
  }

  std::mt19937 random;
  SyntheticBody body;
  Eigen::MatrixXd matrix, patches;
  std::shared_ptr<const DenseGreensFunctions<Scalar>> greens;
};

/// out += blocks of `matrix` times weights, by plain loops.
Eigen::VectorXd plainSum(const Eigen::MatrixXd& matrix, const std::vector<int>& columns,
                         const Eigen::VectorXd& weights, Eigen::VectorXd out) {
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (int j = 0; j < 3; ++j)
      for (Eigen::Index i = 0; i < out.size(); ++i)
        out[i] += matrix(i, 3 * columns[c] + j) * weights[3 * c + j];
  return out;
}

Eigen::VectorXd rowsOf(const Eigen::VectorXd& all, const std::vector<int>& rows) {
  Eigen::VectorXd out(3 * rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) out.segment<3>(3 * r) = all.segment<3>(3 * rows[r]);
  return out;
}

// Sums of up to 60 terms of order one, in another order and with fused products: a few roundings
// of double, whatever the storage.
constexpr double kSumTolerance = 60 * std::numeric_limits<double>::epsilon();

template <class Scalar>
class DenseGreensFunctionsOf : public testing::Test {};
using Scalars = testing::Types<double, float>;
TYPED_TEST_SUITE(DenseGreensFunctionsOf, Scalars);

TYPED_TEST(DenseGreensFunctionsOf, GatheredBlocksAreThoseOfTheMatrix) {
  Example<TypeParam> example(11, 7);
  const std::vector<int> rows = {10, 0, 3, 3, 7},
                         columns = {example.body.columns[4], example.body.columns[0],
                                    example.body.columns[6]};
  Eigen::MatrixXd blocks(3 * rows.size(), 3 * columns.size());
  example.greens->gather(nodeList(rows), nodeList(columns), blocks.data());
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          EXPECT_EQ(blocks(3 * r + i, 3 * c + j),
                    example.matrix(3 * rows[r] + i, 3 * columns[c] + j));
}

TYPED_TEST(DenseGreensFunctionsOf, SumsAreThoseOfPlainLoopsForAnyNumberOfRowsAndColumns) {
  for (int nodes : {1, 2, 3, 5, 8, 9, 13, 22})
    for (int count = 0; count <= std::min(nodes, 7); ++count) {
      Example<TypeParam> example(nodes, count, nodes + 31 * count);
      const std::vector<int>& columns = example.body.columns;
      const Eigen::VectorXd weights = randomVectors(count, example.random).reshaped();
      const Eigen::VectorXd before = randomVectors(nodes, example.random).reshaped();
      const Eigen::VectorXd expected = plainSum(example.matrix, columns, weights, before);

      Eigen::VectorXd all = before;
      example.greens->accumulate(nodeList(columns), weights, all);
      EXPECT_LE((all - expected).cwiseAbs().maxCoeff(), kSumTolerance) << nodes << ' ' << count;

      const std::vector<int> rows = {nodes - 1, 0, nodes / 2, 0};
      Eigen::VectorXd some = rowsOf(before, rows);
      example.greens->accumulate(nodeList(columns), weights, nodeList(rows), some);
      EXPECT_LE((some - rowsOf(expected, rows)).cwiseAbs().maxCoeff(), kSumTolerance);
    }
}

TYPED_TEST(DenseGreensFunctionsOf, PatchSumsAreThoseOfPlainLoops) {
  Example<TypeParam> example(9, 5);
  const std::vector<int> patches = {2, 0, 1};
  const Eigen::VectorXd weights = randomVectors(3, example.random).reshaped();
  const Eigen::VectorXd before = randomVectors(9, example.random).reshaped();
  Eigen::VectorXd all = before;
  example.greens->accumulatePatches(nodeList(patches), weights, all);
  EXPECT_LE((all - plainSum(example.patches, patches, weights, before)).cwiseAbs().maxCoeff(),
            kSumTolerance);
}

TYPED_TEST(DenseGreensFunctionsOf, NoColumnsAddNothing) {
  const Example<TypeParam> example(5, 0);
  const Eigen::VectorXd before = Eigen::VectorXd::LinSpaced(15, -1, 2);
  Eigen::VectorXd out = before;
  const Eigen::VectorXi none;
  const Eigen::VectorXd weights;
  example.greens->accumulate(none, weights, out);
  example.greens->accumulatePatches(none, weights, out);
  EXPECT_EQ(out, before);
  example.greens->gather(none, none, out.data());
  EXPECT_EQ(out, before);
}

TYPED_TEST(DenseGreensFunctionsOf, YoungsModulusScalesEachKindOfBlockByItsDefinition) {
  for (double s : {0.125, 7.0}) {
    Example<TypeParam> example(10, 10);
    const auto stiffer = example.greens->withYoungsModulus(3 * s);
    EXPECT_DOUBLE_EQ(stiffer->info().material.youngsModulus(), 3 * s);
    EXPECT_EQ(stiffer->info().material.poissonRatio(), 0.3);
    const Eigen::MatrixXd expected = example.scaled(s);
    // One division and one product in place of the reference's product.
    EXPECT_LE((denseMatrix(*stiffer) - expected).cwiseAbs().maxCoeff(),
              4 * std::numeric_limits<double>::epsilon() * expected.cwiseAbs().maxCoeff());

    const std::vector<int> columns = {9, 0, 4, 6, 3}, patches = {1, 2}, rows = {6, 1, 0};
    const Eigen::VectorXd weights = randomVectors(5, example.random).reshaped();
    const Eigen::VectorXd patchWeights = randomVectors(2, example.random).reshaped();
    const Eigen::VectorXd before = randomVectors(10, example.random).reshaped();
    const double tolerance = kSumTolerance * std::max(s, 1 / s) * 3;
    Eigen::VectorXd out = before;
    stiffer->accumulate(nodeList(columns), weights, out);
    const Eigen::VectorXd sum = plainSum(expected, columns, weights, before);
    EXPECT_LE((out - sum).cwiseAbs().maxCoeff(), tolerance);
    out = rowsOf(before, rows);
    stiffer->accumulate(nodeList(columns), weights, nodeList(rows), out);
    EXPECT_LE((out - rowsOf(sum, rows)).cwiseAbs().maxCoeff(), tolerance);
    out = before;
    stiffer->accumulatePatches(nodeList(patches), patchWeights, out);
    EXPECT_LE((out - plainSum(example.scaledPatches(s), patches, patchWeights, before))
                  .cwiseAbs()
                  .maxCoeff(),
              tolerance);
  }
}

TYPED_TEST(DenseGreensFunctionsOf, ThereAndBackAgainInYoungsModulusIsTheSameBody) {
  const Example<TypeParam> example(7, 7);
  const auto back = example.greens->withYoungsModulus(6e9)->withYoungsModulus(3);
  // Powers of ten are not exact in binary: one rounding each way.
  EXPECT_LE(relativeDifference(denseMatrix(*back), example.matrix), 1e-15);
}

TEST(DenseGreensFunctions, RockingComplianceFallsWithYoungsModulusAndOtherDiagnosticsDoNot) {
  GreensFunctionsInfo info = SyntheticBody{}.info();
  info.diagnostics.rockingCompliance = 12;
  info.diagnostics.reciprocityDefect = 0.01;
  const auto greens = denseGreens(info, SyntheticBody{}.matrix());
  const auto stiffer = greens->withYoungsModulus(4);
  EXPECT_DOUBLE_EQ(stiffer->info().diagnostics.rockingCompliance, 3);
  EXPECT_EQ(stiffer->info().diagnostics.reciprocityDefect, 0.01);
  info.diagnostics.rockingCompliance = -1;  // was not computed
  EXPECT_EQ(denseGreens(info, SyntheticBody{}.matrix())
                ->withYoungsModulus(4)
                ->info()
                .diagnostics.rockingCompliance,
            -1);
}

TEST(DenseGreensFunctions, ViewsAndTheirScaledCopiesKeepTheMemoryAlive) {
  const SyntheticBody body;
  auto memory = std::make_shared<Eigen::MatrixXd>(body.matrix());
  const std::weak_ptr<Eigen::MatrixXd> watch = memory;
  auto view = std::make_shared<const DenseGreensFunctions<double>>(body.info(), memory->data(),
                                                                   nullptr, memory);
  memory.reset();
  const auto stiffer = view->withYoungsModulus(2);
  view.reset();
  ASSERT_FALSE(watch.expired());
  EXPECT_EQ(denseMatrix(*stiffer)(4, 5), body.matrix()(4, 5) / 2);
}

TYPED_TEST(DenseGreensFunctionsOf, QueriesDoNotAllocate) {
  ASSERT_TRUE(allocationsAreCounted());
  const Example<TypeParam> example(9, 6);
  const Eigen::VectorXi columns = nodeList(example.body.columns).head(4), rows = columns.head(2);
  const Eigen::VectorXd weights = Eigen::VectorXd::Ones(12);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(27), some = Eigen::VectorXd::Zero(6);
  Eigen::MatrixXd blocks(6, 12);
  const long before = allocationCount();
  example.greens->gather(rows, columns, blocks.data());
  example.greens->accumulate(columns, weights, all);
  example.greens->accumulate(columns, weights, rows, some);
  example.greens->accumulatePatches(Eigen::Vector3i(0, 1, 2), weights.head(9), all);
  EXPECT_EQ(allocationCount(), before);
  // The counter itself counts.
  Eigen::VectorXd more(1000);
  EXPECT_GT(allocationCount(), before);
}

TEST(DenseGreensFunctions, WrongInputIsRefusedByName) {
  const SyntheticBody body;
  const auto changed = [&](auto change) {
    GreensFunctionsInfo info = body.info();
    change(info);
    denseGreens(info, body.matrix());
  };
  EXPECT_TRUE(
      isRefused([&] { changed([](auto& info) { info.vertexAreas.conservativeResize(5); }); },
                "there are 5 vertex areas for 12 nodes"));
  EXPECT_TRUE(isRefused([&] { changed([](auto& info) { info.columnNodes[3] = 2; }); },
                        "node 2 of stored column 3 is repeated or out of range"));
  EXPECT_TRUE(isRefused(
      [&] {
        GreensFunctionsInfo info = body.info();
        info.columnNodes[7] = 12;
        DenseGreensFunctions<double>(info, body.matrix().data(), nullptr, nullptr);
      },
      "node 12 of stored column 7 is repeated or out of range"));
  EXPECT_TRUE(
      isRefused([&] { DenseGreensFunctions<double>(body.info(), AlignedBuffer<double>(36 * 35)); },
                "there are 1260 values for 12 columns of 12 nodes"));
  EXPECT_TRUE(isRefused([&] { changed([](auto& info) {
                                info.patchColumns = {{0, 0}};
                              }); },
                        "there are 0 values for 1 patch columns of 12 nodes"));
  EXPECT_TRUE(isRefused([&] { syntheticGreens(body)->withYoungsModulus(-2); },
                        "Young's modulus must be a positive number, not -2"));
}

}  // namespace
}  // namespace palpate::test
