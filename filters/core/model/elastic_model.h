// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>
#include <Eigen/Core>
#include <memory>

#include "mesh/rims.h"
#include "mesh/surface_mesh.h"
#include "model/boundary_conditions.h"
#include "model/material.h"

namespace palpate {

/// Which side of the surface the material fills.
enum class Domain {
  Interior,
  Exterior,     ///< infinite space around the surface; needs no support, as displacements fade away
  HalfSpace,    ///< all below the plane that the surface is a part of; needs no support
  Shell,        ///< a thin layer about the surface, its middle; what holds it, ThinShell says
  Given,        ///< whatever a given matrix is of: holds itself, and the surface may have rims
  Unsupported,  ///< inside, and nothing holds the body: see removeRigidMotions
};

/// Whether the surface of a domain may end.
constexpr Rims rimsOf(Domain domain) {
  return domain == Domain::Interior || domain == Domain::Exterior || domain == Domain::Unsupported
             ? Rims::Refused
             : Rims::Allowed;
}

/// A reference boundary value problem: surface, material, and what is given where ([JP01] section
/// 4.1).
class ElasticModel {
 public:
  /// @param smoothPatches  #F numbers of the smooth patches across whose borders traction may jump
  ///                       (see findSmoothPatches).
  /// @throws std::invalid_argument if sizes differ, if no node is free, if the support leaves a
  ///         rigid motion of an interior domain's body free, if an exterior domain has nested
  ///         shells, if a surface of those has rims, if a half-space or an unsupported body has a
  ///         fixed node, or if a half-space has a surface that is not flat (planeOf). A shell's
  ///         support is for ThinShell to check.
  ElasticModel(std::shared_ptr<const SurfaceMesh> mesh, Material material,
               BoundaryConditions conditions, Eigen::VectorXi smoothPatches,
               Domain domain = Domain::Interior);

  const SurfaceMesh& mesh() const { return *mesh_; }
  const std::shared_ptr<const SurfaceMesh>& sharedMesh() const { return mesh_; }
  const Material& material() const { return material_; }
  const BoundaryConditions& conditions() const { return conditions_; }
  const Eigen::VectorXi& smoothPatches() const { return smoothPatches_; }
  Domain domain() const { return domain_; }

  /// modelFingerprint of its parts.
  std::uint64_t fingerprint() const;

 private:
  void requireNoneFixed(const char* reason) const;

  std::shared_ptr<const SurfaceMesh> mesh_;
  Material material_;
  BoundaryConditions conditions_;
  Eigen::VectorXi smoothPatches_;
  Domain domain_;
};

/// The model with smooth patches that end at the rim of its support (splitAtSupport).
ElasticModel withSupportPatch(const ElasticModel& model);

/// Hash of what Green's functions depend on besides Young's modulus, which only scales them:
/// points, triangles, boundary types, smooth patches, Poisson's ratio, domain.
std::uint64_t modelFingerprint(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                               const Eigen::VectorXi& smoothPatches, double poissonRatio,
                               Domain domain);

/// Sentences, each with its measured number, about what makes a model's answers doubtful: walls too
/// thin for linear triangles and supports too small for the mesh.
/// @param wallRatio     set to the largest edge length over wall thickness, -1 if not measured.
/// @param supportWidth  set to the narrowest body's support width in edges, -1 without supports.
std::vector<std::string> modelWarnings(const ElasticModel& model, double& wallRatio,
                                       double& supportWidth);

/// Those about supports alone.
std::vector<std::string> supportWarnings(const ElasticModel& model, double& supportWidth);

}  // namespace palpate
