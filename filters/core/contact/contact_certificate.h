// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

namespace palpate {

/// How well a contact problem was solved.
struct ContactCertificate {
  double residual = 0;       ///< of the complementarity conditions, relative (0: solved exactly)
  double coneViolation = 0;  ///< largest excess over the friction cone over the largest force
  int iterations = 0;
  int contactCount = 0;    ///< nodes, or points, that bear a force
  bool budgetCut = false;  ///< whether its limits ended the solve before its tolerance was met
  bool heldBack = false;   ///< whether a point that should slide has gone nowhere
  /// Whether contacts were left out for want of capacity: too small a force.
  bool truncated = false;
  /// Whether a point, or a tool with a shape, was inside the body when its touch began: its force
  /// grows from zero.
  bool startedInside = false;
  bool failed = false;  ///< no usable force
  /// Whether it failed where Green's functions are needed that were not computed.
  bool uncomputed = false;
};

}  // namespace palpate
