// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "accuracy/body_levels.h"
#include "accuracy/settings.h"

namespace palpate::app {

/// The knobs of a query and a method, in the order of the tables.
std::vector<std::string> knobsOf(QueryKind query, Method method, bool isPointSource);

/// @param whose  what they are knobs of, for the sentence.
/// @throws std::invalid_argument naming a chosen one that is not among those known.
void requireKnown(const std::vector<std::string>& chosen, const std::vector<std::string>& known,
                  const std::string& whose);

/// All settings that are tried: each knob's values with the others at the base's, those that go
/// with the level on every level. The base itself is a trial of the level.
/// @param knobs  some of knobsOf.
/// @throws std::invalid_argument for a knob that has nothing to vary on this body.
std::vector<Trial> trialsOf(const std::vector<std::string>& knobs, const Setting& base,
                            const std::vector<int>& levels, const BodyLevels& body);

}  // namespace palpate::app
