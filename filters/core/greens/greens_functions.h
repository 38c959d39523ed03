// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "diagnostics.h"
#include "greens/probe_rows.h"
#include "model/boundary_conditions.h"
#include "model/elastic_model.h"
#include "model/material.h"

namespace palpate {

using NodeList = Eigen::Ref<const Eigen::VectorXi>;
using Values = Eigen::Ref<const Eigen::VectorXd>;

/// A view of a list of nodes as an argument.
inline Eigen::Map<const Eigen::VectorXi> nodeList(const std::vector<int>& nodes) {
  return {nodes.data(), static_cast<Eigen::Index>(nodes.size())};
}

/// A column for the traction on one smooth patch of a vertex on a sharp edge, all else zero.
struct PatchColumn {
  int node, patch;
};

/// What Green's functions belong to and how they were made.
struct GreensFunctionsInfo {
  BoundaryConditions conditions;  ///< reference BVP, #nodes
  Material material{1, 0};        ///< as served
  bool homogeneous = true;        ///< of this material all through; else it is a unit of stiffness
  Domain domain = Domain::Interior;
  bool rotationsHeld = false;             ///< of fixed nodes, too, as of clamped shells
  Eigen::VectorXd vertexAreas;            ///< #nodes, eq. 5
  std::vector<int> columnNodes;           ///< nodes whose columns are stored, in storage order
  std::vector<PatchColumn> patchColumns;  ///< extra columns, in storage order
  std::uint64_t fingerprint = 0;          ///< ElasticModel::fingerprint()
  bool reciprocal = false;  ///< the free-free blocks are symmetric as force compliances
  /// 3 #nodes by 3: what a weight of 1 N/m^3 along each axis does, metres where free and pascals
  /// where fixed (of a body of several densities: in the mean over its volume). Empty where it was
  /// not computed; of what nothing holds as looseWeightResponse has it.
  Eigen::MatrixXd weightResponse;
  double density = 0;                       ///< kg/m^3, in the mean; 0 where it is not known
  std::shared_ptr<const ProbeRows> probes;  ///< that the method was asked for, or null
  std::string source;                       ///< method, options and version, for people
  Diagnostics diagnostics;
};

/// The discrete Green's functions Xi of a reference boundary value problem ([JP01] eq. 11-13): the
/// response v = Xi v_given of what is unknown at the nodes (u where free, p where fixed) to what is
/// given (p where free, u where fixed). Rows and columns come in blocks of three, one block a node.
/// This is the one interface between those who make Green's functions and those who use them.
///
/// Thread-safe: all queries are const and none allocates.
class GreensFunctions {
 public:
  explicit GreensFunctions(GreensFunctionsInfo info);
  virtual ~GreensFunctions() = default;

  const GreensFunctionsInfo& info() const { return info_; }
  int nodeCount() const { return info_.conditions.nodeCount(); }
  int columnCount() const { return static_cast<int>(info_.columnNodes.size()); }
  bool isFixed(int node) const { return info_.conditions.isFixed(node); }
  bool hasColumn(int node) const { return columnOfNode_[node] >= 0; }
  /// Free nodes without a column, on which no force can act.
  int missingCount() const;
  double vertexArea(int node) const { return info_.vertexAreas[node]; }

  /// Copies the blocks Xi[rows, columns].
  /// @param rows, columns  nodes; every column must be stored.
  /// @param out            3 #rows by 3 #columns, column-major without gaps.
  virtual void gather(NodeList rows, NodeList columns, double* out) const = 0;

  /// out += Xi[all rows, columns] * weights.
  /// @param weights  3 #columns: pascals at free, metres at fixed nodes.
  /// @param out      3 #nodes: metres at free, pascals at fixed nodes.
  virtual void accumulate(NodeList columns, Values weights,
                          Eigen::Ref<Eigen::VectorXd> out) const = 0;

  /// out += Xi[rows, columns] * weights, at the cost of those rows.
  /// @param out  3 #rows.
  virtual void accumulate(NodeList columns, Values weights, NodeList rows,
                          Eigen::Ref<Eigen::VectorXd> out) const = 0;

  /// out += (response to tractions on single patches), all rows.
  /// @param patchColumns  indices into info().patchColumns.
  /// @param weights       3 #patchColumns, Pa.
  virtual void accumulatePatches(NodeList patchColumns, Values weights,
                                 Eigen::Ref<Eigen::VectorXd> out) const = 0;

  /// Relative rounding of the stored numbers.
  virtual double epsilon() const = 0;

  /// The same body with another Young's modulus, by scaling alone ([JP01] section 3.6).
  virtual std::shared_ptr<const GreensFunctions> withYoungsModulus(double youngsModulus) const = 0;

  /// @throws std::invalid_argument naming the first node out of range or without a stored column.
  void requireColumns(NodeList nodes) const;

 protected:
  int columnOfNode(int node) const { return columnOfNode_[node]; }

 private:
  GreensFunctionsInfo info_;
  std::vector<int> columnOfNode_;
};

/// Solves the reference boundary value problem itself, v = Xi v_given (eq. 11).
/// @param given  3 by #nodes: tractions (Pa) at free, displacements (m) at fixed nodes. Nodes
///               without any cost nothing and need no stored column.
/// @return 3 by #nodes: displacements at free, tractions at fixed nodes.
/// @throws std::invalid_argument if the size differs or a column that is needed is not stored.
Eigen::Matrix3Xd solveReferenceProblem(const GreensFunctions& greens,
                                       const Eigen::Matrix3Xd& given);

/// Solves it for a traction on every triangle, which may jump across sharp edges. The nodal
/// tractions are area-weighted means over each patch of a vertex, so that the applied force is that
/// of the triangles exactly. What falls on nodes whose traction is unknown is part of their
/// reaction.
/// @param mesh, patches    as the Green's functions were made with.
/// @param faceTractions    3 by #F, Pa.
/// @param applied          set to the 3 by #nodes nodal forces applied, N.
/// @return 3 by #nodes: displacements at free, tractions at fixed nodes.
/// @throws std::invalid_argument if sizes differ, or if a vertex on a sharp edge is loaded whose
///         patch columns were not computed.
Eigen::Matrix3Xd solveFaceTractions(const GreensFunctions& greens, const SurfaceMesh& mesh,
                                    const Eigen::VectorXi& patches,
                                    const Eigen::Matrix3Xd& faceTractions,
                                    Eigen::Matrix3Xd& applied);

}  // namespace palpate
