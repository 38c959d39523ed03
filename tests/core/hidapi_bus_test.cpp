// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Through the real libudev and hidapi, with emulated devices.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <thread>

#include "haptics/hid_bus.h"
#include "haptics/palpate_report.h"
#include "support/eventually.h"
#include "support/hid_emulator.h"
#include "support/palpate_states.h"
#include "support/pid_joystick.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

using Bytes = HidEmulator::Bytes;

/// Six axes in one report, buttons in another.
EmulatedModel spaceMouse() {
  EmulatedModel model;
  model.name = "SpaceMouse Compact";
  model.vendor = 0x256f;
  model.product = 0xc635;
  model.descriptor = {0x05, 0x01, 0x09, 0x08, 0xa1, 0x01, 0x85, 0x01, 0x09, 0x30, 0x09, 0x31, 0x09,
                      0x32, 0x09, 0x33, 0x09, 0x34, 0x09, 0x35, 0x16, 0xa2, 0xfe, 0x26, 0x5e, 0x01,
                      0x75, 0x10, 0x95, 0x06, 0x81, 0x02, 0x85, 0x03, 0x05, 0x09, 0x19, 0x01, 0x29,
                      0x02, 0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x10, 0x81, 0x02, 0xc0};
  return model;
}

EmulatedModel arm(const std::string& serial = "A1") {
  EmulatedModel model;
  model.name = "Open arm";
  model.serial = serial;
  model.vendor = 0x1209;
  model.product = 0x0001;
  model.descriptor = {kPalpateReportDescriptor.begin(), kPalpateReportDescriptor.end()};
  model.onGetFeature = [](std::uint8_t number) {
    const PalpateReport report = encodePalpateCapability({3.5, 0.1, 900, 1000, 20});
    return number == kCapabilityReport ? Bytes(report.begin(), report.end()) : Bytes();
  };
  return model;
}

EmulatedModel stick(PidJoystick& joystick) {
  EmulatedModel model;
  model.name = "Force stick";
  model.vendor = 0x1209;
  model.product = 0xffb0;
  model.descriptor = PidJoystick::descriptor();
  model.onOutput = [&](const Bytes& b) { return joystick.takeOutput(b.data(), b.size()); };
  model.onSetFeature = [&](const Bytes& b) { return joystick.takeFeature(b.data(), b.size()); };
  model.onGetFeature = [&](std::uint8_t number) { return joystick.feature(number); };
  return model;
}

HidRecord recordOf(const std::string& name) {
  for (const HidRecord& record : listHidDevices())
    if (record.name == name) return record;
  ADD_FAILURE() << "no " << name;
  return {};
}

class HidapiBus : public testing::Test {
 protected:
  /// Faster than people plug.
  std::unique_ptr<HidDevice> openArm() {
    HidDevice::Timing timing;
    timing.reconnect = std::chrono::microseconds(100);
    timing.silence = std::chrono::hours(1);
    return std::make_unique<HidDevice>("arm", openerOf(recordOf("Open arm")), makePalpateProtocol(),
                                       timing);
  }

  /// Sends states until one is read.
  void expectState(HidDevice& device, int number, std::uint32_t sequence) {
    EXPECT_TRUE(emulator_.send(number, stateReport(sequence)));
    DeviceState state;
    EXPECT_TRUE(eventually([&] {
      return device.read(state) && std::abs(state.pose.position.x() - 1e-6 * sequence) < 1e-9;
    }));
  }

  HidEmulator emulator_;
};

TEST_F(HidapiBus, WithoutDevicesTheListIsEmpty) {
  EXPECT_TRUE(listHidDevices().empty());
}

TEST_F(HidapiBus, ListsDevicesAndWhatTheyAre) {
  PidJoystick joystick;
  emulator_.plug(spaceMouse());
  emulator_.plug(arm());
  emulator_.plug(stick(joystick));
  EmulatedModel mouse = spaceMouse();
  mouse.name = "Mouse";
  mouse.vendor = 0x046d;
  mouse.product = 0xc077;
  mouse.descriptor[3] = 0x02;
  emulator_.plug(mouse);
  ASSERT_EQ(listHidDevices().size(), 4u);
  EXPECT_EQ(kindOf(recordOf("SpaceMouse Compact")), HidKind::SpaceMouse);
  EXPECT_EQ(kindOf(recordOf("Open arm")), HidKind::PalpateReports);
  EXPECT_EQ(kindOf(recordOf("Force stick")), HidKind::ForceFeedback);
  EXPECT_EQ(kindOf(recordOf("Mouse")), HidKind::Unknown);
  const HidRecord record = recordOf("Open arm");
  EXPECT_EQ(record.path, "/dev/hidraw1");
  EXPECT_EQ(record.vendor, 0x1209);
  EXPECT_EQ(record.product, 1);
  EXPECT_EQ(record.serial, "A1");
  EXPECT_EQ(record.interface, 0);
  EXPECT_EQ(record.manufacturer, "Emulated");
  EXPECT_EQ(record.descriptor, arm().descriptor);
}

TEST_F(HidapiBus, ASpaceMouseIsRead) {
  const int number = emulator_.plug(spaceMouse());
  const auto device = openHidDevice(recordOf("SpaceMouse Compact"), {0.05, 0.8, 1});
  DeviceState state, before;
  ASSERT_TRUE(device->read(before)) << "at rest";
  EXPECT_EQ(before.pose.position, Eigen::Vector3d::Zero());
  emulator_.send(number, {1, 0x5e, 0x01, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  emulator_.send(number, {3, 2, 0});
  EXPECT_TRUE(eventually([&] { return device->read(state) && state.pose.buttons == 2; }));
  EXPECT_EQ(state.pose.position, Eigen::Vector3d(0.05, 0, 0));
  EXPECT_GT(state.sequence, before.sequence);
  const std::uint64_t sequence = state.sequence;
  ASSERT_TRUE(device->read(state));
  EXPECT_EQ(state.sequence, sequence + 1) << "its silence is news, too";
  EXPECT_EQ(device->info().largestForce, 0);
}

TEST_F(HidapiBus, AStickPushesBack) {
  PidJoystick joystick;
  const int number = emulator_.plug(stick(joystick));
  const auto device = openHidDevice(recordOf("Force stick"), {0.05, 0.8, 2});
  EXPECT_EQ(device->info().largestForce, 2);
  emulator_.send(number, {1, 0x01, 0x80, 0, 0, 4});
  DeviceState state;
  EXPECT_TRUE(eventually([&] { return device->read(state) && state.pose.buttons == 4; }));
  EXPECT_EQ(state.pose.position.x(), -0.05);
  EXPECT_TRUE(device->write(push(1)));
  EXPECT_TRUE(eventually([&] {
    emulator_.takeOutputs(number);
    return joystick.effects.count(1) && joystick.effects[1].magnitude == 5000;
  }));
  EXPECT_TRUE(joystick.isEnabled);
}

TEST_F(HidapiBus, ADescribedBoardIsRead) {
  EmulatedModel board;
  board.name = "Slider";
  board.vendor = 0x1209;
  board.product = 0x0002;
  board.descriptor = {0x06, 0x00, 0xff, 0x09, 0x01, 0xa1, 0x01, 0x09, 0x02, 0x15,
                      0x00, 0x25, 0x7f, 0x75, 0x08, 0x95, 0x02, 0x81, 0x02, 0xc0};
  const HidDescription description = parseHidDescription(
      R"({"name": "slider", "vendor": "0x1209", "product": "0x0002", "input": {"report": 0,
          "length": 2, "position": [{"offset": 0, "type": "int16", "scale": 1e-5}, null, null]}})");
  EXPECT_TRUE(isRefused<std::runtime_error>([&] { openHidDevice(description); },
                                            "the device 'slider' is not there"));
  const int number = emulator_.plug(board);
  EXPECT_TRUE(isRefused([&] { openHidDevice(recordOf("Slider")); }, "it needs a description"));
  const auto device = openHidDevice(description);
  emulator_.send(number, {0xe8, 0x03});
  DeviceState state;
  EXPECT_TRUE(eventually([&] { return device->read(state); }));
  EXPECT_NEAR(state.pose.position.x(), 0.01, 1e-15);
}

TEST_F(HidapiBus, OurOwnReportsGoInAndOut) {
  const int number = emulator_.plug(arm());
  const auto device = openHidDevice(recordOf("Open arm"));
  EXPECT_EQ(device->info().name, "Open arm");
  EXPECT_EQ(device->info().largestForce, 3.5);
  expectState(*device, number, 500);
  EXPECT_TRUE(device->write(push(1.5)));
  PalpateWrench wrench;
  EXPECT_TRUE(eventually([&] {
    const Bytes bytes = emulator_.nextOutput(number);
    return parsePalpateWrench(bytes.data(), bytes.size(), wrench);
  }));
  EXPECT_EQ(wrench.wrench.force.x(), 1.5);
  EXPECT_EQ(wrench.answers, 500u);
}

TEST_F(HidapiBus, LateLostAndRepeatedReportsChangeNothing) {
  const int number = emulator_.plug(arm());
  const auto device = openArm();
  std::uint64_t good = 0, bad = 0;
  std::uint32_t sequence = 10000;
  const auto send = [&](const Bytes& report, std::uint64_t& count) {
    ASSERT_TRUE(eventually([&] { return emulator_.send(number, report); }));
    ++count;
  };
  for (int i = 0; i < 3000; ++i) {
    sequence += i % 13 == 0 ? 40 : 1;  // 39 are lost
    send(stateReport(sequence), good);
    if (i % 3 == 0) send(stateReport(sequence), bad);
    if (i % 5 == 0) send(stateReport(sequence - 7), bad);
    if (i % 7 == 0) send(Bytes(13, 1), bad);
  }
  EXPECT_TRUE(eventually([&] {
    return device->counts().statesTaken == good && device->counts().reportsIgnored == bad;
  }));
  expectState(*device, number, sequence + 1);
}

TEST_F(HidapiBus, SurvivesTenThousandUnpluggings) {
  const int number = emulator_.plug(arm());
  const auto device = openArm();
  for (std::uint32_t cycle = 1; cycle <= 10000; ++cycle) {
    expectState(*device, number, cycle);
    emulator_.reset(number);
    ASSERT_TRUE(eventually([&] { return device->counts().connections == cycle + 1; })) << cycle;
  }
  EXPECT_EQ(emulator_.timesOpened(number), 10001);
  EXPECT_EQ(device->counts().statesTaken, 10000u);
}

TEST_F(HidapiBus, IsFoundAgainUnderAnotherPath) {
  int number = emulator_.plug(arm());
  emulator_.plug(arm("B2"));  // the same model, but not the same device
  const auto device = openArm();
  for (std::uint32_t cycle = 1; cycle <= 30; ++cycle) {
    expectState(*device, number, cycle);
    emulator_.unplug(number);
    DeviceState state;
    ASSERT_TRUE(eventually([&] { return !device->read(state); }));
    EXPECT_FALSE(device->write(push(1)));
    number = emulator_.plug(arm());
    ASSERT_TRUE(eventually([&] { return device->counts().connections == cycle + 1; }));
  }
  EXPECT_EQ(emulator_.timesOpened(1), 0);
}

TEST_F(HidapiBus, WithoutTheRightToOpenItSaysSo) {
  const int number = emulator_.plug(arm());
  emulator_.failToOpen(number, EACCES);
  EXPECT_TRUE(isRefused<std::runtime_error>([&] { openHidDevice(recordOf("Open arm")); },
                                            "'/dev/hidraw0' may not be opened: a udev rule"));
}

TEST_F(HidapiBus, AtAThousandReportsASecondStatesArriveWhileTheyAreNew) {
  const int number = emulator_.plug(arm());
  const auto device = openArm();
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  std::atomic<std::uint32_t> sent{0};
  int rendered = 0;
  std::thread firmware([&] {
    for (std::uint32_t i = 1; i <= 1000; ++i) {
      std::this_thread::sleep_until(begin + std::chrono::milliseconds(i));
      emulator_.send(number, stateReport(i));
      sent = i;
      while (!emulator_.nextOutput(number).empty()) ++rendered;
    }
  });
  std::vector<std::int64_t> ages;  // of the states that a servo loop reads, in reports
  for (int tick = 1; tick <= 1000; ++tick) {
    std::this_thread::sleep_until(begin + std::chrono::microseconds(1000 * tick + 500));
    DeviceState state;
    if (device->read(state))
      ages.push_back(std::int64_t{sent} - std::llround(1e6 * state.pose.position.x()));
    device->write(push(1));
  }
  firmware.join();
  ASSERT_GT(ages.size(), 500u);
  std::nth_element(ages.begin(), ages.begin() + static_cast<long>(ages.size() / 2), ages.end());
  EXPECT_LE(ages[ages.size() / 2], 2) << "in the median";
  EXPECT_TRUE(eventually([&] { return device->counts().statesTaken == 1000; }));
  EXPECT_GT(rendered, 300);
}

TEST_F(HidapiBus, RoundTripsKeepUpWithAServoLoop) {
  const int number = emulator_.plug(arm());
  const auto transport = openHidTransport("/dev/hidraw0");
  std::uint8_t bytes[64];
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const Bytes report = stateReport(i);
    ASSERT_TRUE(emulator_.send(number, report));
    ASSERT_EQ(transport->read(bytes, sizeof bytes, 1000), 64);
    ASSERT_TRUE(transport->write(bytes, sizeof bytes));
    ASSERT_EQ(emulator_.nextOutput(number), report);
  }
}

}  // namespace
}  // namespace palpate::test
