// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include <cmath>

#include "contact/mask_kernel.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr MaskShape kShapes[] = {MaskShape::Linear, MaskShape::Uniform, MaskShape::Gaussian,
                                 MaskShape::Hertzian};

/// The integral of f over 0..1 after t = sin(a), which takes the root out of the Hertzian kernel.
template <class Function>
double integral(const Function& f) {
  constexpr int kSteps = 2000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double a = kPi / 2 * (i + 0.5) / kSteps;
    sum += f(std::sin(a)) * std::cos(a) * kPi / 2 / kSteps;
  }
  return sum;
}

TEST(MaskKernel, SinksTheCentreOnAHalfSpaceByItsBoussinesqIntegral) {
  // u = (1 - nu^2) / (pi E) times the integral of rho / r over the disc.
  for (MaskShape shape : kShapes) {
    const MaskKernel& kernel = maskKernel(shape);
    const double along = integral([&](double t) { return kernel.at(t); });
    const double around = integral([&](double t) { return t * kernel.at(t); });
    // The midpoint rule of 2000 steps is good to 1e-7.
    EXPECT_NEAR(kernel.halfSpaceCompliance(), along / around / kPi, 1e-6);
  }
}

TEST(MaskKernel, OfTheSameForceSinksDeeperTheMoreItGathersAtTheCentre) {
  EXPECT_LT(maskKernel(MaskShape::Uniform).halfSpaceCompliance(),
            maskKernel(MaskShape::Hertzian).halfSpaceCompliance());
  EXPECT_LT(maskKernel(MaskShape::Hertzian).halfSpaceCompliance(),
            maskKernel(MaskShape::Linear).halfSpaceCompliance());
  EXPECT_LT(maskKernel(MaskShape::Linear).halfSpaceCompliance(),
            maskKernel(MaskShape::Gaussian).halfSpaceCompliance());
}

TEST(MaskKernel, IsTheOneOfItsShape) {
  for (MaskShape shape : kShapes) {
    EXPECT_EQ(&maskKernel(shape), &maskKernel(shape));
    for (double t : {0.0, 0.3, 0.9}) EXPECT_EQ(maskKernel(shape).at(t), maskValue(shape, t));
  }
}

}  // namespace
}  // namespace palpate::test
