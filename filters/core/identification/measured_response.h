// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "greens/greens_functions.h"
#include "greens/spread_force.h"
#include "identification/measurements.h"

namespace palpate {

/// Where forces act and displacements are looked at, on one surface.
struct MeasuredSetup {
  std::vector<SpreadForce> loads;        ///< #probes
  std::vector<int> probeOf;              ///< #markers
  std::vector<Eigen::Vector3i> nodes;    ///< #markers: corners of the triangle
  std::vector<Eigen::Vector3d> weights;  ///< #markers: barycentric
  Eigen::Matrix3Xd places;               ///< #markers: at rest, on the surface, m

  int probeCount() const { return static_cast<int>(loads.size()); }
  int markerCount() const { return static_cast<int>(probeOf.size()); }
};

/// @param loads  #probes, how each force is spread.
MeasuredSetup measuredSetup(const SurfaceMesh& mesh, const Measurements& measurements,
                            const MeasuredPlaces& places, std::vector<SpreadForce> loads);

/// The forces of the probes at the vertices.
/// @param areas  #V.
/// @return 3 #V by #probes, N.
Eigen::MatrixXd nodalForces(const MeasuredSetup& setup, const Measurements& measurements,
                            const Eigen::VectorXd& areas);

/// What markers see of displacements of the surface under each probe, 3 #markers.
/// @param displacements  3 #V by #probes, m.
Eigen::VectorXd seenAtMarkers(const MeasuredSetup& setup, const Eigen::MatrixXd& displacements);

/// What markers see of unit forces along x, y and z of their own probe: 3 #markers by 3, m/N. Where
/// the support yields, fixed nodes are released onto an elastic foundation ([JP01] eq. 18-21 with
/// all of them switched): with a stiffness k per area,
///     u = Xi_FF p - Xi_FU (Xi_UU + k)^-1 Xi_UF p.
/// Young's modulus over k is the length c that describes it, 0 for a firm support. With
/// Hessenberg's form of Xi_UU each c costs the square of the support's size.
class MeasuredResponse {
 public:
  /// @param yieldingSupport  whether foundation() will be asked for other than 0; then the columns
  ///                         of the fixed nodes must be stored.
  /// @throws std::invalid_argument for a column that is missing.
  MeasuredResponse(const GreensFunctions& greens, const MeasuredSetup& setup, bool yieldingSupport);

  /// What is measured less what is predicted, 3 #markers, m.
  /// @param measurements  of the setup.
  /// @param length        of the foundation.
  Eigen::VectorXd residuals(const Measurements& measurements, double length) const;

  /// On a firm support.
  const Eigen::MatrixXd& rows() const { return rows_; }

  /// On a foundation.
  /// @param length      c = E / k >= 0, m, with the Young's modulus of the Green's functions.
  /// @param derivative  set to that by c, if not null.
  Eigen::MatrixXd onFoundation(double length, Eigen::MatrixXd* derivative) const;

 private:
  void prepareFoundation(const GreensFunctions& greens, const MeasuredSetup& setup,
                         const std::vector<Eigen::MatrixXd>& fields);
  Eigen::MatrixXd readOut(const Eigen::MatrixXd& support) const;

  double modulus_;
  Eigen::MatrixXd rows_;
  std::vector<int> probeOf_;
  Eigen::MatrixXd stiffness_;  ///< Hessenberg's form of Xi_UU / E, 1/m
  Eigen::MatrixXd loading_;    ///< Q^T Xi_UF of unit forces, 3 #fixed by 3 #probes
  Eigen::MatrixXd readOut_;    ///< Xi_MU Q, 3 #markers by 3 #fixed
};

}  // namespace palpate
