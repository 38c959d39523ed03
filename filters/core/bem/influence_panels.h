// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <atomic>
#include <vector>

#include "bem/body_surface.h"
#include "bem/panel_integration.h"
#include "linear_algebra/aligned_buffer.h"

namespace palpate::bem {

/// The influence matrices of [JP01] eq. 8, H u = G p, a panel of eight collocation points at a
/// time. H is complete: the free term and the strongly singular integrals follow from rigid
/// translation, H 1 = 0 in an interior and H 1 = 1 in an exterior domain.
class InfluencePanels {
 public:
  /// @param tolerance  relative tolerance of each integral, see choosePanelRules.
  InfluencePanels(const BodySurface& body, const std::vector<CollocationPoint>& points,
                  double tolerance);

  int panelCount() const { return (static_cast<int>(points_.size()) + kLanes - 1) / kLanes; }
  /// Points of a panel: kLanes, fewer in the last one.
  int laneCount(int panel) const {
    return std::min(kLanes, static_cast<int>(points_.size()) - panel * kLanes);
  }

  /// Memory for one thread, and the result of compute().
  class Workspace {
   public:
    explicit Workspace(const InfluencePanels& panels);
    /// Entry (i, j) of the 3 by 3 block of H for a vertex: kLanes values, one per point.
    const double* h(int vertex, int i, int j) const {
      return h_.data() + (9 * std::size_t(vertex) + 3 * i + j) * kLanes;
    }
    /// Entry (i, j) of the block of G for a traction node; the block is symmetric.
    const double* g(int node, int i, int j) const {
      static constexpr int index[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
      return g_.data() + (6 * std::size_t(node) + index[i][j]) * kLanes;
    }

   private:
    friend class InfluencePanels;
    AlignedBuffer<double> h_, g_;
    std::vector<int> ownIndex_;
    std::vector<OwnTriangle> own_;
    long closedFormCount_ = 0;
  };

  /// Fills the workspace with a panel's rows of H and G. Safe from several threads, each with its
  /// own workspace.
  void compute(int panel, Workspace& work) const;

  /// A triangle of the body as the integration sees it.
  const PanelTriangle& triangle(int f) const { return triangles_[positionOfTriangle_[f]]; }

  /// Share of the panel-triangle pairs so far that needed a closed form.
  double closedFormShare() const {
    return double(closedFormPairs_) / std::max(1.0, double(allPairs_));
  }

 private:
  void markOwnTriangles(int panel, Workspace& work) const;
  void closeByTranslation(int panel, Workspace& work) const;

  const BodySurface& body_;
  const std::vector<CollocationPoint>& points_;
  std::vector<PanelTriangle> triangles_;  // in spatial order
  std::vector<int> positionOfTriangle_;
  PanelRule rules_[kRuleCount];
  mutable std::atomic<long> closedFormPairs_{0}, allPairs_{0};
};

}  // namespace palpate::bem
