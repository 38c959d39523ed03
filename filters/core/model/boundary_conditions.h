// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vector>

namespace palpate {

/// What a boundary value problem prescribes at a node: Lambda_p and Lambda_u of [JP01] section 3.3.
enum class BoundaryType : unsigned char {
  Free = 0,   ///< traction given, displacement unknown
  Fixed = 1,  ///< displacement given, traction unknown
};

/// The type of a boundary value problem (Lambda_u, Lambda_p): one BoundaryType a node.
class BoundaryConditions {
 public:
  BoundaryConditions() = default;
  /// @param types  #V values, 0 free or 1 fixed.
  /// @throws std::invalid_argument naming the node of any other value.
  explicit BoundaryConditions(std::vector<unsigned char> types);

  int nodeCount() const { return static_cast<int>(types_.size()); }
  bool isFixed(int node) const { return types_[node] == static_cast<int>(BoundaryType::Fixed); }
  const std::vector<unsigned char>& types() const { return types_; }
  /// Lambda_u, ascending.
  std::vector<int> fixedNodes() const { return nodesOf(BoundaryType::Fixed); }
  /// Lambda_p, ascending.
  std::vector<int> freeNodes() const { return nodesOf(BoundaryType::Free); }

 private:
  std::vector<int> nodesOf(BoundaryType type) const;
  std::vector<unsigned char> types_;
};

}  // namespace palpate
