// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "progress.h"

#include <gtest/gtest.h>

#include <string>

#include "support/refusals.h"

namespace palpate::test {
namespace {

TEST(Progress, PartsOfPartsMapOntoTheWhole) {
  double seen = -1;
  std::string stage;
  const Progress whole([&](double fraction, const char* name) {
    seen = fraction;
    stage = name;
    return true;
  });
  const Progress part = whole.part(0.25, 0.75), partOfPart = part.part(0.5, 1);
  part.report(0, "assemble");
  EXPECT_DOUBLE_EQ(seen, 0.25);
  part.report(1, "assemble");
  EXPECT_DOUBLE_EQ(seen, 0.75);
  partOfPart.report(0.5, "factor");
  EXPECT_DOUBLE_EQ(seen, 0.625);
  EXPECT_EQ(stage, "factor");
}

TEST(Progress, ACallbackThatSaysNoAbortsTheWork) {
  const Progress progress([](double fraction, const char*) { return fraction < 0.5; });
  EXPECT_NO_THROW(progress.report(0.4, "solve"));
  EXPECT_EQ(refusal<Aborted>([&] { progress.report(0.5, "solve"); }), "aborted on request");
  EXPECT_THROW(progress.part(0.5, 1).report(0, "solve"), Aborted);
}

TEST(Progress, WithoutACallbackNothingHappens) {
  EXPECT_NO_THROW(Progress().report(0.5, "solve"));
  EXPECT_NO_THROW(Progress(ProgressCallback()).part(0, 0.5).report(1, "solve"));
}

}  // namespace
}  // namespace palpate::test
