// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>

namespace palpate {

/// Radial mask functionals, as functions of distance over radius, zero from 1 on.
enum class MaskShape {
  Linear,    ///< 1 - t, the paper's (section 6.1.2)
  Uniform,   ///< 1
  Gaussian,  ///< exp(-(3 t)^2 / 2), a standard deviation of a third of the radius
  Hertzian,  ///< sqrt(1 - t^2), the pressure under a sphere
};

/// @throws std::invalid_argument for a name other than linear, uniform, gaussian, hertzian.
MaskShape maskShapeFromName(const std::string& name);
/// That name.
const char* nameOf(MaskShape shape) noexcept;

/// The contract of a radial mask functional. Kernels have no state: all of them are const and safe
/// from several threads. A new one is a class in mask_kernels.cpp and a name in MaskShape.
class MaskKernel {
 public:
  virtual ~MaskKernel() = default;

  /// The functional inside the radius.
  /// @param t  distance over radius, 0 <= t < 1.
  /// @return > 0, 1 at 0, nowhere rising.
  virtual double at(double t) const noexcept = 0;

  /// What a unit force under the functional sinks its centre by on a half-space, over
  /// (1 - nu^2) / (E radius): the integral of at(t) over that of t at(t), divided by pi.
  virtual double halfSpaceCompliance() const noexcept = 0;
};

/// The one kernel of a shape.
const MaskKernel& maskKernel(MaskShape shape) noexcept;

/// The functional at a distance of t radii, t >= 0.
double maskValue(MaskShape shape, double t);

}  // namespace palpate
