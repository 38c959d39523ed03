// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "haptics/haptic_device.h"

namespace palpate {

/// One number in a report of bytes: value = bias + scale * count, in SI units.
struct HidNumber {
  enum class Type { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32 };

  int offset = 0;  ///< in bytes; a report's own number, if it has one, is byte 0
  Type type = Type::Int16;
  double scale = 1, bias = 0;
};

/// Which bytes of a board's reports mean what, as a user writes it down in JSON:
///
///     {
///       "name": "Two-axis paddle", "vendor": "0x1209", "product": "0x0001",
///       "input": {
///         "report": 1, "length": 16,
///         "position": [{"offset": 4, "type": "int16", "scale": 1e-5},
///                      {"offset": 6, "type": "int16", "scale": 1e-5}, null],
///         "sequence": {"offset": 1, "type": "uint16"},
///         "buttons": {"offset": 3, "type": "uint8"}
///       },
///       "output": {
///         "report": 2, "length": 7,
///         "force": [{"offset": 1, "type": "int16", "scale": 1e-3},
///                   {"offset": 3, "type": "int16", "scale": 1e-3}, null]
///       },
///       "limits": {"force": 3, "stiffness": 600}
///     }
///
/// "length" counts a report's number, which is byte 0; "report" 0 is a device that does not number
/// its reports, whose data begin at byte 0. Types are int8, uint8, int16, uint16, int32, uint32 and
/// float32, least significant byte first; "scale" is metres, radians or newtons per count (default
/// 1), "bias" is added (default 0). A null is a component that the board lacks. "orientation" (four
/// numbers, w x y z), "joints", "sequence", "buttons", "torque", "output" and "limits" may be left
/// out.
struct HidDescription {
  using Component = std::optional<HidNumber>;
  struct Input {
    int report = 0, length = 0;
    std::vector<Component> position;     ///< 3
    std::vector<Component> orientation;  ///< none or 4, w x y z
    std::vector<Component> joints;
    Component sequence, buttons;
  };
  struct Output {
    int report = 0, length = 0;
    std::vector<Component> force;   ///< 3
    std::vector<Component> torque;  ///< none or 3
    Component sequence;
  };

  std::uint16_t vendor = 0, product = 0;
  DeviceInfo info;
  Input input;
  std::optional<Output> output;
};

/// @throws std::invalid_argument with the key that is missing, unknown or wrong.
HidDescription parseHidDescription(const std::string& json);
/// @throws as above, with the file's name; std::runtime_error if it cannot be opened.
HidDescription readHidDescription(const std::string& path);

}  // namespace palpate
