// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/sliding_contact.h"

#include <algorithm>
#include <Eigen/Eigenvalues>
#include <stdexcept>

namespace palpate {
namespace {

constexpr int kMostSlides = 6;     ///< a tick
constexpr int kMostSteps = 64;     ///< from edge to edge, a slide
constexpr int kHalvings = 24;      ///< of the last step's length
constexpr double kSettled = 1e-6;  ///< excess over |f| that is left to the next tick
constexpr double kVanishingNormal = 1e-6;
constexpr double kStill = 0.1;  ///< of the relaxation: what is less in a tick is no way
constexpr double kLift = 1e-9;  ///< of the diagonal: what is outside for certain

double spectralNorm(const Eigen::Matrix3d& symmetric) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(symmetric, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()[2];
}

/// Interpolated over the point's triangle.
Eigen::Vector3d normalAt(const SurfaceMesh& mesh, const SurfacePoint& point) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k)
    normal += point.barycentric[k] * mesh.vertexNormals().col(mesh.triangles()(k, point.triangle));
  const double size = normal.norm();
  if (size < kVanishingNormal) return mesh.triangleNormals().col(point.triangle);
  return normal / size;
}

}  // namespace

SlidingContact::SlidingContact(std::shared_ptr<const SurfaceStiffness> stiffness,
                               std::shared_ptr<const TouchedSurface> surface)
    : stiffness_(std::move(stiffness)),
      former_(stiffness_),
      surface_(std::move(surface)),
      relaxation_(kRelaxedEdges * stiffness_->mesh().meanEdgeLength()) {
  if (&stiffness_->mesh() != &surface_->walk.mesh())
    throw std::invalid_argument("the stiffness is that of another mesh than the one to be touched");
}

void SlidingContact::setStiffness(std::shared_ptr<const SurfaceStiffness> stiffness) noexcept {
  former_ = std::move(stiffness_);
  stiffness_ = std::move(stiffness);
  blendLeft_ = kBlendTicks;
}

void SlidingContact::reset() noexcept {
  phase_ = Phase::Unknown;
  hasPlace_ = false;
  force_.setZero();
  norm_ = excess_ = 0;
  slides_ = 0;
  isHeldBack_ = isStuck_ = isUnserved_ = startedInside_ = false;
}

Eigen::Matrix3d SlidingContact::stiffnessAt(int triangle,
                                            const Eigen::Vector3d& barycentric) const noexcept {
  const Eigen::Matrix3d stiffness = stiffness_->hapticAt(triangle, barycentric);
  if (!isChanging()) return stiffness;
  const double share = changed();
  return share * stiffness + (1 - share) * former_->hapticAt(triangle, barycentric);
}

void SlidingContact::arrive(const SurfacePoint& point, const Eigen::Matrix3d& stiffness) noexcept {
  const SurfaceMesh& mesh = surface_->walk.mesh();
  point_ = point;
  here_ = stiffness;
  staticPoint_ = placeOf(mesh, point);
  normal_ = normalAt(mesh, point);
}

const Eigen::Vector3d& SlidingContact::advance(const Eigen::Vector3d& probe,
                                               const Eigen::Vector3d& shift) noexcept {
  const Eigen::Vector3d place = probe - shift;
  if (!place.allFinite()) {
    reset();
    return force_;
  }
  const double way = isTouching() ? (place - place_).norm() : (probe - probe_).norm();
  const double step = (hasPlace_ ? way : 0) + relaxation_;
  slides_ = 0;
  excess_ = 0;
  isHeldBack_ = isStuck_ = isUnserved_ = startedInside_ = false;

  double ofChange = 0;
  if (isChanging()) {
    --blendLeft_;
    const Eigen::Matrix3d before = here_;
    here_ = stiffnessAt(point_.triangle, point_.barycentric);
    if (isTouching()) ofChange = ((here_ - before) * (place_ - staticPoint_)).norm();
  }
  Eigen::Vector3d last = Eigen::Vector3d::Zero(), force = last;
  if (isTouching()) {
    norm_ = spectralNorm(here_);
    last = here_ * (place_ - staticPoint_);
  } else if (begin(place)) {
    const double norm = spectralNorm(here_);
    norm_ = force_.isZero(0) ? norm : std::max(norm_, norm);
  }
  const double limit = kContinuity * norm_ * step;
  if (isTouching()) {
    const Eigen::Vector3d from = staticPoint_;
    slide(place, last, limit);
    isStuck_ = isHeldBack_ && (staticPoint_ - from).norm() < kStill * relaxation_;
    if (!isTouching() && surface_->locator.isInside(place)) {
      // As in a hollow, where it is above x^C's tangent plane but below the surface ahead of it.
      touch(surface_->locator.nearest(place));
      if (isTouching() && slipAt(place).friction == Friction::LetsGo) end();
    }
    if (isTouching()) {
      force = here_ * (place - staticPoint_);
      // Held back, x^C may be where the force that it is on its way to would pull.
      if (!adheres_) force -= std::max(0., normal_.dot(force)) * normal_;
    } else {
      norm_ = spectralNorm(here_);
    }
  }
  const double jump = (force - force_).norm();
  if (jump <= limit + ofChange)
    force_ = force;
  else
    force_ += (limit + ofChange) / jump * (force - force_);
  place_ = place;
  probe_ = probe;
  hasPlace_ = true;
  return force_;
}

/// Whether the way from a place outside to this one touches the surface, or the first place there
/// is lies inside.
bool SlidingContact::begin(const Eigen::Vector3d& place) noexcept {
  if (phase_ != Phase::Outside) {
    if (surface_->locator.isInside(place)) {
      if (phase_ == Phase::Unserved) return false;
      touch(surface_->locator.nearest(place));
      return startedInside_ = isTouching();
    }
    phase_ = Phase::Outside;
    outside_ = place;
    return false;
  }
  const std::optional<SurfacePoint> entry = surface_->locator.firstEntry(outside_, place);
  if (!entry) {
    outside_ = place;
    return false;
  }
  touch(*entry);
  return isTouching();
}

/// Begins contact at a place of the surface, if that has a stiffness.
void SlidingContact::touch(const SurfacePoint& point) noexcept {
  const Eigen::Matrix3d stiffness = stiffnessAt(point.triangle, point.barycentric);
  isUnserved_ = !stiffness.allFinite();
  phase_ = isUnserved_ ? Phase::Unserved : Phase::Touching;
  if (!isUnserved_) arrive(point, stiffness);
}

/// Lets x^C slip until the force is on the cone, or lets go.
void SlidingContact::slide(const Eigen::Vector3d& place, const Eigen::Vector3d& last,
                           double limit) noexcept {
  if (adheres_) return;
  // A contact that begins may already be beyond the limit; it need not leave that by slipping.
  limit = std::max(limit, (here_ * (place - staticPoint_) - last).norm());
  CoulombSlip slip = slipAt(place);
  while (slip.friction != Friction::Sticks && !isHeldBack_ && slides_ < kMostSlides &&
         !(slides_ > 0 && slip.friction == Friction::Slips && slip.excess <= kSettled)) {
    const SurfacePoint start = point_;
    const Eigen::Matrix3d stiffness = here_;
    const CoulombSlip from = slip;
    for (double share = 1;;) {
      isHeldBack_ = !follow(share * from.displacement, place, last, limit);
      ++slides_;
      slip = slipAt(place);
      // Where K varies it may have slipped too far, into the cone: then back to its rim.
      if (from.friction != Friction::Slips || slip.friction != Friction::Sticks ||
          slip.excess >= -kSettled || slides_ == kMostSlides)
        break;
      share *= from.excess / (from.excess - slip.excess);
      arrive(start, stiffness);
    }
  }
  excess_ = std::max(0., slip.excess);
  if (slip.friction == Friction::LetsGo) end();
}

/// What friction asks of x^C where it is.
CoulombSlip SlidingContact::slipAt(const Eigen::Vector3d& place) const noexcept {
  return coulombSlip(here_, normal_, place - staticPoint_, friction_);
}

void SlidingContact::end() noexcept {
  const SurfaceMesh& mesh = surface_->walk.mesh();
  phase_ = Phase::Outside;
  outside_ = staticPoint_ + kLift * mesh.diagonal() * mesh.triangleNormals().col(point_.triangle);
}

/// Moves x^C along a way over the surface, as far as the force stays within a limit from the last
/// tick's. Within a triangle K and x are linear along the way.
/// @return  whether it went all the way.
bool SlidingContact::follow(const Eigen::Vector3d& displacement, const Eigen::Vector3d& place,
                            const Eigen::Vector3d& last, double limit) noexcept {
  const SurfaceMesh& mesh = surface_->walk.mesh();
  SurfaceWalk::Walker walker = surface_->walk.start(point_, displacement);
  Eigen::Matrix3d from = here_;
  Eigen::Vector3d stretch = place - staticPoint_;
  for (int steps = 0; !walker.hasArrived(); ++steps) {
    const SurfacePoint start = walker.point;
    if (steps == kMostSteps) {
      arrive(start, from);
      return false;
    }
    const Eigen::Vector3d end = surface_->walk.step(walker);
    const Eigen::Matrix3d to = stiffnessAt(start.triangle, end);
    const Eigen::Vector3d stretchAtEnd = place - placeOf(mesh, {start.triangle, end});
    if ((to * stretchAtEnd - last).norm() <= limit) {
      from = to;
      stretch = stretchAtEnd;
      continue;
    }
    // The surface may have no stiffness ahead (NaN): then no share but zero will do.
    double share = 0;
    const Eigen::Matrix3d change = to - from;
    const Eigen::Vector3d way = stretchAtEnd - stretch;
    for (double half = 0.5; half > std::ldexp(0.5, -kHalvings); half /= 2) {
      const double tried = share + half;
      const Eigen::Vector3d force = (from + tried * change) * (stretch + tried * way);
      if ((force - last).norm() <= limit) share = tried;
    }
    if (share == 0)
      arrive(start, from);
    else
      arrive({start.triangle, start.barycentric + share * (end - start.barycentric)},
             from + share * change);
    return false;
  }
  arrive(walker.point, from);
  return true;
}

}  // namespace palpate
