// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>

namespace palpate::app {

/// A function of one of the program's own libraries, which is loaded on first use: what needs
/// rendering or devices stays out of everything else.
/// @param library  its file's name.
/// @param purpose  of the sentence "<purpose>: <why not>".
/// @throws std::runtime_error if it cannot be loaded.
void* loadFunction(const std::string& library, const char* function, const std::string& purpose);

}  // namespace palpate::app
