// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "contact/unilateral_contact_settings.h"
#include "haptics/force_safety.h"
#include "haptics/servo_loop.h"

namespace palpate {

class JsonSection;

// Sections of a scene that are settings of one class each; what is left out is as that class has
// it. They throw std::invalid_argument, with the key that is unknown or wrong.

ServoSettings readServo(JsonSection& section);
SafetySettings readSafety(JsonSection& section);
UnilateralContactSettings readSolver(JsonSection& section);

}  // namespace palpate
