// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Contacts that are held.

#include <algorithm>

#include "contact/unilateral_contact.h"

namespace palpate {

void UnilateralContact::setHeld(int obstacle, bool held) noexcept {
  MovingObstacle& moving = obstacles_[obstacle];
  if (moving.isHeld == held) return;
  moving.isHeld = held;
  if (held) return;
  for (int contact = 0; contact < solver_.count(); ++contact)
    if (anchors_[contact].obstacle == obstacle && anchors_[contact].isHeld) {
      setHeldAt(contact, false);
      letGo(contact);
    }
}

/// Takes the force of a contact that pulls: the surface goes back from there, and its gaps are to
/// be linearised where it will be.
void UnilateralContact::letGo(int contact) noexcept {
  const ContactAnchor& anchor = anchors_[contact];
  const Eigen::Vector3d way = normalOf(anchor, proximity(anchor.obstacle, placeOf(contact)));
  if (way.dot(solver_.force(contact)) < 0) solver_.setForce(contact, Eigen::Vector3d::Zero());
}

void UnilateralContact::setHeldAt(int contact, bool held) noexcept {
  ContactAnchor& anchor = anchors_[contact];
  if (anchor.isHeld == held) return;
  anchor.isHeld = held;
  if (anchor.vertex >= 0) isHeldVertex_[anchor.vertex] = held;
  const ContactSite& where = site(contact);
  for (int p = 0; p < where.count; ++p)
    if (where.parts[p].body == 0) {
      holders_[where.parts[p].node] += held ? 1 : -1;
      holderOf_[where.parts[p].node] = anchor.obstacle;
    }
}

/// Whether a vertex cannot yield to an obstacle, because it is held or goes with what another
/// holds.
bool UnilateralContact::isHeldFrom(int obstacle, int vertex) const noexcept {
  return holders_[vertex] > 0 && (isHeldVertex_[vertex] || holderOf_[vertex] != obstacle);
}

bool UnilateralContact::isHeldBeside(int triangle) const noexcept {
  for (int k = 0; k < 3; ++k)
    if (holders_[mesh_->triangles()(k, triangle)] > 0) return true;
  return false;
}

/// Whether a point can be held without being said twice where it is.
bool UnilateralContact::canHold(int contact) const noexcept {
  const ContactAnchor& anchor = anchors_[contact];
  if (anchor.vertex >= 0) return !isHeldFrom(anchor.obstacle, anchor.vertex);
  const ContactSite& where = site(contact);
  bool hasOwnCorner = false;
  for (int p = 0; p < where.count; ++p) {
    const int node = where.parts[p].node;
    hasOwnCorner = hasOwnCorner || holders_[node] == 0;
    if (holders_[node] > 0 && holderOf_[node] != anchor.obstacle) return false;
  }
  return hasOwnCorner;
}

/// Whether what is held says where a contact is already, or could not yield to it.
bool UnilateralContact::isDetermined(int contact) const noexcept {
  const ContactAnchor& anchor = anchors_[contact];
  const ContactSite& where = site(contact);
  if (!anchor.isHeld)
    return anchor.vertex >= 0 ? isHeldFrom(anchor.obstacle, anchor.vertex)
                              : isHeldBeside(obstacles_[anchor.obstacle].large[anchor.slot]);
  if (anchor.vertex >= 0) return false;
  for (int p = 0; p < where.count; ++p)
    if (holders_[where.parts[p].node] == 1) return false;
  return true;
}

/// Holds all that bears a force on an obstacle that holds, where it is on the obstacle, and lets go
/// of what is determined by that: vertices first, then points inside triangles.
void UnilateralContact::hold() noexcept {
  bool isNew = false;
  for (const bool inside : {false, true})
    for (int contact = 0; contact < solver_.count(); ++contact) {
      ContactAnchor& anchor = anchors_[contact];
      const MovingObstacle& moving = obstacles_[anchor.obstacle];
      if (!moving.isHeld || anchor.isHeld || (anchor.vertex < 0) != inside ||
          solver_.status(contact) == ContactStatus::Open || !canHold(contact))
        continue;
      anchor.place = moving.pose.toOwn(placeOf(contact));
      setHeldAt(contact, true);
      isNew = true;
    }
  if (!isNew) return;
  for (int contact = solver_.count() - 1; contact >= 0; --contact) {
    if (!isDetermined(contact)) continue;
    lookAgain(contact);
    setHeldAt(contact, false);
    unwatch(contact);
  }
}

}  // namespace palpate
