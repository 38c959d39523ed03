// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "commands.h"
#include "haptics/hid_bus.h"
#include "terminal.h"

namespace palpate::app {
namespace {

std::string idOf(std::uint16_t vendor, std::uint16_t product) {
  char text[10];
  std::snprintf(text, sizeof text, "%04x:%04x", vendor, product);
  return text;
}

std::string abilityOf(const HidRecord& record) {
  switch (kindOf(record)) {
    case HidKind::PalpateReports:
      return "Palpate's reports: pose in, force and torque out";
    case HidKind::SpaceMouse:
      return "SpaceMouse: six axes in";
    case HidKind::ForceFeedback:
      return "force feedback (PID): axes in, a force per axis out";
    case HidKind::Joystick:
      return "joystick: axes in";
    case HidKind::Unknown:
      break;
  }
  return "not known: --description FILE tells what its reports mean";
}

void printDevice(const HidRecord& record) {
  const std::string name = record.name.empty() ? "without a name" : record.name;
  std::string text = idOf(record.vendor, record.product) + "  " + name;
  if (!record.serial.empty()) text += " (" + record.serial + ")";
  text += "  " + abilityOf(record);
  if (!mayOpen(record)) text += "; may not be opened: a udev rule must give this user the right to";
  printRow(record.path, text);
}

void printDevices() {
  std::vector<HidRecord> records;
  try {
    records = listHidDevices();
  } catch (const std::runtime_error& missing) {
    printRow("HID devices", std::string("cannot be listed: ") + missing.what());
    return;
  }
  if (records.empty()) printRow("HID devices", "none is plugged in");
  for (const HidRecord& record : records) printDevice(record);
}

void printBuiltIn() {
  printRow("mouse", "built in: a point that the mouse moves in a window");
  printRow("simulated", "built in: a hand with mass and damping that presses and lifts every 2 s");
  printRow("recording", "built in: replays what another device reported, from a file");
  printRow("glove", "built in: a hand of 22 joints, from a recording");
}

/// Says whether a description is one and whether its board is there.
void printDescription(const std::string& path) {
  const HidDescription description = readHidDescription(path);
  printRow("description of", description.info.name);
  printRow("device", idOf(description.vendor, description.product));
  printRow("state", std::to_string(description.input.length) + " bytes");
  printRow("wrench", description.output ? std::to_string(description.output->length) + " bytes"
                                        : "none, it is not pushed back");
  std::string place;
  for (const HidRecord& record : listHidDevices())
    if (record.vendor == description.vendor && record.product == description.product)
      place = record.path;
  printRow("plugged in", place.empty() ? "no" : "yes, " + place);
}

}  // namespace

void addDevices(CLI::App& program) {
  auto path = std::make_shared<std::string>();
  CLI::App* command =
      program.add_subcommand("devices", "Devices that a hand can touch with, and what each can do");
  command->add_option("--description", *path, "Check a description of a board's reports, JSON");
  command->footer(
      "Boards that are not known need a description of their reports: offsets in bytes, counted\n"
      "with the report's number, metres and newtons per count, null for what a board lacks.\n"
      "  palpate devices --description board.json\n"
      "{ \"name\": \"paddle\", \"vendor\": \"0x1209\", \"product\": \"0x0001\",\n"
      "  \"input\": { \"report\": 1, \"length\": 5, \"position\": [\n"
      "    { \"offset\": 1, \"type\": \"int16\", \"scale\": 1e-5 },\n"
      "    { \"offset\": 3, \"type\": \"int16\", \"scale\": 1e-5 }, null ] },\n"
      "  \"output\": { \"report\": 2, \"length\": 3, \"force\": [\n"
      "    { \"offset\": 1, \"type\": \"int16\", \"scale\": 1e-3 }, null, null ] },\n"
      "  \"limits\": { \"force\": 3, \"stiffness\": 600 } }");
  command->callback([path, command] {
    if (command->count("--description") > 0) return printDescription(*path);
    printDevices();
    printBuiltIn();
  });
}

}  // namespace palpate::app
