// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include "haptics/hid_bus.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

TEST(WithoutHidapi, DevicesSayWhatIsMissing) {
  const char* const missing =
      "HID devices need hidapi, which this build of Palpate was made without";
  EXPECT_EQ(refusal<std::runtime_error>([] { listHidDevices(); }), missing);
  EXPECT_EQ(refusal<std::runtime_error>([] { openHidTransport("/dev/hidraw0"); }), missing);
}

}  // namespace
}  // namespace palpate::test
