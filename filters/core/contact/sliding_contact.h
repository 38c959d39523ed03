// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <memory>

#include "contact/coulomb_slip.h"
#include "contact/sliding_state.h"
#include "contact/surface_stiffness.h"

namespace palpate {

/// A probe's tip on an elastic surface: it pushes, sticks, slides and pulls ([JP01] sections 6.3 to
/// 7 and fig. 8). The contact is found where the probe's way x^H enters the undeformed body, or
/// nearest to where the way begins, if that is inside, and is tracked from there on in surface
/// coordinates, x^C, face to face; the force on the body is that of the place, f = K^H(x^C) (x^H -
/// x^C). All of it happens on the undeformed surface; its parametric image under f is the god
/// object x^E (PointContact::push at `point()`).
///
/// Friction is Coulomb's, |f_t| <= mu f_n, about the vertices' interpolated normals (the triangle's
/// where they vanish): within the cone x^C sticks, beyond it slips (coulombSlip, walked over the
/// surface and repeated where normal and stiffness have changed on the way). With adhesion x^C
/// sticks whatever the force. The contact ends when the probe is above the tangent plane and no
/// longer within the cone; if it is inside the body all the same, as in a hollow, x^C goes on from
/// the point nearest to it.
///
/// Continuity. Whatever the mesh, the force served changes in a tick by at most
///     kContinuity |K| (|step of x^H| + relaxation()) + |change of K| |u|,
/// |K| the spectral norm of K^H where x^C starts (where it enters, if contact begins; where it
/// ended, while a lost contact's force fades). If x^C stays, the force changes by |K| |step|; so
/// x^C slides only as far as the force stays within the bound, and goes on in the next tick, by the
/// relaxation's share even if the probe rests. Losing contact obeys the same bound: what is left of
/// the force fades. Meanwhile what would pull of the force is not served. A change of friction is
/// not felt but through slipping; a change of stiffness is spread over kBlendTicks ticks.
///
/// Energy. A tick from (x^C_0, u_0, K_0) to (x^C_1, u_1, K_1) costs the hand the work
///     (f_0 + f_1) / 2 . dx^H = [u^T K u / 2] + (f_0 + f_1) / 2 . dx^C - u_0^T dK u_1 / 2,
/// and slipping costs f_t . dx^C >= 0. So a closed path gives back at most
///     sum of |u_0^T dK u_1| / 2 + sum of f_n |n . dx^C|:
/// half of what the stiffness varies by along the way times the depth squared (as much as that of a
/// body that is stiffer here than there), and what the interpolated normals n differ from the
/// triangles' by, which vanishes as these get smaller. A contact that sticks gives back nothing.
///
/// Displacement by other forces. Where these displace the surface at x^C by d,
///     f = K^H(x^C) (x^H - d - x^C):
/// all of the above holds with x^H - d for x^H. A contact that begins does not count the d that it
/// begins with as a step.
///
/// One thread advances it. Nothing here but construction allocates, locks or throws.
class SlidingContact : private SlidingState {
 public:
  static constexpr double kContinuity = 1;
  static constexpr double kRelaxedEdges = 2e-3;  ///< relaxation() over the mean edge length
  static constexpr int kBlendTicks = 100;

  /// @param surface  of the stiffness's mesh.
  /// @throws std::invalid_argument if it is of another one.
  SlidingContact(std::shared_ptr<const SurfaceStiffness> stiffness,
                 std::shared_ptr<const TouchedSurface> surface);

  /// @param mu  >= 0.
  void setFriction(double mu) noexcept { friction_ = mu; }
  double friction() const noexcept { return friction_; }

  /// Whether x^C sticks whatever the force, so that the probe pulls.
  void setAdhesion(bool adheres) noexcept { adheres_ = adheres; }

  /// Goes over to another stiffness of the same mesh. To be called when `isChanging()` is over
  /// only. The one before is let go of when this returns; who must not free memory here keeps it
  /// elsewhere.
  void setStiffness(std::shared_ptr<const SurfaceStiffness> stiffness) noexcept;
  bool isChanging() const noexcept { return blendLeft_ > 0; }
  /// Share of the stiffness set last in what is served.
  double changed() const noexcept { return double(kBlendTicks - blendLeft_) / kBlendTicks; }
  const SurfaceStiffness& stiffness() const noexcept { return *stiffness_; }

  /// Moves the probe.
  /// @param place  x^H, m, in the mesh's frame. One that is not finite ends the contact.
  /// @param shift  d, m, at `point()`, or where contact will begin.
  /// @return  the force on the body, N.
  const Eigen::Vector3d& advance(const Eigen::Vector3d& place,
                                 const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) noexcept;

  /// To take back a tick that was tried.
  const SlidingState& state() const noexcept { return *this; }
  void recall(const SlidingState& state) noexcept { static_cast<SlidingState&>(*this) = state; }

  /// Forgets the contact and what is left of its force. A probe that is within the body then
  /// touches the place of the surface nearest to it, with a force that grows from zero.
  void reset() noexcept;

  bool isTouching() const noexcept { return phase_ == Phase::Touching; }
  /// x^C; of the last contact while there is none.
  const SurfacePoint& point() const noexcept { return point_; }
  const Eigen::Vector3d& staticPoint() const noexcept { return staticPoint_; }
  const Eigen::Vector3d& normal() const noexcept { return normal_; }
  /// On the body: K^H u, but while x^C is held back or the rest of a lost contact fades.
  const Eigen::Vector3d& force() const noexcept { return force_; }
  /// K^H at x^C as it is served, N/m.
  const Eigen::Matrix3d& servedStiffness() const noexcept { return here_; }
  /// m a tick: how far a resting probe's contact settles.
  double relaxation() const noexcept { return relaxation_; }

  // The last tick:
  bool isSliding() const noexcept { return slides_ > 0; }
  int slideCount() const noexcept { return slides_; }
  /// (|f_t| - mu f_n) / |f|, 0 within the cone.
  double coneExcess() const noexcept { return excess_; }
  /// Whether x^C has not gone as far as it should.
  bool wasHeldBack() const noexcept { return isHeldBack_; }
  /// Whether it has been held back and has gone nowhere, as before a place without stiffness.
  bool isStuck() const noexcept { return isStuck_; }
  /// Whether contact began with the probe's first place, inside the body.
  bool startedInside() const noexcept { return startedInside_; }
  /// Whether it entered where the surface has no stiffness: then it feels nothing until it has
  /// left.
  bool isUnserved() const noexcept { return isUnserved_; }

 private:
  bool begin(const Eigen::Vector3d& place) noexcept;
  void touch(const SurfacePoint& point) noexcept;
  void end() noexcept;
  CoulombSlip slipAt(const Eigen::Vector3d& place) const noexcept;
  void slide(const Eigen::Vector3d& place, const Eigen::Vector3d& last, double limit) noexcept;
  bool follow(const Eigen::Vector3d& displacement, const Eigen::Vector3d& place,
              const Eigen::Vector3d& last, double limit) noexcept;
  Eigen::Matrix3d stiffnessAt(int triangle, const Eigen::Vector3d& barycentric) const noexcept;
  void arrive(const SurfacePoint& point, const Eigen::Matrix3d& stiffness) noexcept;

  std::shared_ptr<const SurfaceStiffness> stiffness_, former_;
  std::shared_ptr<const TouchedSurface> surface_;
  double relaxation_, friction_ = 0;
  bool adheres_ = false;
};

}  // namespace palpate
