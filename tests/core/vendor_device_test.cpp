// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The example of adding_a_device.md does what the document asks of it.

#include "support/vendor_device.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/eventually.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

using stand_in_sdk::arm;

class VendorDevices : public testing::Test {
 protected:
  VendorDevices() { setPlugged(true); }

  static void setPlugged(bool isPlugged) {
    const std::lock_guard<std::mutex> lock(arm().mutex);
    arm().isPlugged = isPlugged;
  }
  static Eigen::Vector3d force() {
    const std::lock_guard<std::mutex> lock(arm().mutex);
    return Eigen::Map<const Eigen::Vector3d>(arm().newtons);
  }
};

TEST_F(VendorDevices, SpeakMetresAndQuaternions) {
  {
    const std::lock_guard<std::mutex> lock(arm().mutex);
    arm().millimetres[1] = 25;
    const double quarterAboutZ[] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    std::copy_n(quarterAboutZ, 9, arm().matrix);
    arm().buttons = 2;
  }
  VendorDevice device;
  DeviceState state;
  EXPECT_TRUE(eventually([&] { return device.read(state); }));
  EXPECT_EQ(state.pose.position, Eigen::Vector3d(0, 0.025, 0));
  EXPECT_LE((state.pose.orientation * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(),
            1e-15);
  EXPECT_EQ(state.pose.buttons, 2u);
  const std::uint64_t before = state.sequence;
  EXPECT_TRUE(eventually([&] { return device.read(state) && state.sequence > before; }));
}

TEST_F(VendorDevices, RenderForcesUntilTheServoLoopFallsSilentOrTheyAreClosed) {
  {
    VendorDevice device;
    const Eigen::Vector3d push(1, -2, 0.5);
    EXPECT_TRUE(eventually([&] {
      device.write({push, Eigen::Vector3d::Zero()});
      return force() == push;
    }));
    EXPECT_TRUE(eventually([&] { return force().isZero(0); })) << "silence";
    const double nan = std::numeric_limits<double>::quiet_NaN();
    device.write({Eigen::Vector3d(nan, 0, 0), Eigen::Vector3d::Zero()});
    device.write({push, Eigen::Vector3d::Zero()});
  }
  EXPECT_TRUE(force().isZero(0));
  EXPECT_EQ(arm().openHandles, 0);
}

TEST_F(VendorDevices, AreAwayWhileUnplugged) {
  VendorDevice device;
  DeviceState state;
  EXPECT_TRUE(eventually([&] { return device.read(state); }));
  setPlugged(false);
  EXPECT_TRUE(eventually([&] { return !device.read(state); }));
  EXPECT_TRUE(eventually([&] {
    return !device.write({Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  }));
  setPlugged(true);
  EXPECT_TRUE(eventually([&] { return device.read(state); }));
  setPlugged(false);
  EXPECT_TRUE(isRefused<std::runtime_error>([] { VendorDevice second; }, "is it plugged in"));
}

}  // namespace
}  // namespace palpate::test
