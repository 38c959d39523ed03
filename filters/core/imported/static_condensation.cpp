// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imported/static_condensation.h"

#include <cmath>
#include <limits>

#include "linear_algebra/dense_cholesky.h"
#include "linear_algebra/lapack.h"
#include "linear_algebra/sparse_factorization.h"
#include "sentence.h"

namespace palpate::imported {
namespace {

constexpr int kSparseFrom = 1500;  // rows to condense out

[[noreturn]] void refuseLoose(const NodePlaces& places, int row) {
  refuse("the stiffness does not hold ", places.nameOf(row),
         " in its place when the surface is held: it cannot be condensed out");
}

/// The symmetric part of a block.
Eigen::MatrixXd symmetricBlock(const GivenMatrix& matrix, const std::vector<int>& rows,
                               const std::vector<int>& columns) {
  return (matrix.block(rows, columns) + matrix.block(columns, rows).transpose()) / 2;
}

Eigen::MatrixXd condensedDense(const GivenMatrix& matrix, const std::vector<int>& kept,
                               const std::vector<int>& inner, const NodePlaces& places,
                               const Progress& progress) {
  const int size = static_cast<int>(inner.size()), keptSize = static_cast<int>(kept.size());
  Eigen::MatrixXd stiffness = symmetricBlock(matrix, kept, kept);
  if (size == 0) return stiffness;
  Eigen::MatrixXd own = symmetricBlock(matrix, inner, inner),
                  coupling = symmetricBlock(matrix, inner, kept);
  for (int i = 0; i < size; ++i)
    if (!(own(i, i) > 0)) refuseLoose(places, inner[i]);
  const Eigen::VectorXd scale = own.diagonal().cwiseSqrt().cwiseInverse();
  own = scale.asDiagonal() * own * scale.asDiagonal();
  coupling = scale.asDiagonal() * coupling;
  if (const int row = factorCholesky(own.data(), size, progress.part(0.1, 0.5)))
    refuseLoose(places, inner[row - 1]);
  for (int i = 0; i < size; ++i)
    if (!(own(i, i) * own(i, i) > size * std::numeric_limits<double>::epsilon()))
      refuseLoose(places, inner[i]);
  lapack::trsmLower(false, size, keptSize, own.data(), size, coupling.data(), size);
  progress.report(0.8, "condense");
  lapack::subtractSquare(true, keptSize, size, coupling.data(), size, stiffness.data(), keptSize);
  stiffness.triangularView<Eigen::StrictlyUpper>() = stiffness.transpose();
  return stiffness;
}

Eigen::MatrixXd condensedSparse(const GivenMatrix& matrix, const std::vector<int>& kept,
                                const std::vector<int>& inner, const NodePlaces& places) {
  std::vector<int> place(matrix.size(), -1);
  for (std::size_t i = 0; i < inner.size(); ++i) place[inner[i]] = static_cast<int>(i);
  for (std::size_t i = 0; i < kept.size(); ++i) place[kept[i]] = static_cast<int>(inner.size() + i);
  const Eigen::SparseMatrix<double> lower = matrix.symmetricLower();
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(matrix.size());
  for (int row : inner) {
    const double own = lower.coeff(row, row);
    if (!(own > 0)) refuseLoose(places, row);
    scale[row] = 1 / std::sqrt(own);
  }
  SymmetricEntries entries;
  entries.size = static_cast<int>(inner.size() + kept.size());
  for (int j = 0; j < lower.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, j); entry; ++entry)
      if (place[entry.row()] >= 0 && place[j] >= 0)
        entries.add(place[entry.row()], place[j], entry.value() * scale[entry.row()] * scale[j]);
  const SparseFactorization factors(std::move(entries), static_cast<int>(kept.size()), false);
  if (factors.negativePivots() > 0)
    refuse("the stiffness of what is not on the surface has ", factors.negativePivots(),
           " negative eigenvalues: it is no elastic body's");
  return factors.schurComplement();
}

}  // namespace

Eigen::MatrixXd condensedStiffness(const GivenMatrix& matrix, const std::vector<int>& kept,
                                   const NodePlaces& places, const Progress& progress) {
  progress.report(0, "condense");
  const std::vector<RowContent> contents = matrix.rowContents();
  std::vector<int> inner;
  for (int row : places.others)
    if (contents[row] != RowContent::Nothing) inner.push_back(row);
  const bool isLarge = matrix.isSparse() && inner.size() > kSparseFrom;
  return isLarge && SparseFactorization::isAvailable()
             ? condensedSparse(matrix, kept, inner, places)
             : condensedDense(matrix, kept, inner, places, progress);
}

}  // namespace palpate::imported
