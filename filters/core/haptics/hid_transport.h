// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

namespace palpate {

/// An open HID device, used and closed by the thread that opened it.
class HidTransport {
 public:
  virtual ~HidTransport() = default;

  /// Waits for one report, with its number in front if it is numbered.
  /// @return its length, 0 if none came in time, negative if the device is gone.
  virtual int read(std::uint8_t* bytes, std::size_t room, int milliseconds) noexcept = 0;

  /// Sends an output or a feature report, its number first, 0 if it has none.
  /// @return false if it did not arrive.
  virtual bool write(const std::uint8_t* bytes, std::size_t count) noexcept = 0;
  virtual bool setFeature(const std::uint8_t* bytes, std::size_t count) noexcept = 0;

  /// @param bytes  whose first is the number of the report to get.
  /// @return its length with the number in front, negative if it did not come.
  virtual int getFeature(std::uint8_t* bytes, std::size_t room) noexcept = 0;
};

/// Opens a device, or gives null while it is not there.
using HidOpener = std::function<std::unique_ptr<HidTransport>()>;

}  // namespace palpate
