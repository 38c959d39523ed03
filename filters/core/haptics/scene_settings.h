// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "contact/unilateral_contact_settings.h"
#include "haptics/force_safety.h"
#include "haptics/json_reader.h"
#include "haptics/servo_loop.h"

namespace palpate {

// Sections of a scene that are settings of one class each; what is left out is as that class has
// it. They throw std::invalid_argument, with the key that is unknown or wrong.

ServoSettings readServo(const Json& value);
SafetySettings readSafety(const Json& value);
UnilateralContactSettings readSolver(const Json& value);

}  // namespace palpate
