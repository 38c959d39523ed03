// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

namespace palpate {

/// Homogeneous isotropic linear elastic material.
class Material {
 public:
  /// @param youngsModulus  E > 0, Pa (or force per area in the units of the mesh).
  /// @param poissonRatio   nu in (-1, 0.5]; 0.5 is incompressible.
  /// @throws std::invalid_argument outside these ranges.
  Material(double youngsModulus, double poissonRatio);

  double youngsModulus() const { return youngsModulus_; }
  double poissonRatio() const { return poissonRatio_; }
  /// G = E / (2 (1 + nu)).
  double shearModulus() const { return youngsModulus_ / (2 * (1 + poissonRatio_)); }

 private:
  double youngsModulus_, poissonRatio_;
};

}  // namespace palpate
