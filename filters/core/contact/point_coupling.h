// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <array>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <vector>

#include "contact/surface_stiffness.h"
#include "mesh/surface_point.h"

namespace palpate {

/// What points on one surface yield by under each other's forces: the blocks of C between tools
/// ([JP01] section 5.3), m/N,
///     C_ij = sum over nodes m, n of a_m rho^i_m Xi_mn rho^j_n,
/// with rho^i the barycentric average of the masks of the corners of i's triangle: C_ij f_j is the
/// mean displacement under the mask of i, on which the force of i does its work. C_ji = C_ij^T, so
/// that all forces are those of one energy. A corner that is fixed neither moves nor presses.
///
/// A point itself yields by K_i^-1, which is D_i more than by the mean under its own mask, C_ii:
/// stiffnesses are by the vertices' displacements. As far as masks overlap, the other point's
/// surface yields by that, too: s_ij^2 sqrt(D_i) sqrt(D_j) is added to C_ij, with
///     s_ij = <rho^i, rho^j> / |rho^i| |rho^j|, by area.
/// So two points at one place yield as one does, and all together have a positive semidefinite
/// compliance, a sum of two Gram matrices (products of the entries of such are such, by Schur). The
/// square is what comes nearest to the displacement of one point's vertex under the mask of
/// another: on a sphere within 10 % at all distances, where the mean alone is off by 20 % at small
/// ones.
///
/// Points that press each other's masks can be less stiff together than interpolated stiffnesses
/// tell. So that the compliance of all, K_i^-1 and these blocks, stays positive definite, all
/// blocks are lowered by one factor where the least eigenvalue of all L_i^T C_ij L_j (L L^T = K, no
/// blocks on the diagonal) is below -kLargestShare. Two points reach that where their masks cover
/// each other almost.
///
/// A change of a triangle costs the blocks between the masks of its new corners and those of the
/// corners of all other points; a change within a triangle nothing but weights; and what does not
/// change nothing. Of one thread. Nothing but construction allocates or throws.
class PointCoupling {
 public:
  static constexpr double kLargestShare = 0.95;

  /// @param stiffness  must outlive its use, as must those of setStiffness.
  PointCoupling(const SurfaceStiffness& stiffness, int pointCount);

  /// Goes over to another stiffness of the same mesh, while `setShare` is 1.
  void setStiffness(const SurfaceStiffness& stiffness) noexcept;
  /// The share of the stiffness set last; the rest is of the one before.
  void setShare(double share) noexcept;

  /// Puts a point on the surface.
  /// @param served  its stiffness, N/m.
  void place(int point, const SurfacePoint& place, const Eigen::Matrix3d& served) noexcept;
  /// Takes it away from there.
  void remove(int point) noexcept { points_[point].isPlaced = false; }
  bool isPlaced(int point) const noexcept { return points_[point].isPlaced; }

  /// Lowers the blocks of the present places as need be. Called once a tick, so that the factor is
  /// the same in all that a tick tries.
  void limit() noexcept;

  /// Mean displacement under the mask of a point by the forces of all others, m.
  /// @param forces  3 #points, N, on the body; those of points not placed do not count.
  Eigen::Vector3d shift(int point, const Eigen::VectorXd& forces) noexcept;

  /// C_ij as it is used, of two points that are placed.
  Eigen::Matrix3d block(int i, int j) noexcept;

 private:
  /// Between the corners of two triangles.
  struct Corners {
    int first = -1, second = -1;  ///< triangles
    std::array<Eigen::Matrix3d, 9> blocks;
    std::array<double, 9> overlaps;  ///< of the corners' masks, 1/m^2
  };
  /// A point, and whether it has changed since its blocks were made.
  struct Point {
    bool isPlaced = false, isChanged = false;
    SurfacePoint place{-1, Eigen::Vector3d::Zero()};
    Eigen::Matrix3d served = Eigen::Matrix3d::Zero();
    std::array<Corners, 2> own;  ///< its corners among each other, as a Pair's
    Eigen::Matrix3d excess;      ///< sqrt(D), where masks overlap
    bool hasExcess = false;      ///< whether that is up to date
  };
  struct Pair {
    std::array<Corners, 2> corners;  ///< of the stiffness set last, and of the one before
    Eigen::Matrix3d block;           ///< C_ij
    Eigen::Matrix3d scaled;          ///< L_i^T C_ij L_j
  };

  Pair& pair(int i, int j) noexcept { return pairs_[j * (j - 1) / 2 + i]; }
  void update() noexcept;
  double leastEigenvalue() noexcept;
  void renew(Pair& pair, Point& i, Point& j) noexcept;
  void lookUp(int version, Corners& corners, const Point& i, const Point& j) noexcept;
  Eigen::Matrix3d mean(std::array<Corners, 2>& corners, const Point& i, const Point& j) noexcept;
  template <class Act>
  void forCorners(const Point& i, const Point& j, const Act& act) const noexcept;
  double overlap(const std::array<Corners, 2>& corners, const Point& i,
                 const Point& j) const noexcept;
  const Eigen::Matrix3d& excessOf(Point& point) noexcept;

  std::array<const SurfaceStiffness*, 2> stiffness_;  ///< set last, and the one before
  double share_ = 1;
  double scale_ = 1;  ///< that all blocks are lowered by
  std::vector<Point> points_;
  std::vector<Pair> pairs_;  ///< i < j
  Eigen::MatrixXd scaled_;   ///< of all points
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen_;
};

}  // namespace palpate
