// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

namespace palpate::app {

/// Draws how far work has come, on stderr where that is a terminal. @return true, for callbacks
/// that ask whether to go on.
bool drawProgress(double fraction, const char* stage);
/// Ends the line of a bar that was under way.
void endProgressBar();

}  // namespace palpate::app
