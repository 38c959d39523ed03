// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "greens/greens_functions.h"
#include "identification/load_patches.h"
#include "identification/measurements.h"
#include "mesh/surface_mesh.h"
#include "mesh/surface_point.h"
#include "progress.h"

namespace palpate {

/// Displacements of a body that something unknown touches.
struct ObservedDisplacements {
  std::vector<SurfacePoint> points;  ///< where, at rest
  Eigen::Matrix3Xd displacements;    ///< 3 by #points, m; NaN where a component was not seen
  Eigen::Matrix3Xd deviations;       ///< 3 by #points, standard, m; empty where not known
};

/// What was observed under one probe of a table.
/// @param markers  #displacements, as markersOn gives them.
/// @param probe    its name; empty where there is one alone.
/// @param noise    standard deviation of all components, m; 0 for what the table says.
/// @throws std::invalid_argument naming the probes to choose from.
ObservedDisplacements observedUnder(const Measurements& measurements,
                                    const std::vector<SurfacePoint>& markers,
                                    const std::string& probe, double noise);

/// @throws std::invalid_argument for sizes that differ, less than nine components, a displacement
///         or deviation that is not finite or not positive, none that moves, all at one place,
///         and displacements too large or small for the body, as in a wrong unit.
void requireUsable(const SurfaceMesh& mesh, const ObservedDisplacements& observed);

/// How much more a support gives way than the model's, or less: a rigid motion of all that it
/// holds, by the force and the torque about its centre.
struct SupportYield {
  double translation = 0;  ///< m/N
  double rotation = 0;     ///< rad/(N m)

  bool isZero() const { return translation == 0 && rotation == 0; }
  Eigen::Matrix<double, 6, 1> diagonal() const {
    Eigen::Matrix<double, 6, 1> six;
    six << Eigen::Vector3d::Constant(translation), Eigen::Vector3d::Constant(rotation);
    return six;
  }
};

/// What loads that are spread over patches of one radius do to the values observed.
struct LoadResponses {
  double radius = 0;
  std::vector<LoadPatch> patches;  ///< #sites
  Eigen::MatrixXd firm;            ///< #rows by 3 #sites, on the support as modelled
  Eigen::MatrixXd wrenches;        ///< 6 by 3 #sites: force and torque about the support's centre
};

/// The values observed, over their standard deviations, and what forces at the free nodes do to
/// them. More values than unknowns are condensed to as many rows as there are unknowns, by
/// orthogonal transformations, which keep all sums of squares.
class ObservedResponse {
 public:
  /// @param sites  as loadSites of the free nodes with columns gives them.
  /// @throws Aborted.
  ObservedResponse(const GreensFunctions& greens, const SurfaceMesh& mesh,
                   const std::vector<LoadSite>& sites, const ObservedDisplacements& observed,
                   const Progress& progress);

  int valueCount() const { return valueCount_; }
  /// Standard deviation of a value, m: as given, in the mean square, else 1 % of the largest.
  double unit() const { return unit_; }
  const Eigen::VectorXd& data() const { return data_; }  ///< #rows
  bool canYield() const { return modes_.cols() > 0; }

  /// @param patches  as loadPatches gives them.
  LoadResponses responsesTo(std::vector<LoadPatch> patches, double radius) const;

  /// The columns of some sites, 3 each, on a support that yields.
  Eigen::MatrixXd columns(const LoadResponses& responses, const std::vector<int>& sites,
                          const SupportYield& yield) const;

  /// What the yields do at a wrench, #rows by 2: per unit of translation and of rotation.
  Eigen::MatrixXd yieldColumns(const Eigen::Matrix<double, 6, 1>& wrench) const;

  /// The rigid motion of a yielding support at a place, m.
  Eigen::Vector3d rigidMotion(const SupportYield& yield, const Eigen::Matrix<double, 6, 1>& wrench,
                              const Eigen::Vector3d& place) const;

 private:
  void addRows(const GreensFunctions& greens, const SurfaceMesh& mesh,
               const ObservedDisplacements& observed, const Progress& progress);
  void condense();

  std::vector<int> nodes_;    ///< of the sites, ascending
  std::vector<int> placeOf_;  ///< #sites, into nodes_
  int valueCount_ = 0;
  double unit_ = 0;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();  ///< of the support
  bool isHeld_ = false;
  Eigen::Index used_ = 0;     ///< rows of all_
  Eigen::MatrixXd all_;       ///< rows, modes and data beside each other
  Eigen::MatrixXd rows_;      ///< #rows by 3 #nodes, of nodal forces
  Eigen::MatrixXd modes_;     ///< #rows by 6: translations and rotations about the centre
  Eigen::MatrixXd wrenchOf_;  ///< 6 by 3 #nodes
  Eigen::VectorXd data_;
};

}  // namespace palpate
