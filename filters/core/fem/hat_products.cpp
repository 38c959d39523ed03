// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fem/hat_products.h"

#include <algorithm>

namespace palpate::fem {

HatProducts::HatProducts(const Eigen::SparseMatrix<double>& products) : factors_(products) {}

Eigen::MatrixXd HatProducts::solve(
    const Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::Stride<-1, -1>>& right) const {
  constexpr Eigen::Index atOnce = 512;  // columns: their rows stay in the first-level cache
  const Eigen::SparseMatrix<double>& lower = factors_.matrixL().nestedExpression();
  const auto& place = factors_.permutationP().indices();
  using Entry = Eigen::SparseMatrix<double>::InnerIterator;
  Eigen::MatrixXd result(right.rows(), right.cols());
  for (Eigen::Index first = 0; first < right.cols(); first += atOnce) {
    const Eigen::Index count = std::min(atOnce, right.cols() - first);
    Eigen::MatrixXd x(count, right.rows());
    for (Eigen::Index v = 0; v < right.rows(); ++v)
      x.col(place[v]) = right.block(v, first, 1, count).transpose();
    for (Eigen::Index j = 0; j < lower.cols(); ++j) {
      Entry entry(lower, j);  // the diagonal comes first
      x.col(j) /= entry.value();
      while (++entry) x.col(entry.row()) -= entry.value() * x.col(j);
    }
    for (Eigen::Index j = lower.cols() - 1; j >= 0; --j) {
      Entry entry(lower, j);
      const double diagonal = entry.value();
      while (++entry) x.col(j) -= entry.value() * x.col(entry.row());
      x.col(j) /= diagonal;
    }
    for (Eigen::Index v = 0; v < right.rows(); ++v)
      result.block(v, first, 1, count) = x.col(place[v]).transpose();
  }
  return result;
}

Eigen::SparseMatrix<double> productsBetween(const Eigen::SparseMatrix<double>& products,
                                            const std::vector<int>& rowOf, Eigen::Index rows,
                                            const std::vector<int>& columnOf,
                                            Eigen::Index columns) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index column = 0; column < products.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(products, column); entry; ++entry)
      if (columnOf[column] >= 0 && rowOf[entry.row()] >= 0)
        entries.emplace_back(rowOf[entry.row()], columnOf[column], entry.value());
  Eigen::SparseMatrix<double> part(rows, columns);
  part.setFromTriplets(entries.begin(), entries.end());
  return part;
}

}  // namespace palpate::fem
