// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What remains of the sparse solver when the library is built without MUMPS.

#include <stdexcept>

#include "linear_algebra/sparse_factorization.h"

namespace palpate {

struct SparseFactorization::Instance {};

SparseFactorization::SparseFactorization(SymmetricEntries, int, bool) {
  throw std::runtime_error(
      "finite elements and shells need MUMPS, which this build of Palpate was made without");
}
SparseFactorization::~SparseFactorization() = default;
void SparseFactorization::solve(Eigen::Ref<Eigen::MatrixXd>) const {}
void SparseFactorization::solveUnits(const std::vector<int>&, Eigen::Ref<Eigen::MatrixXd>) const {}
int SparseFactorization::negativePivots() const {
  return 0;
}
std::size_t SparseFactorization::peakBytes() const {
  return 0;
}
bool SparseFactorization::isAvailable() {
  return false;
}

}  // namespace palpate
