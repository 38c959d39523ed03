// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/unilateral_contact.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

std::vector<std::shared_ptr<const GreensFunctions>> bodiesOf(
    std::shared_ptr<const GreensFunctions> greens, const std::vector<Obstacle>& obstacles) {
  std::vector bodies{std::move(greens)};
  for (const Obstacle& obstacle : obstacles)
    if (obstacle.greens) bodies.push_back(obstacle.greens);
  return bodies;
}

double rigidStiffnessOf(const GreensFunctions& greens, const SurfaceMesh& mesh,
                        const UnilateralContactSettings& settings) {
  return settings.rigidStiffness != 0
             ? settings.rigidStiffness
             : 10 * greens.info().material.youngsModulus() * mesh.meanEdgeLength();
}

/// Whether a contact has slid on by a part of a triangle that is worth telling apart.
bool differ(const ContactSite& a, const ContactSite& b) {
  constexpr double part = 0.02;
  for (int k = 1; k < a.count; ++k)
    if (a.parts[k].node != b.parts[k].node ||
        std::abs(a.parts[k].weight - b.parts[k].weight) > part)
      return true;
  return false;
}

void requireFriction(double friction) {
  if (!(friction >= 0))
    throw std::invalid_argument("a coefficient of friction must not be negative, as " +
                                std::to_string(friction) + " is");
}

void requireSurface(const GreensFunctions& greens, const SurfaceMesh& mesh) {
  if (greens.nodeCount() != mesh.vertexCount())
    throw std::invalid_argument("the Green's functions of " + std::to_string(greens.nodeCount()) +
                                " nodes are not of a surface of " +
                                std::to_string(mesh.vertexCount()) + " vertices");
}

}  // namespace

UnilateralContact::UnilateralContact(std::shared_ptr<const GreensFunctions> greens,
                                     std::shared_ptr<const SurfaceMesh> mesh,
                                     std::vector<Obstacle> obstacles,
                                     const UnilateralContactSettings& settings)
    : mesh_(std::move(mesh)),
      locator_(mesh_),
      settings_(settings),
      solver_(bodiesOf(greens, obstacles), rigidStiffnessOf(*greens, *mesh_, settings),
              settings.capacityFor(mesh_->vertexCount()), settings.solver) {
  requireSurface(*greens, *mesh_);
  if (obstacles.empty()) throw std::invalid_argument("there is nothing to touch the surface with");
  if (!(settings.margin >= 0) || !std::isfinite(settings.margin) || settings.linearisations < 1)
    throw std::invalid_argument(
        "a contact's margin must not be negative, and its gaps must be linearised at least once");
  margin_ = settings.margin > 0 ? settings.margin : mesh_->meanEdgeLength() / 2;
  int body = 0;
  for (Obstacle& obstacle : obstacles) {
    if (!obstacle.shape) throw std::invalid_argument("an obstacle has no shape");
    requireFriction(obstacle.friction);
    if (!obstacle.greens != !obstacle.mesh)
      throw std::invalid_argument("an elastic obstacle needs Green's functions and their surface");
    if (obstacle.greens) requireSurface(*obstacle.greens, *obstacle.mesh);
    MovingObstacle moving;
    moving.body = obstacle.greens ? ++body : 0;
    moving.obstacle = std::move(obstacle);
    moving.lookAt.assign(mesh_->vertexCount(), 0);
    moving.isWatched.assign(mesh_->vertexCount(), false);
    while (static_cast<int>(partOf_.size()) <= moving.obstacle.tool)
      partOf_.emplace_back(mesh_->vertexCount(), -1);
    obstacles_.push_back(std::move(moving));
  }
  taken_.resize(obstacles_.size());
  findLargeTriangles();
  anchors_.resize(capacity());
  isHeldVertex_.assign(mesh_->vertexCount(), false);
  holders_.assign(mesh_->vertexCount(), 0);
  holderOf_.assign(mesh_->vertexCount(), -1);
  loadedNodes_.resize(4 * std::size_t(capacity()));
  tractions_.setZero(12 * Eigen::Index(capacity()));
  centre_ = (mesh_->points().rowwise().minCoeff() + mesh_->points().rowwise().maxCoeff()) / 2;
  radius_ = (mesh_->points().colwise() - centre_).colwise().norm().maxCoeff();
}

void UnilateralContact::setFriction(int obstacle, double friction) {
  requireFriction(friction);
  obstacles_[obstacle].obstacle.friction = friction;
}

void UnilateralContact::setRigidStiffness(double stiffness) {
  if (!(stiffness >= 0) || !std::isfinite(stiffness))
    throw std::invalid_argument("the rigid stiffness must be at least 0 and finite, not " +
                                std::to_string(stiffness));
  settings_.rigidStiffness = stiffness;
  solver_.setRigidStiffness(rigidStiffnessOf(solver_.compliance().body(0), *mesh_, settings_));
}

void UnilateralContact::setStiffnessScale(double scale) {
  if (!(scale > 0) || !std::isfinite(scale))
    throw std::invalid_argument("a stiffness scale must be positive, not " + std::to_string(scale));
  stiffnessScale_ = scale;
}

void UnilateralContact::reset() noexcept {
  solver_.clear();
  loadCount_ = 0;
  for (MovingObstacle& moving : obstacles_) {
    moving.placed = false;
    std::fill(moving.isWatched.begin(), moving.isWatched.end(), false);
  }
  for (std::vector<int>& parts : partOf_) std::fill(parts.begin(), parts.end(), -1);
  std::fill(isHeldVertex_.begin(), isHeldVertex_.end(), false);
  std::fill(holders_.begin(), holders_.end(), 0);
  penetration_ = yielded_ = 0;
  isTruncated_ = false;
}

Proximity UnilateralContact::proximity(int obstacle, const Eigen::Vector3d& place) const noexcept {
  const MovingObstacle& moving = obstacles_[obstacle];
  Proximity near = moving.obstacle.shape->proximity(moving.pose.toOwn(place));
  near.normal = moving.pose.orientation * near.normal;
  return near;
}

Eigen::Vector3d UnilateralContact::restPlace(int contact) const noexcept {
  const ContactSite& where = site(contact);
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (int p = 0; p < where.count; ++p)
    if (where.parts[p].body == 0)
      place += where.parts[p].weight * mesh_->points().col(where.parts[p].node);
  return place;
}

/// Where a watched point is, relative to an elastic obstacle as it would lie undeformed.
Eigen::Vector3d UnilateralContact::placeOf(int contact) const noexcept {
  return restPlace(contact) + solver_.displacement(contact);
}

ContactSite UnilateralContact::siteAt(int obstacle, int vertex,
                                      const Proximity& near) const noexcept {
  const MovingObstacle& moving = obstacles_[obstacle];
  ContactSite site = ContactSite::atNode(0, vertex);
  if (moving.body == 0) return site;
  for (int k = 0; k < 3; ++k)
    site.parts[site.count++] = {moving.body, moving.obstacle.mesh->triangles()(k, near.triangle),
                                -near.barycentric[k]};
  return site;
}

void UnilateralContact::turnBodies(const RigidPose* poses) noexcept {
  constexpr double rounding = 1e-12;
  for (int obstacle = 0; obstacle < obstacleCount(); ++obstacle) {
    const MovingObstacle& moving = obstacles_[obstacle];
    const Eigen::Quaterniond& turned = poses[obstacle].orientation;
    if (moving.body > 0 &&
        (!moving.placed || moving.pose.orientation.angularDistance(turned) > rounding))
      solver_.turn(moving.body, turned.toRotationMatrix());
  }
}

/// Lets contacts with an elastic obstacle act on the triangles that they have slid to.
void UnilateralContact::moveSites() noexcept {
  for (int contact = solver_.count() - 1; contact >= 0; --contact) {
    const ContactAnchor anchor = anchors_[contact];
    if (obstacles_[anchor.obstacle].body == 0 || anchor.isHeld) continue;
    const Proximity near = proximity(anchor.obstacle, placeOf(contact));
    const ContactSite site = siteAt(anchor.obstacle, anchor.vertex, near);
    if (differ(site, solver_.compliance().site(contact))) solver_.move(contact, site);
  }
}

/// The normal of a contact. Beside an edge or corner of a tool that pierces a triangle the way out
/// of the tool is to its side; but a face can yield to them along its own normal alone. So it is
/// with tools of small facets, whose normals jump from one to the next. A vertex is pressed along
/// the normal of what the facets stand for: those round an apex would drive it to a side.
Eigen::Vector3d UnilateralContact::normalOf(const ContactAnchor& anchor,
                                            const Proximity& near) const noexcept {
  const MovingObstacle& moving = obstacles_[anchor.obstacle];
  if (!moving.obstacle.shape->isFaceted()) return near.normal;
  if (anchor.vertex < 0) return -anchor.faceNormal;
  Proximity own = near;
  own.normal = moving.pose.orientation.conjugate() * near.normal;
  return moving.pose.orientation * moving.obstacle.shape->smoothNormal(own);
}

/// Gap and slip of each watched point where it is now, to first order in its displacement.
void UnilateralContact::linearise() noexcept {
  for (int contact = 0; contact < solver_.count(); ++contact) {
    ContactAnchor& anchor = anchors_[contact];
    const MovingObstacle& moving = obstacles_[anchor.obstacle];
    ContactConditions& conditions = solver_.conditions(contact);
    conditions.bilateral = anchor.isHeld;
    if (anchor.isHeld) {
      conditions.offset = restPlace(contact) - moving.pose.toWorld(anchor.place);
      continue;
    }
    const Eigen::Vector3d place = placeOf(contact);
    const Proximity near = proximity(anchor.obstacle, place);
    if (!anchor.place.allFinite()) anchor.place = moving.pose.toOwn(place);
    const Eigen::Vector3d moved = place - moving.pose.toWorld(anchor.place);
    const Eigen::Vector3d displacement = solver_.displacement(contact);
    const Eigen::Vector3d normal = normalOf(anchor, near);
    conditions.normal = normal;
    conditions.friction = moving.obstacle.friction;
    conditions.offset =
        (near.distance - anchor.slack) * normal + moved - normal.dot(moved) * normal - displacement;
  }
}

/// Points that do not stick take their place on the obstacle with them.
void UnilateralContact::settle() noexcept {
  constexpr double kept = 0.95;  // of a slack, a step
  penetration_ = yielded_ = 0;
  for (int contact = 0; contact < solver_.count(); ++contact) {
    ContactAnchor& anchor = anchors_[contact];
    const Eigen::Vector3d place = placeOf(contact);
    yielded_ = std::max(yielded_, (place - anchor.placeBefore).norm());
    anchor.gap = proximity(anchor.obstacle, place).distance;
    penetration_ = std::max(penetration_, -anchor.gap);
    anchor.slack = anchor.slack < -1e-6 * margin_ ? kept * anchor.slack : 0;
    if (solver_.status(contact) != ContactStatus::Stick)
      anchor.place = obstacles_[anchor.obstacle].pose.toOwn(place);
  }
}

ContactCertificate UnilateralContact::step(const RigidPose* given) noexcept {
  const RigidPose* const poses = broughtIn(given);
  wasTruncated_ = isTruncated_;
  isTruncated_ = isUnserved_ = false;
  hold();
  turnBodies(poses);
  dismiss();
  gatherLoads();
  advance(poses);
  solver_.updateDisplacements();
  for (int contact = 0; contact < solver_.count(); ++contact)
    anchors_[contact].placeBefore = placeOf(contact);
  ContactCertificate certificate;
  for (int k = 0; k < settings_.linearisations; ++k) {
    if (solver_.compliance().bodyCount() > 1) moveSites();
    if (followInside(k == 0)) solver_.updateDisplacements();
    linearise();
    const int before = certificate.iterations;
    const bool cut = certificate.budgetCut;
    certificate = solver_.solve();
    certificate.iterations += before;
    certificate.budgetCut = certificate.budgetCut || cut;
  }
  certificate.truncated = isTruncated_;
  certificate.startedInside = startedInside_;
  certificate.uncomputed = isUnserved_;
  certificate.failed = certificate.failed || isUnserved_;
  settle();
  return certificate;
}

Wrench UnilateralContact::wrench(int obstacle) const noexcept {
  Wrench wrench = kNoWrench;
  const Eigen::Vector3d& centre = obstacles_[obstacle].pose.position;
  for (int contact = 0; contact < solver_.count(); ++contact) {
    if (anchors_[contact].obstacle != obstacle) continue;
    const Eigen::Vector3d force = -stiffnessScale_ * solver_.force(contact);
    wrench.force += force;
    wrench.torque += (placeOf(contact) - centre).cross(force);
  }
  return wrench;
}

Eigen::Vector3d UnilateralContact::force(int obstacle) const noexcept {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (int contact = 0; contact < solver_.count(); ++contact)
    if (anchors_[contact].obstacle == obstacle) force -= stiffnessScale_ * solver_.force(contact);
  return force;
}

UnilateralContact::Watched UnilateralContact::watched(int contact) const noexcept {
  const ContactAnchor& anchor = anchors_[contact];
  return {anchor.obstacle,
          anchor.vertex,
          anchor.vertex < 0 ? obstacles_[anchor.obstacle].large[anchor.slot] : -1,
          solver_.status(contact),
          stiffnessScale_ * solver_.force(contact),
          solver_.displacement(contact),
          anchor.gap,
          anchor.isHeld};
}

}  // namespace palpate
