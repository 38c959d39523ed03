// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/elastic_model.h"
#include "model/elasticity.h"

namespace palpate {

/// How much a surface is stretched and turned, a triangle each.
struct DisplacementGradients {
  std::vector<Eigen::Matrix3d> gradient;  ///< du_i / dx_k along the surface: times its normal zero
  double largest = 0;                     ///< the largest spectral norm of all
  int triangle = 0;                       ///< where that is

  /// What linear theory leaves out of a strain is half the gradient's square: at this gradient 5 %
  /// of it. From there on its answers are no longer to be trusted.
  static constexpr double kTrusted = 0.1;
};

/// Of displacements that are linear in each triangle, along the surface.
/// @param displacement  3 by #V, m.
/// @throws std::invalid_argument if the size differs.
DisplacementGradients surfaceGradients(const SurfaceMesh& mesh,
                                       const Eigen::Matrix3Xd& displacement);

/// The whole displacement gradient and the stress at the surface, a triangle each.
struct SurfaceFields {
  std::vector<Eigen::Matrix3d> gradient, stress;  ///< 1 and Pa
};

/// Stress recovery at the surface of a homogeneous isotropic body: along the surface the gradient
/// of the displacement, out of it what the traction t asks for, with normal n, G the gradient along
/// the surface and d = du/dn
///     G_shear d + (lambda + G_shear) (n . d) n = t - lambda tr(G) n - G_shear G^T n;
/// the part of the stress that is alike in all directions follows from t . n, so that nothing is
/// lost up to nu = 0.5. Of the first order in the edges.
/// @param displacement, traction  3 by #V, m and Pa: at fixed vertices area times traction is the
///                                reaction.
/// @throws std::invalid_argument if sizes differ.
SurfaceFields surfaceFields(const ElasticModel& model, const Eigen::Matrix3Xd& displacement,
                            const Eigen::Matrix3Xd& traction);

/// The same of a body of any materials, by the materials behind its triangles: with the stiffness C
/// and the derivative d along the normal, C (sym(G + d n^T)) n = t, and where a material is split
/// its pressure with the change of volume.
/// @param materials  #F, Pa.
SurfaceFields surfaceFields(const ElasticModel& model, const std::vector<Elasticity>& materials,
                            const Eigen::Matrix3Xd& displacement, const Eigen::Matrix3Xd& traction);

/// The largest singular value.
double spectralNorm(const Eigen::Matrix3d& gradient);

/// Of a symmetric stress.
double vonMisesStress(const Eigen::Matrix3d& stress);

/// Largest first.
Eigen::Vector3d principalStresses(const Eigen::Matrix3d& stress);

}  // namespace palpate
