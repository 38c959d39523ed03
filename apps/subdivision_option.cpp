// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "subdivision_option.h"

#include <CLI/CLI.hpp>
#include <map>

namespace palpate::app {
namespace {

const std::map<std::string, Subdivision> kNames{
    {"loop", Subdivision::Loop}, {"flat", Subdivision::Flat}, {"curved", Subdivision::Curved}};

}  // namespace

CLI::Option* addSubdivision(CLI::App& command, std::string& name) {
  return command
      .add_option(
          "--subdivision", name,
          "loop: the surface controls a smooth one; flat: it stands for itself; curved: for "
          "one through its vertices, smooth but for its sharp edges")
      ->check(CLI::IsMember(kNames))
      ->capture_default_str();
}

Subdivision subdivisionNamed(const std::string& name) {
  return kNames.at(name);
}

}  // namespace palpate::app
