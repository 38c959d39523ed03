// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>

#include "haptics/hid_bus.h"

namespace palpate {

/// Under which path a device, or one of the same model, serial number and interface, is there now;
/// empty if it is not. Read from the system, as devices come and go meanwhile: hidapi's list
/// crashes then (0.13.1).
std::string hidrawPathOf(const HidRecord& record);

}  // namespace palpate
