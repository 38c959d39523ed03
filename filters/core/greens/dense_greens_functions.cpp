// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/dense_greens_functions.h"

#include <stdexcept>
#include <utility>

#include "greens/replaced_rows.h"
#include "greens/weighted_columns.h"

namespace palpate {
namespace {

void requireSize(std::size_t values, std::size_t columns, int nodes, const char* kind) {
  if (values < 9 * columns * nodes)
    throw std::invalid_argument("there are " + std::to_string(values) + " values for " +
                                std::to_string(columns) + kind + "columns of " +
                                std::to_string(nodes) + " nodes");
}

/// Rows of free nodes are per pascal, those of fixed ones per metre.
std::shared_ptr<const ProbeRows> stiffer(const ProbeRows& probes,
                                         const BoundaryConditions& conditions, double factor) {
  const ProbeRows perPascal = probes.stiffer(factor);
  Eigen::MatrixXd rows = perPascal.rows();
  for (int node : conditions.fixedNodes()) rows.middleCols<3>(3 * node) *= factor;
  return withRows(perPascal, std::move(rows));
}

}  // namespace

template <class Scalar>
DenseGreensFunctions<Scalar>::DenseGreensFunctions(GreensFunctionsInfo info,
                                                   AlignedBuffer<Scalar> matrix,
                                                   AlignedBuffer<Scalar> patchMatrix)
    : GreensFunctions(std::move(info)) {
  requireSize(matrix.size(), columnCount(), nodeCount(), " ");
  requireSize(patchMatrix.size(), this->info().patchColumns.size(), nodeCount(), " patch ");
  auto owner = std::make_shared<std::pair<AlignedBuffer<Scalar>, AlignedBuffer<Scalar>>>(
      std::move(matrix), std::move(patchMatrix));
  matrix_ = owner->first.data();
  patchMatrix_ = owner->second.data();
  keeper_ = owner;
}

template <class Scalar>
DenseGreensFunctions<Scalar>::DenseGreensFunctions(GreensFunctionsInfo info, const Scalar* matrix,
                                                   const Scalar* patchMatrix,
                                                   std::shared_ptr<const void> keeper)
    : GreensFunctions(std::move(info)),
      matrix_(matrix),
      patchMatrix_(patchMatrix),
      keeper_(std::move(keeper)) {}

template <class Scalar>
void DenseGreensFunctions<Scalar>::gather(NodeList rows, NodeList columns, double* out) const {
  for (int columnNode : columns)
    for (int j = 0; j < 3; ++j) {
      const Scalar* source = column(columnNode, j);
      for (int row : rows) {
        const double scale = blockScale(row, columnNode);
        for (int i = 0; i < 3; ++i) *out++ = scale * source[3 * row + i];
      }
    }
}

template <class Scalar>
template <class ColumnAt, class WeightAt>
void DenseGreensFunctions<Scalar>::stream(Eigen::Index blocks, const ColumnAt& columnAt,
                                          const WeightAt& weightAt,
                                          Eigen::Ref<Eigen::VectorXd> out) const {
  if (blocks == 0) return;
  // Fixed rows carry the factor s and free ones none; dividing the sum so far first keeps one pass.
  const auto scaleFixedRows = [&](double factor) {
    if (factor == 1) return;
    for (int node = 0; node < nodeCount(); ++node)
      if (isFixed(node)) out.template segment<3>(3 * node) *= factor;
  };
  scaleFixedRows(1 / stiffnessScale_);
  const Scalar* group[kColumnGroup];
  double weights[kColumnGroup];
  int size = 0;
  for (Eigen::Index c = 0; c < 3 * blocks; ++c) {
    group[size] = columnAt(c / 3, c % 3);
    weights[size++] = weightAt(c / 3, c % 3);
    if (size < kColumnGroup && c + 1 < 3 * blocks) continue;
    addWeightedColumns(group, weights, size, 3 * nodeCount(), out.data());
    size = 0;
  }
  scaleFixedRows(stiffnessScale_);
}

template <class Scalar>
void DenseGreensFunctions<Scalar>::accumulate(NodeList columns, Values weights,
                                              Eigen::Ref<Eigen::VectorXd> out) const {
  stream(
      columns.size(), [&](Eigen::Index c, int j) { return column(columns[c], j); },
      [&](Eigen::Index c, int j) {
        return weights[3 * c + j] * (isFixed(columns[c]) ? 1 : 1 / stiffnessScale_);
      },
      out);
}

template <class Scalar>
void DenseGreensFunctions<Scalar>::accumulatePatches(NodeList patchColumns, Values weights,
                                                     Eigen::Ref<Eigen::VectorXd> out) const {
  stream(
      patchColumns.size(),
      [&](Eigen::Index c, int j) {
        return patchMatrix_ + (3 * std::size_t(patchColumns[c]) + j) * 3 * nodeCount();
      },
      [&](Eigen::Index c, int j) { return weights[3 * c + j] / stiffnessScale_; }, out);
}

template <class Scalar>
void DenseGreensFunctions<Scalar>::accumulate(NodeList columns, Values weights, NodeList rows,
                                              Eigen::Ref<Eigen::VectorXd> out) const {
  for (Eigen::Index c = 0; c < columns.size(); ++c)
    for (int j = 0; j < 3; ++j) {
      const Scalar* source = column(columns[c], j);
      for (Eigen::Index r = 0; r < rows.size(); ++r) {
        const double weight = weights[3 * c + j] * blockScale(rows[r], columns[c]);
        for (int i = 0; i < 3; ++i) out[3 * r + i] += weight * source[3 * rows[r] + i];
      }
    }
}

template <class Scalar>
std::shared_ptr<const GreensFunctions> DenseGreensFunctions<Scalar>::withYoungsModulus(
    double youngsModulus) const {
  GreensFunctionsInfo scaledInfo = info();
  const double factor = youngsModulus / info().material.youngsModulus();
  scaledInfo.material = Material(youngsModulus, info().material.poissonRatio());
  if (scaledInfo.diagnostics.rockingCompliance > 0)
    scaledInfo.diagnostics.rockingCompliance /= factor;
  for (int node = 0; node < nodeCount() && scaledInfo.weightResponse.size() > 0; ++node)
    if (!isFixed(node)) scaledInfo.weightResponse.middleRows<3>(3 * node) /= factor;
  if (scaledInfo.probes) scaledInfo.probes = stiffer(*scaledInfo.probes, info().conditions, factor);
  auto scaled = std::make_shared<DenseGreensFunctions<Scalar>>(std::move(scaledInfo), matrix_,
                                                               patchMatrix_, keeper_);
  scaled->stiffnessScale_ = stiffnessScale_ * factor;
  return scaled;
}

template class DenseGreensFunctions<double>;
template class DenseGreensFunctions<float>;

}  // namespace palpate
