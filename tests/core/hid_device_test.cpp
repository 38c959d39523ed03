// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/hid_device.h"

#include <gtest/gtest.h>

#include <limits>

#include "haptics/palpate_report.h"
#include "support/allocation_count.h"
#include "support/eventually.h"
#include "support/fake_hid.h"
#include "support/palpate_states.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

using Bytes = FakeHid::Bytes;

/// Devices that speak Palpate's own reports, in this program.
class HidDevices : public testing::Test {
 protected:
  HidDevices() {
    hid_.onGetFeature = [](std::uint8_t) {
      const PalpateReport report = encodePalpateCapability({3.5, 0.1, 900, 1000, 20});
      return Bytes(report.begin(), report.end());
    };
    timing_.reconnect = std::chrono::microseconds(100);
    timing_.silence = std::chrono::hours(1);
  }

  std::unique_ptr<HidDevice> open() {
    return std::make_unique<HidDevice>("arm", hid_.opener(), makePalpateProtocol(), timing_);
  }

  /// The wrenches that arrived, as the device understands them.
  std::vector<PalpateWrench> wrenches() const {
    std::vector<PalpateWrench> result;
    for (const Bytes& bytes : hid_.outputs()) {
      PalpateWrench wrench;
      EXPECT_TRUE(parsePalpateWrench(bytes.data(), bytes.size(), wrench));
      result.push_back(wrench);
    }
    return result;
  }

  /// Whether a read gives this state.
  static bool readsState(HidDevice& device, std::uint32_t sequence) {
    DeviceState state;
    return device.read(state) && std::abs(state.pose.position.x() - 1e-6 * sequence) < 1e-9;
  }

  FakeHid hid_;
  HidDevice::Timing timing_;
};

TEST_F(HidDevices, TellTheirLimits) {
  const auto device = open();
  EXPECT_EQ(device->info().name, "arm");
  EXPECT_EQ(device->info().largestForce, 3.5);
  EXPECT_EQ(device->info().largestStiffness, 900);
  EXPECT_EQ(device->info().reportRate, 1000);
}

TEST_F(HidDevices, AreReadFromTheirFirstStateOn) {
  const auto device = open();
  DeviceState state;
  EXPECT_FALSE(device->read(state)) << "where it is has not been told";
  hid_.send({stateReport(1)});
  EXPECT_TRUE(eventually([&] { return device->read(state); }));
  EXPECT_EQ(state.sequence, 1u);
  ASSERT_TRUE(device->read(state));
  EXPECT_EQ(state.sequence, 1u) << "silent, it repeats its last number";
}

TEST_F(HidDevices, TheNewestReportWins) {
  const auto device = open();
  std::uint64_t sent = 0;
  for (std::uint32_t burst = 0; burst < 20; ++burst) {
    std::vector<Bytes> reports;
    for (std::uint32_t i = 1; i <= 200; ++i) reports.push_back(stateReport(200 * burst + i));
    hid_.send(reports);
    sent += reports.size();
    EXPECT_TRUE(eventually([&] { return readsState(*device, 200 * burst + 200); }));
    EXPECT_EQ(device->counts().statesTaken, sent);
  }
  EXPECT_EQ(device->counts().reportsIgnored, 0u);
}

TEST_F(HidDevices, LateRepeatedAndLostReportsChangeNothing) {
  const auto device = open();
  std::vector<Bytes> reports;
  std::uint64_t good = 0, bad = 0;
  std::uint32_t sequence = 1000;
  for (int i = 0; i < 500; ++i) {
    sequence += i % 11 == 0 ? 5 : 1;  // some are lost
    reports.push_back(stateReport(sequence));
    ++good;
    if (i % 3 == 0) {
      reports.push_back(stateReport(sequence));
      ++bad;
    }
    if (i % 7 == 0) {
      reports.push_back(stateReport(sequence - 3));
      ++bad;
    }
  }
  hid_.send(reports);
  EXPECT_TRUE(eventually([&] { return device->counts().reportsIgnored == bad; }));
  EXPECT_TRUE(eventually([&] { return readsState(*device, sequence); }));
  EXPECT_EQ(device->counts().statesTaken, good);
}

TEST_F(HidDevices, ReportsThatAreNoneAreIgnored) {
  const auto device = open();
  Bytes longer = stateReport(9);
  longer.push_back(0);
  Bytes uncalibrated = stateReport(10);
  uncalibrated[2] = 0;
  hid_.send({stateReport(1), Bytes(64, 0xff), Bytes(1, 1), longer, Bytes(4096, 1), uncalibrated});
  EXPECT_TRUE(eventually([&] { return device->counts().reportsIgnored == 5; }));
  EXPECT_TRUE(eventually([&] { return readsState(*device, 1); }));
}

TEST_F(HidDevices, UnpluggedTheyAreAwayAndBackWithTheirFirstNewState) {
  const auto device = open();
  hid_.send({stateReport(70)});
  EXPECT_TRUE(eventually([&] { return readsState(*device, 70); }));
  hid_.unplug();
  DeviceState state;
  EXPECT_TRUE(eventually([&] { return !device->read(state); }));
  EXPECT_FALSE(device->write(push(1)));
  EXPECT_EQ(device->counts().connections, 1u);
  hid_.plug();
  EXPECT_TRUE(eventually([&] { return device->counts().connections == 2; }));
  EXPECT_FALSE(device->read(state)) << "the state from before is not one of now";
  hid_.send({stateReport(3)});  // it counts anew
  EXPECT_TRUE(eventually([&] { return readsState(*device, 3); }));
  ASSERT_TRUE(device->read(state));
  EXPECT_EQ(state.sequence, 2u) << "its own sequence goes on";
}

TEST_F(HidDevices, SurviveTenThousandUnpluggings) {
  const auto device = open();
  for (std::uint32_t cycle = 1; cycle <= 10000; ++cycle) {
    hid_.send({stateReport(cycle)});
    ASSERT_TRUE(eventually([&] { return readsState(*device, cycle); })) << cycle;
    hid_.unplug();
    DeviceState state;
    ASSERT_TRUE(eventually([&] { return !device->read(state); })) << cycle;
    hid_.plug();
    ASSERT_TRUE(eventually([&] { return device->counts().connections == cycle + 1; })) << cycle;
  }
  EXPECT_EQ(device->counts().statesTaken, 10000u);
}

TEST_F(HidDevices, TheNewestWrenchArrivesOnceAndAnswersItsState) {
  const auto device = open();
  hid_.send({stateReport(41)});
  EXPECT_TRUE(eventually([&] { return readsState(*device, 41); }));
  for (int i = 1; i <= 1000; ++i) device->write(push(0.001 * i));
  EXPECT_TRUE(
      eventually([&] { return !wrenches().empty() && wrenches().back().wrench.force.x() == 1; }));
  const std::vector<PalpateWrench> arrived = wrenches();
  EXPECT_EQ(device->counts().wrenchesSent, arrived.size()) << "none is sent twice";
  EXPECT_EQ(arrived.back().answers, 41u);
  EXPECT_EQ(arrived.back().flags, PalpateWrench::kEnable);
  for (std::size_t i = 1; i < arrived.size(); ++i) {
    EXPECT_EQ(arrived[i].sequence, arrived[i - 1].sequence + 1);
    EXPECT_GT(arrived[i].wrench.force.x(), arrived[i - 1].wrench.force.x());
  }
}

TEST_F(HidDevices, AForceThatIsNoNumberIsNone) {
  const auto device = open();
  device->write(push(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(eventually([&] { return wrenches().size() == 1; }));
  EXPECT_EQ(wrenches()[0].wrench.force, Eigen::Vector3d::Zero());
}

TEST_F(HidDevices, WhatDoesNotArriveIsSaidOfTheNextWrench) {
  bool works = false;
  hid_.onOutput = [&works](const Bytes&) { return works; };
  const auto device = open();
  EXPECT_TRUE(device->write(push(1)));
  EXPECT_TRUE(eventually([&] { return device->counts().wrenchesFailed == 1; }));
  EXPECT_FALSE(device->write(push(2)));
}

TEST_F(HidDevices, RestWhenTheServoLoopFallsSilent) {
  timing_.silence = std::chrono::milliseconds(5);
  const auto device = open();
  device->write(push(2));
  EXPECT_TRUE(eventually([&] { return device->counts().rests == 1; }));
  ASSERT_EQ(wrenches().size(), 2u);
  EXPECT_EQ(wrenches()[1].wrench.force, Eigen::Vector3d::Zero());
  EXPECT_EQ(wrenches()[1].flags, 0) << "actuators off";
  device->write(push(1));
  EXPECT_TRUE(eventually([&] { return device->counts().rests == 2; })) << "once per silence";
  EXPECT_EQ(wrenches().size(), 4u);
}

TEST_F(HidDevices, RestWhenTheyAreClosed) {
  auto device = open();
  device->write(push(2));
  EXPECT_TRUE(eventually([&] { return device->counts().wrenchesSent == 1; }));
  device.reset();
  ASSERT_EQ(wrenches().size(), 2u);
  EXPECT_EQ(wrenches()[1].flags, 0);
}

TEST_F(HidDevices, AWrenchFromBeforeAnUnpluggingIsNotRendered) {
  const auto device = open();
  hid_.unplug();
  while (device->write(push(3))) {
  }
  const std::size_t before = wrenches().size();
  hid_.plug();
  EXPECT_TRUE(eventually([&] { return device->counts().connections == 2; }));
  hid_.send({stateReport(1)});
  EXPECT_TRUE(eventually([&] { return readsState(*device, 1); }));
  EXPECT_EQ(wrenches().size(), before);
}

TEST_F(HidDevices, OneThreadOwnsTheHandle) {
  {
    const auto device = open();
    DeviceState state;
    for (int i = 0; i < 100; ++i) {
      device->read(state);
      device->write(push(1));
    }
    hid_.unplug();
    EXPECT_TRUE(eventually([&] { return !device->write(push(1)); }));
    hid_.plug();
    EXPECT_TRUE(eventually([&] { return device->counts().connections == 2; }));
  }
  EXPECT_EQ(hid_.threads().size(), 1u);
  EXPECT_EQ(hid_.threads().count(std::this_thread::get_id()), 0u);
}

TEST_F(HidDevices, TheServoLoopsSideAllocatesNothing) {
  ASSERT_TRUE(allocationsAreCounted());
  const auto device = open();
  hid_.send({stateReport(1)});
  EXPECT_TRUE(eventually([&] { return readsState(*device, 1); }));
  DeviceState state;
  const long before = allocationCount();
  for (int i = 0; i < 10000; ++i) {
    device->read(state);
    device->write(push(1));
  }
  EXPECT_EQ(allocationCount(), before);
}

TEST_F(HidDevices, ThatAreNotThereOrDoNotAnswerAreRefused) {
  hid_.onGetFeature = [](std::uint8_t) { return Bytes(); };
  EXPECT_TRUE(isRefused<std::runtime_error>([&] { open(); }, "does not tell what it can do"));
  hid_.unplug();
  EXPECT_TRUE(isRefused<std::runtime_error>([&] { open(); }, "the device 'arm' is not there"));
  EXPECT_TRUE(
      isRefused([&] { HidDevice device("arm", hid_.opener(), nullptr); }, "and a protocol"));
  EXPECT_TRUE(isRefused([&] { HidDevice device("arm", nullptr, makePalpateProtocol()); },
                        "needs a way to open it"));
}

}  // namespace
}  // namespace palpate::test
