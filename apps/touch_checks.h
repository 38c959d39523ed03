// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

namespace palpate::app {

struct TouchOptions;

/// What one option alone does not tell. Files that the run would read, a scene's too, are not to be
/// written over, and no file is written twice.
/// @throws CLI::ParseError, std::invalid_argument or std::runtime_error with a sentence.
void requireSensible(const TouchOptions& options);

/// Whether a tool is moved by the mouse, which needs a window.
bool waitsForMouse(const TouchOptions& options);

}  // namespace palpate::app
