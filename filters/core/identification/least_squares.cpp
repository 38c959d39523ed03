// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/least_squares.h"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <Eigen/SVD>
#include <stdexcept>
#include <vector>

#include "sentence.h"

namespace palpate {
namespace {

constexpr double kFullRank = 1e-9;         // of singular values, columns scaled to one
constexpr double kLargestGradient = 1e-3;  // where the tolerance is not what bounds it

/// Beside the library that this is compiled into, or wherever libraries are looked for.
LeastSquaresFunction* load() {
  std::string folder;
  Dl_info here;
  if (dladdr(reinterpret_cast<const void*>(&kLeastSquaresLibrary), &here) && here.dli_fname)
    folder = std::string(here.dli_fname);
  folder = folder.substr(0, folder.rfind('/') + 1);
  void* library = nullptr;
  for (const std::string& place : {folder, folder + "../lib/", std::string()}) {
    library = dlopen((place + kLeastSquaresLibrary).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library) break;
  }
  void* function = library ? dlsym(library, kLeastSquaresFunction) : nullptr;
  if (!function)
    throw std::runtime_error(
        std::string("identification needs the library Ceres (Debian: libceres3): ") + dlerror());
  return reinterpret_cast<LeastSquaresFunction*>(function);
}

/// Columns; those of zeros stay.
Eigen::MatrixXd ofLengthOne(Eigen::MatrixXd columns) {
  for (auto column : columns.colwise())
    if (const double size = column.norm(); size > 0) column /= size;
  return columns;
}

bool hasFullRank(const Eigen::MatrixXd& columns) {
  const Eigen::VectorXd values = Eigen::BDCSVD<Eigen::MatrixXd>(columns).singularValues();
  return values[values.size() - 1] > kFullRank * values[0];
}

/// What of the solution can be told from its residuals and their derivatives.
void inspect(const LeastSquaresProblem& problem, LeastSquaresSolution& solution) {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
  problem.evaluate(solution.parameters, residuals, &jacobian);
  if (!residuals.allFinite() || !jacobian.allFinite() || !std::isfinite(solution.cost))
    throw std::runtime_error("the identification came to a place without finite residuals");
  const Eigen::VectorXd& x = solution.parameters;
  std::vector<int> inside;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (!isAtBound(x[i], problem.lower[i], problem.upper[i])) inside.push_back(static_cast<int>(i));
  const int count = static_cast<int>(inside.size());
  const Eigen::MatrixXd all = ofLengthOne(jacobian);
  if (count < x.size() && (solution.covariance.size() == 0 || !hasFullRank(all)))
    solution.covariance = solution.heldCovariance;
  solution.weakest.setZero(x.size());
  if (count == 0) return;
  const Eigen::MatrixXd scaled = all(Eigen::all, inside);
  const Eigen::BDCSVD<Eigen::MatrixXd> parts(scaled, Eigen::ComputeThinV);
  const Eigen::VectorXd& values = parts.singularValues();
  const Eigen::VectorXd least = parts.matrixV().col(count - 1);
  for (int i = 0; i < count; ++i) solution.weakest[inside[i]] = least[i];
  solution.condition = values[count - 1] > 0 ? values[0] / values[count - 1] : INFINITY;
  if (problem.loss == RobustLoss::None)
    solution.gradient =
        (scaled.transpose() * residuals).cwiseAbs().maxCoeff() / (1 + residuals.norm());
  if (!(values[count - 1] > kFullRank * values[0])) solution.covariance.resize(0, 0);
}

}  // namespace

LeastSquaresSolution solveLeastSquares(const LeastSquaresProblem& problem) {
  static LeastSquaresFunction* const solve = load();
  LeastSquaresSolution solution;
  std::string failure;
  solve(problem, solution, failure);
  if (!failure.empty()) throw NotConverged(failure, solution.parameters);
  inspect(problem, solution);
  if (solution.gradient > std::max(kLargestGradient, 3 * std::sqrt(problem.tolerance)))
    throw NotConverged(
        sentence("the slope left is ", shortly(solution.gradient), " of the residuals"),
        solution.parameters);
  return solution;
}

}  // namespace palpate
