// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>
#include <Eigen/Core>

#include "model/elastic_model.h"

namespace palpate {

/// 6 by #V: whether the displacement along x, y, z and the rotation about x, y, z of a vertex are
/// held.
using HeldComponents = Eigen::Array<bool, 6, Eigen::Dynamic>;

/// Fixed vertices hold their displacements, clamped ones their rotations, too.
HeldComponents heldComponents(const BoundaryConditions& conditions, bool clamped);

/// Whether all rotations of all fixed vertices are held.
bool areRotationsHeld(const BoundaryConditions& conditions, const HeldComponents& held);

/// The thickness at the corners of each triangle, 3 by #F, from one a vertex, between which it is
/// linear, or one a triangle.
/// @param thickness  #V or #F, in the unit of length.
/// @throws std::invalid_argument if sizes differ, or naming the vertex or triangle where it is not
///         above zero or exceeds the surface's diagonal.
Eigen::Matrix3Xd thicknessOfVertices(const SurfaceMesh& mesh, const Eigen::VectorXd& thickness);
Eigen::Matrix3Xd thicknessOfTriangles(const SurfaceMesh& mesh, const Eigen::VectorXd& thickness);

/// What makes a surface a thin shell, whose middle it is: its thickness, and what is held of each
/// vertex. Held components are those of fixed vertices, and such of free ones as symmetry or a
/// diaphragm holds, along which a force does nothing.
class ThinShell {
 public:
  /// @param model      of Domain::Shell.
  /// @param thickness  3 by #F.
  /// @throws std::invalid_argument for another domain, sizes that differ, a thickness that is not
  ///         above zero, a fixed vertex whose displacement is not held, a free one whose
  ///         displacement is, or a piece of the surface that a rigid motion is left to.
  ThinShell(const ElasticModel& model, Eigen::Matrix3Xd thickness, HeldComponents held);
  /// Held at its fixed vertices.
  ThinShell(const ElasticModel& model, Eigen::Matrix3Xd thickness, bool clamped);

  const Eigen::Matrix3Xd& thickness() const { return thickness_; }
  const HeldComponents& held() const { return held_; }
  /// areRotationsHeld.
  bool isClamped() const { return isClamped_; }
  double thinnest() const { return thickness_.minCoeff(); }
  double thickest() const { return thickness_.maxCoeff(); }

  /// Hash of all that its Green's functions depend on besides Young's modulus.
  std::uint64_t fingerprint(const ElasticModel& model) const;

 private:
  Eigen::Matrix3Xd thickness_;
  HeldComponents held_;
  bool isClamped_;
};

/// The same from parts.
/// @param ofModel  modelFingerprint.
std::uint64_t shellFingerprint(std::uint64_t ofModel, const Eigen::Matrix3Xd& thickness,
                               const HeldComponents& held);

}  // namespace palpate
