// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "linear_algebra/sparse_factorization.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <random>

#include "support/refusals.h"

namespace palpate::test {
namespace {

/// Entries of a sum of small random positive semidefinite blocks, as of elements: most places come
/// up several times.
SymmetricEntries randomDefinite(int size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  SymmetricEntries entries;
  entries.size = size;
  for (int i = 0; i < size; ++i) entries.add(i, i, 0.5);
  for (int block = 0; block < 2 * size; ++block) {
    int row[4];
    double value[4];
    for (int k = 0; k < 4; ++k) {
      row[k] = static_cast<int>(random() % size);
      value[k] = uniform(random);
    }
    for (int k = 0; k < 4; ++k)
      for (int l = 0; l <= k; ++l)
        entries.add(row[k], row[l], (row[k] == row[l] && k != l ? 2 : 1) * value[k] * value[l]);
  }
  return entries;
}

/// [ A  B^T  . ; B  -c  . ; . . A' ]: displacements, pressures, and rows to be kept.
/// @param compressibility  c, may be 0.
SymmetricEntries randomSaddle(int unknowns, int pressures, int kept, double compressibility,
                              unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  SymmetricEntries entries;
  entries.size = unknowns + pressures + kept;
  const SymmetricEntries definite = randomDefinite(unknowns + kept, seed);
  const auto place = [&](int i) { return i < unknowns ? i : i + pressures; };
  for (std::size_t i = 0; i < definite.value.size(); ++i)
    entries.add(place(definite.row[i]), place(definite.column[i]), definite.value[i]);
  for (int p = 0; p < pressures; ++p) {
    entries.add(unknowns + p, unknowns + p, -compressibility);
    entries.add(unknowns + p, p, 1 + uniform(random) / 2);  // each acts on a place of its own
    for (int k = 0; k < 3; ++k)
      entries.add(unknowns + p, static_cast<int>(random() % unknowns), uniform(random));
    if (kept > 0) entries.add(place(unknowns + p % kept), unknowns + p, uniform(random));
  }
  return entries;
}

Eigen::MatrixXd dense(const SymmetricEntries& entries) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(entries.size, entries.size);
  for (std::size_t i = 0; i < entries.value.size(); ++i)
    matrix(entries.row[i], entries.column[i]) += entries.value[i];
  return matrix.selfadjointView<Eigen::Lower>();
}

struct Case {
  int unknowns, pressures, kept;
  double compressibility;
  bool isDefinite() const { return pressures == 0; }
  SymmetricEntries entries(unsigned seed) const {
    return isDefinite() ? randomDefinite(unknowns + kept, seed)
                        : randomSaddle(unknowns, pressures, kept, compressibility, seed);
  }
};

class SparseFactorizationOf : public testing::TestWithParam<Case> {};

// Conditions are about 1e3, and residuals of rounding: 1e-12 has a few digits to spare.
constexpr double kRounding = 1e-12;

TEST_P(SparseFactorizationOf, RandomMatricesGivesTheDenseSchurComplementOrSolution) {
  const Case& c = GetParam();
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const SymmetricEntries entries = c.entries(seed);
    const Eigen::MatrixXd matrix = dense(entries);
    const int rest = c.unknowns + c.pressures;
    const SparseFactorization factored(entries, c.kept, c.isDefinite());
    const Eigen::PartialPivLU<Eigen::MatrixXd> a(matrix.topLeftCorner(rest, rest));
    if (c.kept > 0) {
      const Eigen::MatrixXd expected =
          matrix.bottomRightCorner(c.kept, c.kept) -
          matrix.bottomLeftCorner(c.kept, rest) * a.solve(matrix.topRightCorner(rest, c.kept));
      EXPECT_LT((factored.schurComplement() - expected).norm(), kRounding * expected.norm());
      EXPECT_EQ(factored.schurComplement(), factored.schurComplement().transpose());
    } else {
      // Columns of a larger matrix, whose other rows stay as they are.
      Eigen::MatrixXd held = Eigen::MatrixXd::Random(rest + 3, 5);
      const Eigen::MatrixXd given = held;
      factored.solve(held.topRows(rest));
      const Eigen::MatrixXd expected = a.solve(given.topRows(rest));
      EXPECT_LT((held.topRows(rest) - expected).norm(), kRounding * expected.norm());
      EXPECT_EQ(held.bottomRows(3), given.bottomRows(3));
      Eigen::MatrixXd again = given.topRows(rest);
      factored.solve(again);
      EXPECT_EQ(again, held.topRows(rest));
      const std::vector<int> ones{rest - 1, -1, 0, rest / 2, rest / 2};
      Eigen::MatrixXd units = Eigen::MatrixXd::Random(rest, 5), wanted(rest, 5);
      for (int k = 0; k < 5; ++k)
        wanted.col(k) = ones[k] < 0 ? Eigen::VectorXd::Zero(rest).eval()
                                    : a.solve(Eigen::VectorXd::Unit(rest, ones[k])).eval();
      factored.solveUnits(ones, units);
      EXPECT_LT((units - wanted).norm(), kRounding * wanted.norm());
      factored.solveUnits({-1, -1}, units.leftCols(2));
      EXPECT_TRUE(units.leftCols(2).isZero(0));
      again = given.topRows(rest);
      factored.solve(again);
      EXPECT_EQ(again, held.topRows(rest));
    }
    EXPECT_EQ(factored.negativePivots(), c.pressures);
    EXPECT_GT(factored.peakBytes(), entries.value.size() * sizeof(double));
  }
}

INSTANTIATE_TEST_SUITE_P(Systems, SparseFactorizationOf,
                         testing::Values(Case{1, 0, 0, 0}, Case{1, 0, 1, 0}, Case{40, 0, 0, 0},
                                         Case{40, 0, 7, 0}, Case{400, 0, 0, 0}, Case{400, 0, 90, 0},
                                         Case{40, 10, 0, 0.1}, Case{40, 10, 6, 0.1},
                                         Case{40, 10, 6, 0}, Case{300, 80, 0, 1e-6},
                                         Case{300, 80, 60, 0}, Case{10, 2, 60, 0}));

TEST(SparseFactorization, AddsUpEntriesOfOnePlaceWhicheverWayRound) {
  SymmetricEntries entries;
  entries.size = 2;
  for (double part : {1.0, 2.5, 0.5}) entries.add(0, 0, part);
  entries.add(1, 0, 0.5);
  entries.add(0, 1, 0.5);
  entries.add(1, 1, 2);
  const SparseFactorization factored(entries, 1, true);
  EXPECT_NEAR(factored.schurComplement()(0, 0), 2 - 1.0 / 4, 1e-15);  // [ 4 1 ; 1 2 ]
}

TEST(SparseFactorization, CountsTheNegativeEigenvalues) {
  const SymmetricEntries entries = [] {
    SymmetricEntries result = randomDefinite(60, 3);
    for (int i = 0; i < 25; ++i) result.add(2 * i, 2 * i, -8);
    return result;
  }();
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense(entries)).eigenvalues();
  const int negative = static_cast<int>((eigenvalues.array() < 0).count());
  ASSERT_GT(negative, 5);
  EXPECT_EQ(SparseFactorization(entries, 0, false).negativePivots(), negative);
}

/// Springs in a row, none held: the pivots are 1, 1, ..., 0 without rounding.
SymmetricEntries looseChain(int size) {
  SymmetricEntries entries;
  entries.size = size;
  for (int i = 0; i + 1 < size; ++i) {
    entries.add(i, i, 1);
    entries.add(i + 1, i + 1, 1);
    entries.add(i + 1, i, -1);
  }
  return entries;
}

const char* const kSingular = "the sparse system is singular: a part of the body is not held";

TEST(SparseFactorization, RefusesASingularMatrix) {
  for (bool definite : {false, true}) {
    EXPECT_TRUE(isRefused<std::runtime_error>(
        [&] { SparseFactorization(looseChain(20), 0, definite); }, kSingular));
    SymmetricEntries empty = randomDefinite(10, 1);
    empty.size = 11;  // a row without entries
    EXPECT_TRUE(
        isRefused<std::runtime_error>([&] { SparseFactorization(empty, 0, definite); }, kSingular));
  }
}

TEST(SparseFactorization, RefusesASingularMatrixBesideKeptRows) {
  SymmetricEntries chain = looseChain(20);
  chain.size = 22;
  chain.add(20, 20, 1);
  chain.add(21, 21, 1);
  EXPECT_TRUE(
      isRefused<std::runtime_error>([&] { SparseFactorization(chain, 2, false); }, kSingular));
  chain.add(20, 5, 0.5);
  EXPECT_TRUE(
      isRefused<std::runtime_error>([&] { SparseFactorization(chain, 2, false); }, kSingular));
  // A row that has no entry but with one that is kept.
  SymmetricEntries apart = randomDefinite(10, 1);
  apart.size = 12;
  apart.add(10, 10, 0);
  apart.add(11, 10, 1);
  EXPECT_TRUE(
      isRefused<std::runtime_error>([&] { SparseFactorization(apart, 1, false); }, kSingular));
}

TEST(SparseFactorization, RefusesAnIndefiniteMatrixThatShouldBeDefinite) {
  for (int kept : {0, 5}) {
    SymmetricEntries entries = randomDefinite(40, 1);
    entries.add(3, 3, -20);
    EXPECT_TRUE(isRefused<std::runtime_error>([&] { SparseFactorization(entries, kept, true); },
                                              "the stiffness matrix of the body is not positive "
                                              "definite"));
    EXPECT_EQ(SparseFactorization(entries, kept, false).negativePivots(), 1);
  }
}

TEST(SparseFactorization, IsThere) {
  EXPECT_TRUE(SparseFactorization::isAvailable());
}

}  // namespace
}  // namespace palpate::test
