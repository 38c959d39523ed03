// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>

#include "mesh/triangle_queries.h"

namespace palpate {

/// Shows a query the triangles that can still matter to it: CGAL's tree of axis-aligned boxes, or
/// all of them when the library was built without CGAL. A query neither allocates nor locks.
class TriangleTree {
 public:
  explicit TriangleTree(std::shared_ptr<const SurfaceMesh> mesh);
  ~TriangleTree();

  /// Memory that it takes, for plans; 0 without CGAL.
  static double bytesPerTriangle() noexcept;

  void ask(NearestPoint& query) const noexcept;
  void ask(FirstCrossing& query) const noexcept;

 private:
  struct Boxes;
  std::unique_ptr<const Boxes> boxes_;
};

}  // namespace palpate
