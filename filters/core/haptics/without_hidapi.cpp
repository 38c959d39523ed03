// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// What remains of this room's hidapi source when the library is built without it.

#include <stdexcept>

#include "haptics/hid_bus.h"

namespace palpate {
namespace {

constexpr const char* kMissing =
    "HID devices need hidapi, which this build of Palpate was made without";

}  // namespace

std::vector<HidRecord> listHidDevices() {
  throw std::runtime_error(kMissing);
}

std::unique_ptr<HidTransport> openHidTransport(const std::string&) {
  throw std::runtime_error(kMissing);
}

}  // namespace palpate
