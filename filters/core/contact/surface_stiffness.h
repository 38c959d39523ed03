// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "contact/pressure_mask.h"
#include "greens/greens_functions.h"
#include "progress.h"

namespace palpate {

/// What of the displacement a point-like contact goes by.
enum class DisplacementMeasure {
  /// The vertex's own, u_i = B f (eq. 32). B is not symmetric: what is served is the S nearest to
  /// it. It says where the material under a probe's tip is: under a Hertzian mask of the contact's
  /// radius it is a sphere's F / delta by Hertz, of which the mean makes 5 / 4. It is also the
  /// smoother of the two, as the mean counts what single nodes yield by the square of the mask.
  Vertex,
  /// The mean under the same mask, sum of a_j rho_j u_j = M f: the displacement on which the mask's
  /// force does its work. M is symmetric by reciprocity, as it stands. It yields less, by a fourth
  /// under the linear mask, by a fifth under the Hertzian.
  Mean,
};

/// The compliance of a masked vertex, u_i = B f with B = sum over j of rho_j Xi_ij (eq. 32), and
/// the stiffness that is served, the inverse of a symmetric S.
///
/// B is no energy's second derivative, but the compliance of the mean displacement under the same
/// mask is one: M = sum over i of a_i rho_i times that of row i. S is the symmetric matrix nearest
/// to B in the sense that a displacement d under the force S^-1 d comes out as d: it makes |(B - S)
/// M^-1|_F least. In the principal axes of M its entries are those of B, each pair averaged with
/// the squares of both compliances as weights. (The plain mean would let a stiff direction push a
/// soft one: along the blade of a spatula, asked for 1 mm, by 2.6 mm across.)
///
/// In no direction is S less than half of M; where the mesh resolves a body and masks keep clear of
/// the support, vertices yield more than their surroundings and nothing changes. M in turn is at
/// least what the mask's nodes yield one by one, the sum of a_i rho_i^2 Xi_ii. Where a vertex still
/// went astray by more than it is asked for, |B S^-1 - 1| > 1, there is no stiffness to serve.
///
/// By the mean displacement S is M, and nothing is projected where the Green's functions are
/// reciprocal.
struct VertexStiffness {
  Eigen::Matrix3d stiffness;  ///< K^E, N/m, symmetric positive definite
  double asymmetry;           ///< |B - B^T|_F / |B|_F, or that of M, before symmetrising
  bool limited;               ///< whether S had to be raised in some direction
};

/// @param mask  of a free vertex, the vertex among its nodes.
/// @throws std::invalid_argument if a column is missing; std::runtime_error if S is not
///         positive definite all the same or leads astray, as on a surface that is inside out or
///         far too coarse.
VertexStiffness maskedVertexStiffness(const GreensFunctions& greens, int vertex,
                                      const VertexMask& mask,
                                      DisplacementMeasure measure = DisplacementMeasure::Vertex);

/// How the stiffnesses of a surface are made of its masks.
struct StiffnessOptions {
  /// k_Rigid of eq. 33 (N/m): the stiffness of fixed vertices, and the most that the haptic
  /// stiffness shows; 0 for the stiffest elastic vertex.
  double rigidStiffness = 0;
  DisplacementMeasure measure = DisplacementMeasure::Vertex;
};

/// Stiffnesses of all vertices, and by interpolation of every point of the surface ([JP01] sections
/// 6.2-6.4). Where maskedVertexStiffness throws (its mask needs columns that were not computed, or
/// the compliance is not positive definite) a vertex's stiffness is NaN.
class SurfaceStiffness {
 public:
  /// @param masks  of the mesh, under the Green's functions' conditions; not kept.
  /// @throws as maskedVertexStiffness if no vertex has a stiffness; std::invalid_argument for a
  ///         rigid stiffness that is negative or not finite, or for another surface's Green's
  ///         functions; Aborted.
  SurfaceStiffness(std::shared_ptr<const GreensFunctions> greens,
                   std::shared_ptr<const SurfaceMesh> mesh, const VertexMasks& masks,
                   const StiffnessOptions& options = {}, const ProgressCallback& progress = {});
  /// The same under the masks of a radius by straight distance, and by the vertices' displacement.
  SurfaceStiffness(std::shared_ptr<const GreensFunctions> greens,
                   std::shared_ptr<const SurfaceMesh> mesh, MaskShape shape, double radius,
                   double rigidStiffness = 0, const ProgressCallback& progress = {});

  const GreensFunctions& greens() const { return *greens_; }
  const SurfaceMesh& mesh() const { return *mesh_; }
  const std::shared_ptr<const SurfaceMesh>& sharedMesh() const { return mesh_; }

  /// The same under another rigid stiffness, as in the constructor. No stiffness is computed anew.
  std::shared_ptr<const SurfaceStiffness> withRigidStiffness(double rigidStiffness) const;

  /// The same body of another Young's modulus: its elastic stiffnesses, and the rigid one if that
  /// is the stiffest elastic vertex's, are scaled. Nothing is computed anew.
  /// @throws std::invalid_argument as Material.
  std::shared_ptr<const SurfaceStiffness> withYoungsModulus(double youngsModulus) const;

  /// @throws as maskedVertexStiffness if the vertex has no stiffness.
  void requireServed(int vertex) const;

  /// K_i: K^E where the vertex is free, k_Rigid times identity where it is fixed (eq. 32-33). N/m.
  const Eigen::Matrix3d& elastic(int vertex) const { return elastic_[vertex]; }
  /// eta_i = min(1, |K^R| / |K^E_i|), 1 where fixed (section 6.4).
  double hapticRatio(int vertex) const { return hapticRatio_[vertex]; }
  /// K^H_i = eta_i K^E_i.
  Eigen::Matrix3d haptic(int vertex) const { return hapticRatio_[vertex] * elastic_[vertex]; }
  /// The mask of a vertex; empty where it is fixed.
  const VertexMask& mask(int vertex) const { return (*masks_)[vertex]; }
  /// Asymmetry of a vertex's compliance before symmetrising; 0 where fixed.
  double asymmetry(int vertex) const { return asymmetry_[vertex]; }
  /// Whether a vertex's stiffness is that of the mean under its mask in some direction.
  bool isLimited(int vertex) const { return limited_[vertex]; }
  double rigidStiffness() const { return rigidStiffness_; }
  DisplacementMeasure measure() const { return measure_; }

  /// K(x) of eq. 34 at a point of a triangle; vertices without weight need not be served.
  /// @param barycentric  of the point, sum 1.
  Eigen::Matrix3d elasticAt(int triangle, const Eigen::Vector3d& barycentric) const noexcept;
  /// K^H(x), with |K^H(x)| <= |K^R|.
  Eigen::Matrix3d hapticAt(int triangle, const Eigen::Vector3d& barycentric) const noexcept;

 private:
  void setRigidStiffness(double rigidStiffness);

  std::shared_ptr<const GreensFunctions> greens_;
  std::shared_ptr<const SurfaceMesh> mesh_;
  DisplacementMeasure measure_;
  double givenRigidStiffness_, rigidStiffness_;
  std::vector<Eigen::Matrix3d> elastic_;
  std::vector<double> hapticRatio_, asymmetry_;
  std::vector<bool> limited_;
  std::shared_ptr<const std::vector<VertexMask>> masks_;
};

}  // namespace palpate
