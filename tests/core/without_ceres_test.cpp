// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include "support/refusals.h"
#include "support/rigs.h"

namespace palpate::test {
namespace {

TEST(WithoutCeres, IdentificationSaysWhatIsMissing) {
  const ElasticModel model = makeModel(icosphere(1), cap, 1e4, 0.3);
  const Measurements m = measuredOn(computeGreens(model, {}), model.mesh(), {});
  EXPECT_EQ(refusal<std::runtime_error>([&] { identifierOn(model, m).identify(m); }),
            "identification needs Ceres, which this build of Palpate was made without");
}

}  // namespace
}  // namespace palpate::test
