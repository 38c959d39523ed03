// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>

#include "greens/greens_functions.h"

namespace palpate {

/// Other Green's functions, and what is asked of them. Of one thread.
class CountingGreens final : public GreensFunctions {
 public:
  struct Counts {
    double calls = 0, gatheredBlocks = 0;
    double rows = 0, columns = 0;  ///< of sums that had both
    double multiplyAdds = 0;
    double bytes = 0;  ///< of stored numbers, were they doubles
  };

  explicit CountingGreens(std::shared_ptr<const GreensFunctions> greens)
      : GreensFunctions(greens->info()), greens_(std::move(greens)) {}

  const Counts& counts() const { return counts_; }
  void clearCounts() const { counts_ = {}; }

  void gather(NodeList rows, NodeList columns, double* out) const override {
    ++counts_.calls;
    const double blocks = double(rows.size()) * columns.size();
    counts_.gatheredBlocks += blocks;
    counts_.bytes += 72 * blocks;
    greens_->gather(rows, columns, out);
  }
  void accumulate(NodeList columns, Values weights,
                  Eigen::Ref<Eigen::VectorXd> out) const override {
    count(nodeCount(), columns.size());
    greens_->accumulate(columns, weights, out);
  }
  void accumulate(NodeList columns, Values weights, NodeList rows,
                  Eigen::Ref<Eigen::VectorXd> out) const override {
    count(rows.size(), columns.size());
    greens_->accumulate(columns, weights, rows, out);
  }
  void accumulatePatches(NodeList patchColumns, Values weights,
                         Eigen::Ref<Eigen::VectorXd> out) const override {
    count(nodeCount(), patchColumns.size());
    greens_->accumulatePatches(patchColumns, weights, out);
  }
  double epsilon() const override { return greens_->epsilon(); }
  std::shared_ptr<const GreensFunctions> withYoungsModulus(double youngsModulus) const override {
    return std::make_shared<CountingGreens>(greens_->withYoungsModulus(youngsModulus));
  }

 private:
  void count(double rows, double columns) const {
    ++counts_.calls;
    if (rows == 0 || columns == 0) return;
    counts_.rows += rows;
    counts_.columns += columns;
    counts_.multiplyAdds += 9 * rows * columns;
    counts_.bytes += 72 * rows * columns;
  }

  std::shared_ptr<const GreensFunctions> greens_;
  mutable Counts counts_;
};

}  // namespace palpate
