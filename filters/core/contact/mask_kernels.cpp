// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <cmath>
#include <stdexcept>

#include "contact/mask_kernel.h"

namespace palpate {
namespace {

constexpr double kPi = 3.14159265358979323846;

class LinearKernel : public MaskKernel {
 public:
  double at(double t) const noexcept override { return 1 - t; }
  double halfSpaceCompliance() const noexcept override { return 3 / kPi; }
};

class UniformKernel : public MaskKernel {
 public:
  double at(double) const noexcept override { return 1; }
  double halfSpaceCompliance() const noexcept override { return 2 / kPi; }
};

class GaussianKernel : public MaskKernel {
 public:
  double at(double t) const noexcept override { return std::exp(-kSharpness * t * t); }
  double halfSpaceCompliance() const noexcept override {
    const double along = std::sqrt(kPi / kSharpness) / 2 * std::erf(std::sqrt(kSharpness));
    const double around = (1 - std::exp(-kSharpness)) / (2 * kSharpness);
    return along / around / kPi;
  }

 private:
  static constexpr double kSharpness = 4.5;  ///< 3^2 / 2
};

class HertzianKernel : public MaskKernel {
 public:
  double at(double t) const noexcept override { return std::sqrt(1 - t * t); }
  double halfSpaceCompliance() const noexcept override { return 0.75; }
};

}  // namespace

MaskShape maskShapeFromName(const std::string& name) {
  if (name == "linear") return MaskShape::Linear;
  if (name == "uniform") return MaskShape::Uniform;
  if (name == "gaussian") return MaskShape::Gaussian;
  if (name == "hertzian") return MaskShape::Hertzian;
  throw std::invalid_argument("there is no mask '" + name +
                              "': choose linear, uniform, gaussian or hertzian");
}

const char* nameOf(MaskShape shape) noexcept {
  switch (shape) {
    case MaskShape::Uniform:
      return "uniform";
    case MaskShape::Gaussian:
      return "gaussian";
    case MaskShape::Hertzian:
      return "hertzian";
    default:
      return "linear";
  }
}

const MaskKernel& maskKernel(MaskShape shape) noexcept {
  static const LinearKernel linear;
  static const UniformKernel uniform;
  static const GaussianKernel gaussian;
  static const HertzianKernel hertzian;
  switch (shape) {
    case MaskShape::Uniform:
      return uniform;
    case MaskShape::Gaussian:
      return gaussian;
    case MaskShape::Hertzian:
      return hertzian;
    case MaskShape::Linear:
      break;
  }
  return linear;
}

double maskValue(MaskShape shape, double t) {
  return t >= 1 ? 0 : maskKernel(shape).at(t);
}

}  // namespace palpate
