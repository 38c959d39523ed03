// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <algorithm>
#include <cstdint>
#include <Eigen/Core>
#include <numeric>
#include <vector>

namespace palpate::bem {

/// Order of points along a Morton (Z-order) curve, which keeps neighbours together.
/// @param points  3 by #points.
inline std::vector<int> spatialOrder(const Eigen::Matrix3Xd& points) {
  std::vector<int> order(points.cols());
  std::iota(order.begin(), order.end(), 0);
  if (order.empty()) return order;
  const Eigen::Vector3d low = points.rowwise().minCoeff();
  const double extent = std::max((points.rowwise().maxCoeff() - low).maxCoeff(), 1e-300);
  const auto spread = [](std::uint64_t bits) {  // 21 bits, two zeros between each
    bits = (bits | bits << 32) & 0x001f00000000ffffull;
    bits = (bits | bits << 16) & 0x001f0000ff0000ffull;
    bits = (bits | bits << 8) & 0x100f00f00f00f00full;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3ull;
    return (bits | bits << 2) & 0x1249249249249249ull;
  };
  std::vector<std::uint64_t> key(points.cols());
  for (int i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d scaled = (points.col(i) - low) / extent * double((1 << 21) - 1);
    key[i] = spread(static_cast<std::uint64_t>(scaled.x())) |
             spread(static_cast<std::uint64_t>(scaled.y())) << 1 |
             spread(static_cast<std::uint64_t>(scaled.z())) << 2;
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key[a] < key[b]; });
  return order;
}

}  // namespace palpate::bem
