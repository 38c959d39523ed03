// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "commands.h"
#include "terminal.h"

int main(int argc, char** argv) {
  using namespace palpate::app;
  CLI::App program(
      "Palpate touches elastic surfaces: it precomputes the Green's functions of a body from its "
      "surface, presses it, and shows how stiff it feels.");
  program.name("palpate");
  program.set_version_flag("--version", PALPATE_VERSION);
  program.require_subcommand(1);
  program.footer(
      "A first session:\n"
      "  palpate refine data/kidney.vtp kidney.vtp --levels 2\n"
      "  palpate precompute kidney.vtp model.vtp\n"
      "  palpate press model.vtp pressed.vtp --at 0 0 0.03 --displacement 0 0 -0.005 \\\n"
      "      --radius 0.015 --image pressed.png\n"
      "  palpate stiffness model.vtp stiffness.vtp --radius-edges 2 --image stiffness.png\n"
      "`palpate COMMAND --help` tells about a command.");
  program.failure_message([](const CLI::App* app, const CLI::Error& error) {
    std::string name = "palpate";
    for (const CLI::App* sub : app->get_subcommands()) name += " " + sub->get_name();
    return "palpate: " + std::string(error.what()) + " (see `" + name + " --help`)\n";
  });
  for (const auto add : {addInfo, addRepair, addRefine, addPrecompute, addPress, addStiffness})
    add(program);
  catchInterrupts();
  try {
    CLI11_PARSE(program, argc, argv);
    return 0;
  } catch (const std::exception& failure) {
    endProgressBar();
    std::cerr << "palpate: " << failure.what() << "\n";
    return 1;
  }
}
