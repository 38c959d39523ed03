// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/material.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/refusals.h"

namespace palpate::test {
namespace {

const double kInfinity = std::numeric_limits<double>::infinity();
const double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Material, PoissonsRatioRunsFromAboveMinusOneToOneHalfIncluded) {
  for (double ratio : {-0.999999, -0.5, 0.0, 0.3, 0.499999, 0.5})
    EXPECT_EQ(Material(1, ratio).poissonRatio(), ratio);
}

TEST(Material, PoissonsRatioOutsideItsRangeIsRefusedWithItsValue) {
  EXPECT_EQ(refusal([] { Material(1, -1); }),
            "Poisson's ratio must be above -1 and at most 0.5, not -1");
  EXPECT_EQ(refusal([] { Material(1, 0.501); }),
            "Poisson's ratio must be above -1 and at most 0.5, not 0.501");
  EXPECT_EQ(refusal([] { Material(1, kNaN); }),
            "Poisson's ratio must be above -1 and at most 0.5, not nan");
  EXPECT_EQ(refusal([] { Material(1, -kInfinity); }),
            "Poisson's ratio must be above -1 and at most 0.5, not -inf");
}

TEST(Material, TheFirstNumberBeyondOneHalfIsShownWithTheDigitsThatTellItApart) {
  EXPECT_EQ(refusal([] { Material(1, std::nextafter(0.5, 1)); }),
            "Poisson's ratio must be above -1 and at most 0.5, not 0.5000000000000001");
}

TEST(Material, YoungsModulusMustBePositiveAndFinite) {
  EXPECT_EQ(refusal([] { Material(0, 0.3); }), "Young's modulus must be a positive number, not 0");
  EXPECT_EQ(refusal([] { Material(-2e9, 0.3); }),
            "Young's modulus must be a positive number, not -2e+09");
  EXPECT_EQ(refusal([] { Material(kInfinity, 0.3); }),
            "Young's modulus must be a positive number, not inf");
  EXPECT_EQ(refusal([] { Material(kNaN, 0.3); }),
            "Young's modulus must be a positive number, not nan");
  EXPECT_EQ(refusal([] { Material(1e300, 0.3); }),
            "Young's modulus must be between 1e-60 and 1e60, not 1e+300");
}

TEST(Material, ShearModulusIsThatOfElasticity) {
  EXPECT_DOUBLE_EQ(Material(3e9, 0.5).shearModulus(), 1e9);   // E / 3 when incompressible
  EXPECT_DOUBLE_EQ(Material(2e9, 0).shearModulus(), 1e9);     // E / 2
  EXPECT_DOUBLE_EQ(Material(1e9, -0.5).shearModulus(), 1e9);  // E when auxetic
}

}  // namespace
}  // namespace palpate::test
