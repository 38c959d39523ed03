// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cmath>
#include <Eigen/Dense>
#include <memory>
#include <utility>
#include <vector>

#include "contact/point_contact.h"

namespace palpate::test {

/// #V: the mask of a point, 1/m^2.
inline Eigen::VectorXd densityOf(const SurfaceStiffness& stiffness, const SurfacePoint& point) {
  Eigen::VectorXd density = Eigen::VectorXd::Zero(stiffness.mesh().vertexCount());
  for (int k = 0; k < 3; ++k) {
    const VertexMask& mask = stiffness.mask(stiffness.mesh().triangles()(k, point.triangle));
    for (std::size_t m = 0; m < mask.nodes.size(); ++m)
      density[mask.nodes[m]] += point.barycentric[k] * mask.density[m];
  }
  return density;
}

/// Mean of a field under the mask of a point: the barycentric average of its free corners' masks.
inline Eigen::Vector3d meanUnderMask(const SurfaceStiffness& stiffness, const SurfacePoint& point,
                                     const Eigen::Matrix3Xd& field) {
  return field * stiffness.mesh().vertexAreas().cwiseProduct(densityOf(stiffness, point));
}

/// Mean displacement at one point under a unit force at another, by the whole body's deformation.
inline Eigen::Matrix3d meanCompliance(const std::shared_ptr<const SurfaceStiffness>& stiffness,
                                      const SurfacePoint& to, const SurfacePoint& from) {
  const PointContact contact(stiffness, from);
  Eigen::Matrix3d compliance;
  Eigen::Matrix3Xd displacement, traction;
  for (int c = 0; c < 3; ++c) {
    contact.deform(Eigen::Vector3d::Unit(c), displacement, traction);
    compliance.col(c) = meanUnderMask(*stiffness, to, displacement);
  }
  return compliance;
}

/// The square root of a positive semidefinite matrix.
inline Eigen::Matrix3d rootOf(const Eigen::Matrix3d& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen((matrix + matrix.transpose()) / 2);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() *
         eigen.eigenvectors().transpose();
}

/// What a stiffness and a share of it each add up to.
using Shares = std::vector<std::pair<std::shared_ptr<const SurfaceStiffness>, double>>;

/// C_ij as PointCoupling states it, by fields on the whole surface.
inline Eigen::Matrix3d coupledCompliance(const Shares& shares, const SurfacePoint& i,
                                         const Eigen::Matrix3d& servedAtI, const SurfacePoint& j,
                                         const Eigen::Matrix3d& servedAtJ) {
  const auto mean = [&](const SurfacePoint& to, const SurfacePoint& from) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const auto& [stiffness, share] : shares)
      sum += share * meanCompliance(stiffness, to, from);
    return sum;
  };
  const auto product = [&](const SurfacePoint& one, const SurfacePoint& other) {
    double sum = 0;
    for (const auto& [stiffness, share] : shares)
      sum += share * (stiffness->mesh().vertexAreas().array() * densityOf(*stiffness, one).array() *
                      densityOf(*stiffness, other).array())
                         .sum();
    return sum;
  };
  const double cosine = product(i, j) / std::sqrt(product(i, i) * product(j, j));
  return mean(i, j) + cosine * cosine * rootOf(servedAtI.inverse() - mean(i, i)) *
                          rootOf(servedAtJ.inverse() - mean(j, j));
}

}  // namespace palpate::test
