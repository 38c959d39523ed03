// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "linear_algebra/multi_precision_solve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <Eigen/LU>
#include <Eigen/QR>
#include <limits>

#include "support/refusals.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

/// A dense matrix whose singular values fall evenly on a logarithmic scale from 1 to 1 / condition.
Eigen::MatrixXd matrixOfCondition(int size, double condition, unsigned seed = 1) {
  std::mt19937 random(seed);
  const auto orthogonal = [&]() -> Eigen::MatrixXd {
    const Eigen::MatrixXd any = randomVectors(size * ((size + 2) / 3), random)
                                    .reshaped()
                                    .head(size * size)
                                    .reshaped(size, size);
    return Eigen::HouseholderQR<Eigen::MatrixXd>(any).householderQ();
  };
  const Eigen::VectorXd values =
      Eigen::VectorXd::LinSpaced(size, 0, -std::log10(condition)).unaryExpr([](double x) {
        return std::pow(10.0, x);
      });
  return orthogonal() * values.asDiagonal() * orthogonal();
}

template <class Scalar>
AlignedBuffer<Scalar> stored(const Eigen::MatrixXd& matrix, int stride) {
  AlignedBuffer<Scalar> buffer(std::size_t(stride) * matrix.cols());
  std::fill_n(buffer.data(), buffer.size(), Scalar(0));
  for (Eigen::Index c = 0; c < matrix.cols(); ++c)
    for (Eigen::Index r = 0; r < matrix.rows(); ++r)
      buffer.data()[c * stride + r] = static_cast<Scalar>(matrix(r, c));
  return buffer;
}

template <class Scalar>
Eigen::MatrixXd loaded(const AlignedBuffer<Scalar>& buffer, int rows, int columns, int stride) {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  return Eigen::Map<const Matrix, 0, Eigen::OuterStride<>>(buffer.data(), rows, columns,
                                                           Eigen::OuterStride<>(stride))
      .template cast<double>();
}

struct System {
  System(int systemSize, int columnCount, double condition, int gap = 3)
      : size(systemSize),
        columns(columnCount),
        stride(size + gap),
        a(matrixOfCondition(size, condition)),
        x(Eigen::MatrixXd::Random(size, columns)),
        b(a * x) {}
  int size, columns, stride;
  Eigen::MatrixXd a, x, b;
};

template <class Scalar>
class SolveInPlaceOf : public testing::Test {};
using Scalars = testing::Types<double, float>;
TYPED_TEST_SUITE(SolveInPlaceOf, Scalars);

TYPED_TEST(SolveInPlaceOf, SolvesAnyNumberOfRightHandSides) {
  for (int columns : {0, 1, 5, 384, 385, 800}) {
    const System system(90, columns, 10);
    AlignedBuffer<TypeParam> a = stored<TypeParam>(system.a, system.stride);
    AlignedBuffer<TypeParam> right = stored<TypeParam>(system.b, system.stride);
    const SolveReport report =
        solveInPlace(a, system.size, system.stride, right, columns, Progress());
    // Condition 10 times a few roundings of a row.
    const double tolerance = 300 * std::numeric_limits<TypeParam>::epsilon();
    EXPECT_LE((loaded(right, 90, columns, system.stride) - system.x).norm(),
              tolerance * system.x.norm());
    EXPECT_GT(report.conditionEstimate, 10);  // the 1-norm's is larger than the 2-norm's
    EXPECT_LT(report.conditionEstimate, 10 * 90);
    EXPECT_LE(report.residual, tolerance);
    EXPECT_EQ(report.residual > 0, columns > 0);
    EXPECT_EQ(report.peakBytes, sizeof(TypeParam) * system.stride * (90 + columns));
  }
}

TEST(MixedPrecision, SolutionsAreThoseOfDoubleWhereverRefinementConverges) {
  for (double condition : {3.0, 1e2, 1e3, 1e4, 3e4, 1e5, 3e5, 1e6}) {
    System system(200, 40, condition);
    system.b = Eigen::MatrixXd::Random(200, 40);
    const AlignedBuffer<double> a = stored<double>(system.a, system.stride);
    AlignedBuffer<double> right = stored<double>(system.b, system.stride);
    const SolveReport report =
        solveMixedInPlace(a, system.size, system.stride, right, system.columns, Progress());
    const Eigen::MatrixXd reference = system.a.partialPivLu().solve(system.b);
    // What refinement leaves, and the reference's own rounding.
    EXPECT_LE(relativeDifference(loaded(right, 200, 40, system.stride), reference),
              2e-11 + 1e-16 * condition)
        << condition;
    EXPECT_LE(report.residual, 1e-12);
    EXPECT_GE(report.refinementSteps, 1);
    EXPECT_EQ(loaded(a, 200, 200, system.stride), system.a) << "the matrix is kept";
  }
}

TEST(MixedPrecision, RightHandSidesInSeveralBlocksAreAllRefined) {
  for (int columns : {0, 1, 384, 385, 800}) {
    const System system(60, columns, 1e3);
    const AlignedBuffer<double> a = stored<double>(system.a, system.stride);
    AlignedBuffer<double> right = stored<double>(system.b, system.stride);
    solveMixedInPlace(a, system.size, system.stride, right, columns, Progress());
    const Eigen::MatrixXd solved = loaded(right, 60, columns, system.stride);
    for (int c = 0; c < columns; ++c)
      EXPECT_LE((solved.col(c) - system.x.col(c)).norm(), 1e-10 * system.x.col(c).norm()) << c;
  }
}

TEST(MixedPrecision, ZeroRightHandSidesHaveZeroSolutions) {
  System system(30, 400, 10);
  system.b.leftCols(390).setZero();  // the whole first block and some of the second
  const AlignedBuffer<double> a = stored<double>(system.a, system.stride);
  AlignedBuffer<double> right = stored<double>(system.b, system.stride);
  solveMixedInPlace(a, system.size, system.stride, right, system.columns, Progress());
  const Eigen::MatrixXd solved = loaded(right, 30, 400, system.stride);
  EXPECT_EQ(solved.leftCols(390), Eigen::MatrixXd::Zero(30, 390));
  EXPECT_LE(relativeDifference(solved.rightCols(10), system.x.rightCols(10)), 1e-10);
}

TEST(MixedPrecision, IllConditionedSystemsAreRefused) {
  for (double condition : {1e9, 1e12}) {
    const System system(100, 4, condition);
    const AlignedBuffer<double> a = stored<double>(system.a, system.stride);
    AlignedBuffer<double> right = stored<double>(system.b, system.stride);
    EXPECT_TRUE(isRefused<std::runtime_error>(
        [&] { solveMixedInPlace(a, system.size, system.stride, right, 4, Progress()); },
        "refinement in double does not converge: the system is too ill-conditioned for mixed "
        "precision, use double"));
  }
}

TEST(MixedPrecision, SingularSystemsAreRefusedInBothPrecisions) {
  AlignedBuffer<double> a = stored<double>(Eigen::Vector3d(1, 0, 1).asDiagonal(), 3);
  AlignedBuffer<double> right = stored<double>(Eigen::MatrixXd::Ones(3, 1), 3);
  const std::string sentence = "the system matrix is singular: pivot 1 is zero";
  EXPECT_TRUE(isRefused<std::runtime_error>(
      [&] { solveMixedInPlace(a, 3, 3, right, 1, Progress()); }, sentence));
  EXPECT_TRUE(isRefused<std::runtime_error>([&] { solveInPlace(a, 3, 3, right, 1, Progress()); },
                                            sentence));
}

TEST(MixedPrecision, ProgressGrowsAndCanAbortWhileSolving) {
  const System system(40, 1000, 10);
  for (bool mixed : {false, true}) {
    std::vector<double> fractions;
    bool abortWhenSolving = false;
    const Progress progress([&](double fraction, const char* stage) {
      fractions.push_back(fraction);
      return !(abortWhenSolving && std::string(stage) == "solve");
    });
    const auto solve = [&] {
      AlignedBuffer<double> a = stored<double>(system.a, system.stride);
      AlignedBuffer<double> right = stored<double>(system.b, system.stride);
      mixed ? solveMixedInPlace(a, 40, system.stride, right, 1000, progress)
            : solveInPlace(a, 40, system.stride, right, 1000, progress);
    };
    solve();
    // One block to factor, and blocks of 384 or 128 right-hand sides.
    EXPECT_EQ(fractions.size(), mixed ? 1u + 8u : 1u + 3u);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_LE(fractions.back(), 1);
    abortWhenSolving = true;
    EXPECT_TRUE(isRefused<Aborted>(solve, "aborted on request"));
  }
}

}  // namespace
}  // namespace palpate::test
