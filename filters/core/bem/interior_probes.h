// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "greens/greens_functions.h"
#include "greens/probe_rows.h"
#include "mesh/surface_mesh.h"
#include "model/boundary_conditions.h"
#include "model/elastic_model.h"
#include "progress.h"

namespace palpate {

/// Which points probes can be at: inside the material, and no nearer to its surface than 1e-4
/// edges.
/// @param points  3 by any.
/// @throws std::invalid_argument for a domain other than interior and exterior.
std::vector<int> probesInside(const ElasticModel& model, const Eigen::Matrix3Xd& points);

/// Displacement, strain and stress at points inside a homogeneous isotropic body ([JP01] section
/// 3.5), from displacement and traction on all of its surface (Somigliana's identity), whatever
/// method those come from. Linear fields are met to the tolerance of the integrals; elsewhere the
/// error is that of the surface's solution, but within about an edge of the surface its kinks show:
/// `distances` tells how far that is.
///
/// The constructor integrates; evaluate is const, and costs 78 products a vertex and point.
class InteriorProbes {
 public:
  /// @param model   interior or exterior domain.
  /// @param points  3 by any, m.
  /// @throws std::invalid_argument for a half-space, or naming the first point that is not finite,
  ///         not inside the material, or nearer to the surface than 1e-4 of its edges; Aborted.
  InteriorProbes(const ElasticModel& model, const Eigen::Matrix3Xd& points,
                 const ProgressCallback& progress = {}, int threads = 0);

  int count() const { return static_cast<int>(ofTraction_.size()); }

  /// @param displacement  3 by #V, m.
  /// @param traction      3 by #V, Pa: at fixed vertices area times traction is the reaction.
  /// @return a field a point.
  /// @throws std::invalid_argument if sizes differ.
  std::vector<ProbedField> evaluate(const Eigen::Matrix3Xd& displacement,
                                    const Eigen::Matrix3Xd& traction) const;

  /// ProbeValues of many answers at once: 13 #points by #answers.
  /// @param displacement, traction  3 #V by #answers.
  Eigen::MatrixXd values(const Eigen::MatrixXd& displacement,
                         const Eigen::MatrixXd& traction) const;

  /// From the surface, in mean edge lengths, a point each.
  const Eigen::VectorXd& distances() const { return distances_; }

 private:
  using Rows = Eigen::Matrix<double, 13, Eigen::Dynamic>;
  struct Integration;

  Eigen::Index vertexCount_;
  double shearModulus_;
  std::vector<Rows> ofTraction_, ofDisplacement_;  ///< 13 by 3 #V a point
  Eigen::VectorXd distances_;
};

/// The rows of points inside a body, from all columns of its Green's functions.
/// @param greens  of the model, whose material is theirs.
/// @throws std::invalid_argument unless the body is homogeneous and isotropic, and as
/// InteriorProbes;
///         Aborted.
ProbeRows probeRows(const GreensFunctions& greens, const ElasticModel& model,
                    const Eigen::Matrix3Xd& points, const ProgressCallback& progress = {},
                    int threads = 0);

}  // namespace palpate
