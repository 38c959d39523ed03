// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/hid_protocol.h"

#include <gtest/gtest.h>

#include "haptics/palpate_report.h"
#include "support/fake_hid.h"
#include "support/pid_joystick.h"
#include "support/refusals.h"

namespace palpate::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

bool take(HidProtocol& protocol, const Bytes& report) {
  return protocol.take(report.data(), report.size());
}

Wrench force(double x, double y, double z) {
  return {Eigen::Vector3d(x, y, z), Eigen::Vector3d::Zero()};
}

TEST(SpaceMouseProtocol, RestsAtTheOriginAndTakesWhatChanges) {
  FakeHid hid;
  const auto transport = hid.opener()();
  const auto protocol = makeSpaceMouseProtocol({0.05, 0.8, 1});
  EXPECT_TRUE(protocol->reportsOnlyChanges());
  EXPECT_FALSE(protocol->rendersWrenches());
  DeviceInfo info;
  protocol->start(*transport, info);
  ASSERT_TRUE(protocol->pose());
  EXPECT_EQ(protocol->pose()->position, Eigen::Vector3d::Zero());
  EXPECT_TRUE(take(*protocol, {1, 0x5e, 0x01, 0, 0, 0, 0}));
  EXPECT_EQ(protocol->pose()->position.x(), 0.05);
  EXPECT_FALSE(take(*protocol, {0x17, 100})) << "the battery";
  protocol->start(*transport, info);
  EXPECT_EQ(protocol->pose()->position.x(), 0) << "another one may have been plugged in";
  EXPECT_EQ(info.largestForce, 0);
}

class JoystickProtocol : public testing::Test {
 protected:
  JoystickProtocol() {
    hid_.onSetFeature = [this](const Bytes& b) { return stick_.takeFeature(b.data(), b.size()); };
    hid_.onGetFeature = [this](std::uint8_t number) { return stick_.feature(number); };
    hid_.onOutput = [this](const Bytes& b) { return stick_.takeOutput(b.data(), b.size()); };
    transport_ = hid_.opener()();
  }

  FakeHid hid_;
  PidJoystick stick_;
  std::unique_ptr<HidTransport> transport_;
  DeviceInfo info_;
};

TEST_F(JoystickProtocol, ForcesActOnTheirAxes) {
  const auto protocol =
      makeJoystickProtocol(HidDescriptor(PidJoystick::descriptor()), {0.05, 1, 2});
  EXPECT_TRUE(protocol->rendersWrenches());
  protocol->start(*transport_, info_);
  EXPECT_EQ(info_.largestForce, 2);
  EXPECT_TRUE(stick_.isEnabled);
  ASSERT_EQ(stick_.effects.size(), 2u);
  // Half of the largest to the right, all of it away from the hand; up is no axis of a stick.
  EXPECT_TRUE(protocol->render(*transport_, force(1, 7, -2)));
  EXPECT_EQ(stick_.effects[1].axes, 1);
  EXPECT_EQ(stick_.effects[1].magnitude, 5000);
  EXPECT_EQ(stick_.effects[2].axes, 2);
  EXPECT_EQ(stick_.effects[2].magnitude, -10000);
  EXPECT_TRUE(stick_.effects[1].isPlaying && stick_.effects[2].isPlaying);
  protocol->rest(*transport_);
  EXPECT_EQ(stick_.effects[1].magnitude, 0);
  EXPECT_EQ(stick_.effects[2].magnitude, 0);
}

TEST_F(JoystickProtocol, ANegativeForceTurnsTheSignOfMagnitudes) {
  const auto protocol =
      makeJoystickProtocol(HidDescriptor(PidJoystick::descriptor()), {0.05, 1, -2});
  protocol->start(*transport_, info_);
  EXPECT_EQ(info_.largestForce, 2);
  protocol->render(*transport_, force(1, 0, 0));
  EXPECT_EQ(stick_.effects[1].magnitude, -5000);
}

TEST_F(JoystickProtocol, PluggedInAgainItsEffectsAreMadeAgain) {
  const auto protocol = makeJoystickProtocol(HidDescriptor(PidJoystick::descriptor()), {});
  protocol->start(*transport_, info_);
  stick_ = PidJoystick();
  protocol->start(*transport_, info_);
  EXPECT_EQ(stick_.effects.size(), 2u);
  EXPECT_TRUE(protocol->render(*transport_, force(1, 0, 0)));
}

TEST_F(JoystickProtocol, ADeviceThatRefusesEffectsIsRefused) {
  const auto protocol = makeJoystickProtocol(HidDescriptor(PidJoystick::descriptor()), {});
  hid_.onGetFeature = [](std::uint8_t number) { return Bytes{number, 0, 2, 0, 0}; };
  EXPECT_TRUE(isRefused<std::runtime_error>([&] { protocol->start(*transport_, info_); },
                                            "has no room for an effect"));
  hid_.onSetFeature = [](const Bytes&) { return false; };
  EXPECT_TRUE(isRefused<std::runtime_error>([&] { protocol->start(*transport_, info_); },
                                            "creates no effect"));
  hid_.onOutput = [](const Bytes&) { return false; };
  EXPECT_TRUE(isRefused<std::runtime_error>([&] { protocol->start(*transport_, info_); },
                                            "does not take reports of force feedback"));
}

TEST_F(JoystickProtocol, WithoutForceFeedbackAStickIsRead) {
  const auto protocol =
      makeJoystickProtocol(HidDescriptor({0x05, 0x01, 0x09, 0x30, 0x15, 0x81, 0x25, 0x7f, 0x75,
                                          0x08, 0x95, 0x01, 0x81, 0x02}),
                           {0.05, 1, 1});
  protocol->start(*transport_, info_);
  EXPECT_FALSE(protocol->rendersWrenches());
  EXPECT_EQ(info_.largestForce, 0);
  EXPECT_TRUE(take(*protocol, {127}));
  EXPECT_EQ(protocol->pose()->position.x(), 0.05);
}

TEST(DescribedProtocol, NumbersOfAnyWidthWrapAround) {
  HidDescription description;
  description.input.length = 2;
  description.input.position = {HidNumber{1, HidNumber::Type::Int8, 0.01, 0}, {}, {}};
  description.input.sequence = HidNumber{0, HidNumber::Type::Uint8, 1, 0};
  FakeHid hid;
  const auto transport = hid.opener()();
  const auto protocol = makeDescribedProtocol(description);
  DeviceInfo info;
  protocol->start(*transport, info);
  EXPECT_FALSE(protocol->pose()) << "not known before the first report";
  EXPECT_TRUE(take(*protocol, {254, 1}));
  EXPECT_TRUE(take(*protocol, {255, 2}));
  EXPECT_TRUE(take(*protocol, {1, 3}));
  EXPECT_FALSE(take(*protocol, {255, 4}));
  EXPECT_FALSE(take(*protocol, {1, 5}));
  EXPECT_EQ(protocol->pose()->position.x(), 0.03);
  EXPECT_FALSE(protocol->rendersWrenches());
}

TEST(DescribedProtocol, ItsWrenchesGoWhereTheDescriptionSays) {
  HidDescription description;
  description.info.largestForce = 4;
  description.input.length = 1;
  description.input.position = {HidNumber{0, HidNumber::Type::Int8, 1, 0}, {}, {}};
  description.output.emplace();
  description.output->report = 3;
  description.output->length = 3;
  description.output->force = {{}, HidNumber{1, HidNumber::Type::Int8, 0.1, 0}, {}};
  description.output->sequence = HidNumber{2, HidNumber::Type::Uint8, 1, 0};
  FakeHid hid;
  const auto transport = hid.opener()();
  const auto protocol = makeDescribedProtocol(description);
  DeviceInfo info;
  protocol->start(*transport, info);
  EXPECT_EQ(info.largestForce, 4);
  EXPECT_TRUE(protocol->render(*transport, force(9, -1, 9)));
  protocol->rest(*transport);
  EXPECT_EQ(hid.outputs(), (std::vector<Bytes>{{3, 0xf6, 1}, {3, 0, 2}}));
}

TEST(Protocols, ScalesWithoutMeaningAreRefused) {
  for (const AxisScale& scale : {AxisScale{0, 1, 1}, AxisScale{1, -1, 1}, AxisScale{1, 1, 0}})
    EXPECT_TRUE(isRefused([&] { makeSpaceMouseProtocol(scale); }, "reach of a deflected device"));
}

}  // namespace
}  // namespace palpate::test
