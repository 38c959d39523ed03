// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <algorithm>
#include <vector>

#include "bem/collocation_scheme.h"
#include "bem/panel_integration.h"
#include "linear_algebra/aligned_buffer.h"

namespace palpate::bem {

/// The influence matrices of [JP01] eq. 8, H u = G p, a panel of eight equations at a time. H is
/// complete: the free term and the strongly singular integrals follow from rigid translation, H 1 =
/// 0 in an interior and H 1 = 1 in an exterior domain.
class InfluencePanels {
 public:
  /// Keeps references to the body and the scheme.
  /// @param tolerance  of an equation as a whole, see choosePanelRules.
  InfluencePanels(const BodySurface& body, const CollocationScheme& scheme, double tolerance);
  InfluencePanels(const InfluencePanels&) = delete;

  int panelCount() const { return (scheme_.equationCount() + kLanes - 1) / kLanes; }
  /// Equations of a panel: kLanes, fewer in the last one.
  int laneCount(int panel) const {
    return std::min(kLanes, scheme_.equationCount() - panel * kLanes);
  }

  /// Memory for one thread, and the result of compute().
  class Workspace {
   public:
    explicit Workspace(const InfluencePanels& panels);
    /// Entry (i, j) of the 3 by 3 block of H for a vertex: kLanes values, one per equation.
    const double* h(int vertex, int i, int j) const {
      const std::size_t place = panels_.placeOfVertex_[vertex];
      return h_.data() + (9 * place + 3 * i + j) * kLanes;
    }
    /// Entry (i, j) of the block of G for a traction node; the block is symmetric.
    const double* g(int node, int i, int j) const {
      static constexpr int index[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
      const std::size_t place = panels_.placeOfNode_[node];
      return g_.data() + (6 * place + index[i][j]) * kLanes;
    }

   private:
    friend class InfluencePanels;
    const InfluencePanels& panels_;
    AlignedBuffer<double> h_, g_;            // of the equations
    AlignedBuffer<double> pointH_, pointG_;  // of a chunk, at kLanes points
    std::vector<int> ownIndex_;              // of each triangle in the group at hand, or -1
  };

  /// Fills the workspace with a panel's rows of H and G. Safe from several threads, each with its
  /// own workspace.
  void compute(int panel, Workspace& work) const;

  /// Largest component of H (omega x r) over a computed panel's equations and three rotations: zero
  /// but for the error of integration. An exterior domain leaves the rotation itself.
  double rotationResidual(int panel, const Workspace& work) const;

  /// A triangle of the body as the integration sees it.
  const PanelTriangle& triangle(int f) const { return triangles_[positionOfTriangle_[f]]; }

  /// Place of a vertex's values in a workspace among those of all vertices.
  int placeOf(int vertex) const { return placeOfVertex_[vertex]; }

 private:
  struct PointGroup;
  /// A run of triangles whose blocks stay in the second-level cache while all points of a panel
  /// pass over them.
  struct Chunk {
    int firstTriangle, triangleCount;
    std::vector<int> vertices, nodes;  // places of its blocks
  };
  static constexpr int kChunkTriangles = 512;

  void cutIntoChunks();
  bool isTakenAtPoints(int panel) const;
  std::vector<PointGroup> groupPoints(int panel) const;
  void findOwnTriangles(PointGroup& group) const;
  static int pointOfLane(const PointGroup& group, int lane);
  void integrate(const Chunk& chunk, const PointGroup& group, Workspace& work, double* h,
                 double* g) const;
  void closeByTranslation(const std::vector<PointGroup>& groups, double* h) const;

  const BodySurface& body_;
  const CollocationScheme& scheme_;
  std::vector<PanelTriangle> triangles_;  // in spatial order, and
  std::vector<TriangleFrame> frames_;     // theirs
  std::vector<Chunk> chunks_;             // one where nothing is averaged
  std::vector<int> positionOfTriangle_;
  std::vector<int> placeOfVertex_, placeOfNode_;  // in the order in which the triangles meet them
  Eigen::Matrix3Xd positions_;                    // of the vertices, in that order
  PanelRule nearRule_, farRule_;
};

}  // namespace palpate::bem
