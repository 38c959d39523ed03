// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <vector>

namespace palpate::fem {

/// The factored matrix of the products of vertices' hats, for very many right-hand sides: those of
/// one vertex stand beside each other, so that each step of the substitution is a sum of vectors.
class HatProducts {
 public:
  /// @param products  #vertices squared, symmetric and positive definite.
  explicit HatProducts(const Eigen::SparseMatrix<double>& products);

  /// M^-1 B.
  /// @param right  #vertices by any.
  Eigen::MatrixXd solve(
      const Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::Stride<-1, -1>>& right) const;

 private:
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factors_;
};

/// Some rows and columns of a matrix of products.
/// @param rowOf, columnOf  #vertices: where each goes, -1 for those left out.
Eigen::SparseMatrix<double> productsBetween(const Eigen::SparseMatrix<double>& products,
                                            const std::vector<int>& rowOf, Eigen::Index rows,
                                            const std::vector<int>& columnOf, Eigen::Index columns);

}  // namespace palpate::fem
