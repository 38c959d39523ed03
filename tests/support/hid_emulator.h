// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace palpate::test {

/// A USB HID device as the kernel would show it.
struct EmulatedModel {
  std::string name, serial;
  std::uint16_t vendor = 0, product = 0;
  std::vector<std::uint8_t> descriptor;
  /// Called in the order of the requests; outputs, if this is set, at the latest before the next
  /// feature.
  std::function<bool(const std::vector<std::uint8_t>&)> onOutput, onSetFeature;
  std::function<std::vector<std::uint8_t>(std::uint8_t)> onGetFeature;
};

/// A machine whose only HID devices are emulated ones: their sysfs and udev records come from
/// umockdev, their device nodes from this program itself, which answers when its own libraries open
/// /dev/hidraw*: each open node is one end of a socket that keeps reports apart. libudev and hidapi
/// are the real ones.
///
/// Compile hid_emulator.cpp into the test program itself, with its symbols exported, and run that
/// under umockdev-wrapper. A device may be used from one thread and opened from another.
class HidEmulator {
 public:
  using Bytes = std::vector<std::uint8_t>;

  HidEmulator();
  ~HidEmulator();

  /// @return the number of its node, /dev/hidraw<number>.
  int plug(const EmulatedModel& model);
  /// Takes node and records away; whoever has it open reads that it is gone.
  void unplug(int number);
  /// Only cuts it off, keeping its records: it can be opened again. Much faster.
  void reset(int number);
  /// What opening it fails with, e.g. EACCES; 0 for success.
  void failToOpen(int number, int error);

  /// Sends a report to whoever has it open.
  /// @return false if nobody has, or some hundred have not been read.
  bool send(int number, const Bytes& report);
  /// Gives its onOutput what was written to it since.
  void takeOutputs(int number);
  /// The next report that was written to it; empty if there is none.
  Bytes nextOutput(int number);
  /// Times that it was opened.
  int timesOpened(int number) const;

 private:
  struct Testbed;
  std::unique_ptr<Testbed> testbed_;
};

}  // namespace palpate::test
