// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/unilateral_contact.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

/// A vertex cannot be touched from where its own body is: of the cosine between its normal and the
/// way out of the obstacle. Corners look aside.
constexpr double kLargestCosine = 0.5;

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
      settings_(settings),
      solver_(bodiesOf(greens, obstacles), rigidStiffnessOf(*greens, *mesh_, settings),
              settings.capacity, settings.solver) {
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
    Moving moving;
    moving.body = obstacle.greens ? ++body : 0;
    moving.obstacle = std::move(obstacle);
    moving.lookAt.assign(mesh_->vertexCount(), 0);
    moving.isWatched.assign(mesh_->vertexCount(), false);
    while (static_cast<int>(partOf_.size()) <= moving.obstacle.tool)
      partOf_.emplace_back(mesh_->vertexCount(), -1);
    obstacles_.push_back(std::move(moving));
  }
  anchors_.resize(settings.capacity);
  centre_ = (mesh_->points().rowwise().minCoeff() + mesh_->points().rowwise().maxCoeff()) / 2;
  radius_ = (mesh_->points().colwise() - centre_).colwise().norm().maxCoeff();
}

void UnilateralContact::setFriction(int obstacle, double friction) {
  requireFriction(friction);
  obstacles_[obstacle].obstacle.friction = friction;
}

void UnilateralContact::setStiffnessScale(double scale) {
  if (!(scale > 0) || !std::isfinite(scale))
    throw std::invalid_argument("a stiffness scale must be positive, not " + std::to_string(scale));
  stiffnessScale_ = scale;
}

void UnilateralContact::reset() noexcept {
  solver_.clear();
  for (Moving& moving : obstacles_) {
    moving.placed = false;
    std::fill(moving.isWatched.begin(), moving.isWatched.end(), false);
  }
  for (std::vector<int>& parts : partOf_) std::fill(parts.begin(), parts.end(), -1);
  penetration_ = 0;
}

Proximity UnilateralContact::proximity(int obstacle, const Eigen::Vector3d& place) const noexcept {
  const Moving& moving = obstacles_[obstacle];
  Proximity near = moving.obstacle.shape->proximity(moving.pose.toOwn(place));
  near.normal = moving.pose.orientation * near.normal;
  return near;
}

/// Where a watched vertex is, relative to an elastic obstacle as it would lie undeformed.
Eigen::Vector3d UnilateralContact::placeOf(int contact) const noexcept {
  return mesh_->points().col(anchors_[contact].vertex) + solver_.displacement(contact);
}

/// How far any point of an obstacle near the surface has moved to a pose, at most.
double UnilateralContact::wayOf(int obstacle, const RigidPose& pose) const noexcept {
  const Moving& moving = obstacles_[obstacle];
  if (!moving.placed) return 0;
  const double lever =
      std::min(moving.obstacle.shape->reach(), (moving.pose.position - centre_).norm() + radius_);
  return (pose.position - moving.pose.position).norm() +
         lever * moving.pose.orientation.angularDistance(pose.orientation);
}

/// The poses, and which vertices they may have brought near. One obstacle's way counts for all: it
/// may press the surface into another.
void UnilateralContact::advance(const RigidPose* poses) noexcept {
  double way = 0;
  for (int obstacle = 0; obstacle < obstacleCount(); ++obstacle)
    way = std::max(way, wayOf(obstacle, poses[obstacle]));
  travelled_ += way;
  for (int obstacle = 0; obstacle < obstacleCount(); ++obstacle) {
    Moving& moving = obstacles_[obstacle];
    if (!moving.placed) std::fill(moving.lookAt.begin(), moving.lookAt.end(), 0);
    moving.pose = poses[obstacle];
    moving.placed = true;
  }
  for (int obstacle = 0; obstacle < obstacleCount(); ++obstacle)
    for (int vertex = 0; vertex < mesh_->vertexCount(); ++vertex)
      if (obstacles_[obstacle].lookAt[vertex] <= travelled_ &&
          !obstacles_[obstacle].isWatched[vertex])
        look(obstacle, vertex);
}

/// Watches a vertex that is near, and tells when to look at it again if it is not.
void UnilateralContact::look(int obstacle, int vertex) noexcept {
  Moving& moving = obstacles_[obstacle];
  const Eigen::Vector3d place = mesh_->points().col(vertex);
  const double reach = moving.obstacle.shape->reach();
  const double atLeast = (place - moving.pose.position).norm() - reach;
  if (atLeast > margin_) {
    moving.lookAt[vertex] = travelled_ + atLeast - margin_;
    return;
  }
  const Proximity near = proximity(obstacle, place);
  if (near.distance > margin_) {
    moving.lookAt[vertex] = travelled_ + near.distance - margin_;
    return;
  }
  if (near.normal.dot(mesh_->vertexNormals().col(vertex)) > kLargestCosine) {
    moving.lookAt[vertex] = travelled_ + margin_ / 4;
    return;
  }
  const double gap = proximity(obstacle, place + displacementOf(vertex)).distance;
  if (moving.body == 0 && gap > margin_)
    moving.lookAt[vertex] = travelled_ + (gap - margin_ / 2) / 2;
  else if (isNearestPart(obstacle, vertex, near.distance))
    watch(obstacle, vertex, near);
}

/// Displacement of a vertex under the forces of the last step.
Eigen::Vector3d UnilateralContact::displacementOf(int vertex) const noexcept {
  const GreensFunctions& greens = solver_.compliance().body(0);
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
  for (int contact = 0; contact < solver_.count(); ++contact) {
    const int node = anchors_[contact].vertex;
    const Eigen::Vector3d force = solver_.force(contact);
    if (force.isZero(0) || greens.isFixed(node) || greens.isFixed(vertex)) continue;
    Eigen::Matrix3d block;
    greens.gather(Eigen::Map<const Eigen::VectorXi>(&vertex, 1),
                  Eigen::Map<const Eigen::VectorXi>(&node, 1), block.data());
    displacement += block * force / greens.vertexArea(node);
  }
  return displacement;
}

/// Whether a vertex is not watched with a nearer part of the same tool. One that is farther, by
/// more than chatter, lets go of it.
bool UnilateralContact::isNearestPart(int obstacle, int vertex, double distance) noexcept {
  Moving& moving = obstacles_[obstacle];
  if (moving.obstacle.tool < 0) return true;
  const int held = partOf_[moving.obstacle.tool][vertex];
  if (held < 0) return true;
  const double other = proximity(held, mesh_->points().col(vertex)).distance;
  const double chatter = margin_ / 8;
  if (distance > other - chatter) {
    moving.lookAt[vertex] = travelled_ + std::max(chatter, (distance - other) / 2);
    return false;
  }
  for (int contact = 0; contact < solver_.count(); ++contact)
    if (anchors_[contact].obstacle == held && anchors_[contact].vertex == vertex) {
      unwatch(contact);
      break;
    }
  obstacles_[held].lookAt[vertex] = travelled_ + chatter;
  return true;
}

ContactSite UnilateralContact::siteAt(int obstacle, int vertex,
                                      const Proximity& near) const noexcept {
  const Moving& moving = obstacles_[obstacle];
  ContactSite site = ContactSite::atNode(0, vertex);
  if (moving.body == 0) return site;
  for (int k = 0; k < 3; ++k)
    site.parts[site.count++] = {moving.body, moving.obstacle.mesh->triangles()(k, near.triangle),
                                -near.barycentric[k]};
  return site;
}

void UnilateralContact::watch(int obstacle, int vertex, const Proximity& near) noexcept {
  if (!solver_.add(siteAt(obstacle, vertex, near))) {
    overflowed_ = true;
    return;
  }
  const int contact = solver_.count() - 1;
  anchors_[contact] = {obstacle, vertex, Eigen::Vector3d::Constant(NAN), near.distance};
  obstacles_[obstacle].isWatched[vertex] = true;
  const int tool = obstacles_[obstacle].obstacle.tool;
  if (tool >= 0) partOf_[tool][vertex] = obstacle;
  ++transitions_;
}

void UnilateralContact::unwatch(int contact) noexcept {
  const int last = solver_.count() - 1;
  Moving& moving = obstacles_[anchors_[contact].obstacle];
  moving.isWatched[anchors_[contact].vertex] = false;
  if (moving.obstacle.tool >= 0) partOf_[moving.obstacle.tool][anchors_[contact].vertex] = -1;
  solver_.remove(contact);
  anchors_[contact] = anchors_[last];
  ++transitions_;
}

/// Stops watching vertices that are well away, as they are and as they would be undeformed.
void UnilateralContact::dismiss() noexcept {
  for (int contact = solver_.count() - 1; contact >= 0; --contact) {
    if (solver_.status(contact) != ContactStatus::Open || anchors_[contact].gap < 2 * margin_)
      continue;
    const auto [obstacle, vertex, place, gap] = anchors_[contact];
    const Proximity near = proximity(obstacle, mesh_->points().col(vertex));
    Moving& moving = obstacles_[obstacle];
    if (near.distance >= 2 * margin_)
      moving.lookAt[vertex] = travelled_ + near.distance - margin_;
    else if (moving.body == 0)
      moving.lookAt[vertex] = travelled_ + (gap - margin_ / 2) / 2;
    else
      continue;
    unwatch(contact);
  }
}

void UnilateralContact::turnBodies(const RigidPose* poses) noexcept {
  constexpr double rounding = 1e-12;
  for (int obstacle = 0; obstacle < obstacleCount(); ++obstacle) {
    const Moving& moving = obstacles_[obstacle];
    const Eigen::Quaterniond& turned = poses[obstacle].orientation;
    if (moving.body > 0 &&
        (!moving.placed || moving.pose.orientation.angularDistance(turned) > rounding))
      solver_.turn(moving.body, turned.toRotationMatrix());
  }
}

/// Lets contacts with an elastic obstacle act on the triangles that they have slid to.
void UnilateralContact::moveSites() noexcept {
  for (int contact = solver_.count() - 1; contact >= 0; --contact) {
    const Anchor anchor = anchors_[contact];
    if (obstacles_[anchor.obstacle].body == 0) continue;
    const Proximity near = proximity(anchor.obstacle, placeOf(contact));
    const ContactSite site = siteAt(anchor.obstacle, anchor.vertex, near);
    if (differ(site, solver_.compliance().site(contact))) solver_.move(contact, site);
  }
}

/// Gap and slip of each watched vertex where it is now, to first order in its displacement.
void UnilateralContact::linearise() noexcept {
  for (int contact = 0; contact < solver_.count(); ++contact) {
    Anchor& anchor = anchors_[contact];
    const Moving& moving = obstacles_[anchor.obstacle];
    const Eigen::Vector3d place = placeOf(contact);
    const Proximity near = proximity(anchor.obstacle, place);
    if (!anchor.place.allFinite()) anchor.place = moving.pose.toOwn(place);
    const Eigen::Vector3d moved = place - moving.pose.toWorld(anchor.place);
    ContactConditions& conditions = solver_.conditions(contact);
    const Eigen::Vector3d displacement = solver_.displacement(contact);
    conditions.normal = near.normal;
    conditions.friction = moving.obstacle.friction;
    conditions.offset =
        near.distance * near.normal + moved - near.normal.dot(moved) * near.normal - displacement;
  }
}

/// Vertices that do not stick take their place on the obstacle with them.
void UnilateralContact::settle() noexcept {
  penetration_ = 0;
  for (int contact = 0; contact < solver_.count(); ++contact) {
    Anchor& anchor = anchors_[contact];
    const Eigen::Vector3d place = placeOf(contact);
    anchor.gap = proximity(anchor.obstacle, place).distance;
    penetration_ = std::max(penetration_, -anchor.gap);
    if (solver_.status(contact) != ContactStatus::Stick)
      anchor.place = obstacles_[anchor.obstacle].pose.toOwn(place);
  }
}

ContactCertificate UnilateralContact::step(const RigidPose* poses) noexcept {
  overflowed_ = false;
  turnBodies(poses);
  dismiss();
  advance(poses);
  solver_.updateDisplacements();
  ContactCertificate certificate;
  for (int k = 0; k < settings_.linearisations; ++k) {
    if (solver_.compliance().bodyCount() > 1) moveSites();
    linearise();
    const int before = certificate.iterations;
    const bool cut = certificate.budgetCut;
    certificate = solver_.solve();
    certificate.iterations += before;
    certificate.budgetCut = certificate.budgetCut || cut;
  }
  certificate.budgetCut = certificate.budgetCut || overflowed_;
  settle();
  return certificate;
}

Wrench UnilateralContact::wrench(int obstacle) const noexcept {
  Wrench wrench{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
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
  const Anchor& anchor = anchors_[contact];
  return {anchor.obstacle,
          anchor.vertex,
          solver_.status(contact),
          stiffnessScale_ * solver_.force(contact),
          solver_.displacement(contact),
          anchor.gap};
}

}  // namespace palpate
