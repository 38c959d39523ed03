// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/coulomb_slip.h"

#include <cmath>
#include <Eigen/Geometry>

namespace palpate {
namespace {

constexpr double kOnTheCone = 1e-9;  ///< of |f|: an excess that is rounding

/// K_tt in its principal axes, and what goes with it.
struct TangentPlane {
  TangentPlane(const Eigen::Matrix3d& stiffness, const Eigen::Vector3d& normal,
               const Eigen::Vector3d& force) {
    const Eigen::Vector3d one = normal.unitOrthogonal(), two = normal.cross(one);
    const Eigen::Vector3d k1 = stiffness * one, k2 = stiffness * two;
    const double a = one.dot(k1), b = one.dot(k2), c = two.dot(k2);
    const double angle = std::atan2(2 * b, a - c) / 2;
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const double spread = std::hypot((a - c) / 2, b);
    axes << cosine * one + sine * two, cosine * two - sine * one;
    stiff = {(a + c) / 2 + spread, (a + c) / 2 - spread};
    across = axes.transpose() * force;
    pressing = -normal.dot(force);
    const Eigen::Vector2d coupled(normal.dot(k1), normal.dot(k2));
    coupling = {cosine * coupled[0] + sine * coupled[1], cosine * coupled[1] - sine * coupled[0]};
  }
  /// d for s = stiff[0] q / (1 - q), from free sliding at q = 0 to none at q = 1.
  Eigen::Vector2d slip(double q) const {
    return across.cwiseQuotient((1 - q) * stiff + Eigen::Vector2d::Constant(q * stiff[0])) *
           (1 - q);
  }
  double pressingAfter(const Eigen::Vector2d& slip) const { return pressing + coupling.dot(slip); }
  /// s |d| - mu f_n(d): negative within the cone.
  double excess(double q, double mu) const {
    const Eigen::Vector2d left =
        across.cwiseQuotient((1 - q) * stiff + Eigen::Vector2d::Constant(q * stiff[0])) *
        (q * stiff[0]);
    return left.norm() - mu * pressingAfter(slip(q));
  }

  Eigen::Matrix<double, 3, 2> axes;
  Eigen::Vector2d stiff, across;  ///< eigenvalues of K_tt, the larger one first; f_t
  Eigen::Vector2d coupling;       ///< f_n grows by coupling . d
  double pressing;                ///< f_n
};

/// The q in [0, 1] where the excess vanishes, by false position with the Illinois rule.
/// @param low   excess at q = 0, < 0.
/// @param high  excess at q = 1, > 0.
double onTheCone(const TangentPlane& plane, double mu, double low, double high, double size) {
  double below = 0, above = 1, q = 0;
  int lastSide = 0;
  for (int i = 0; i < 50; ++i) {
    q = (below * high - above * low) / (high - low);
    const double excess = plane.excess(q, mu);
    if (std::abs(excess) <= 1e-12 * size) break;
    if (excess < 0) {
      below = q;
      low = excess;
      if (lastSide < 0) high /= 2;
      lastSide = -1;
    } else {
      above = q;
      high = excess;
      if (lastSide > 0) low /= 2;
      lastSide = 1;
    }
  }
  return q;
}

}  // namespace

CoulombSlip coulombSlip(const Eigen::Matrix3d& stiffness, const Eigen::Vector3d& normal,
                        const Eigen::Vector3d& stretch, double mu) noexcept {
  const Eigen::Vector3d force = stiffness * stretch;
  const TangentPlane plane(stiffness, normal, force);
  const double size = force.norm(), excess = plane.across.norm() - mu * plane.pressing;
  const double relative = size > 0 ? excess / size : 0;
  if (plane.pressing >= 0 && relative <= kOnTheCone)
    return {Friction::Sticks, Eigen::Vector3d::Zero(), relative};
  const Eigen::Vector2d free = plane.slip(0);
  if (!(plane.pressingAfter(free) > 0)) return {Friction::LetsGo, plane.axes * free, relative};
  const double low = plane.excess(0, mu);
  const double q = low < 0 ? onTheCone(plane, mu, low, excess, size) : 0;
  return {Friction::Slips, plane.axes * plane.slip(q), relative};
}

}  // namespace palpate
