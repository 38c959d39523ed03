// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>

#include "mesh/subdivision.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace palpate::app {

/// The option --subdivision of commands that refine.
/// @param name  its default, and what is chosen.
CLI::Option* addSubdivision(CLI::App& command, std::string& name);

/// @param name  that the option took.
Subdivision subdivisionNamed(const std::string& name);

}  // namespace palpate::app
