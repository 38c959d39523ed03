// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vector>

extern "C" {
void dgetrf_(const int*, const int*, double*, const int*, int*, int*);
void dgetrs_(const char*, const int*, const int*, const double*, const int*, const int*, double*,
             const int*, int*, unsigned long);
}

namespace palpate::bench {

/// LAPACK's own LU, called as any program would.
class LapackLu {
 public:
  /// @param a  size by size, column-major, overwritten; must stay.
  LapackLu(double* a, int size, int stride) : a_(a), size_(size), stride_(stride), pivots_(size) {
    int info;
    dgetrf_(&size_, &size_, a_, &stride_, pivots_.data(), &info);
  }
  void solve(double* right, int columns, int stride) const {
    int info;
    dgetrs_("N", &size_, &columns, a_, &stride_, pivots_.data(), right, &stride, &info, 1);
  }

 private:
  double* a_;
  int size_, stride_;
  std::vector<int> pivots_;
};

}  // namespace palpate::bench
