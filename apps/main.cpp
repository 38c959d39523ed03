// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "commands.h"
#include "progress_bar.h"
#include "terminal.h"

namespace {

/// CLI11 would say of a misspelt command that one is required.
void requireKnownCommand(const CLI::App& program, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::string known;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == argv[1]) return;
    known += (known.empty() ? "" : ", ") + command->get_name();
  }
  throw std::invalid_argument("there is no command '" + std::string(argv[1]) + "': choose one of " +
                              known + " (see `palpate --help`)");
}

/// The arguments, last first, as CLI11 wants them. It takes "-.5" for an option: such numbers get
/// the zero that they leave out.
std::vector<std::string> reversedArguments(int argc, char** argv) {
  std::vector<std::string> arguments;
  for (int i = argc - 1; i > 0; --i) {
    std::string text = argv[i];
    char* end = nullptr;
    if (text.rfind("-.", 0) == 0 && (std::strtod(text.c_str(), &end), *end == '\0'))
      text.insert(1, "0");
    arguments.push_back(text);
  }
  return arguments;
}

int run(CLI::App& program, int argc, char** argv) {
  requireKnownCommand(program, argc, argv);
  int status = 0;
  try {
    program.parse(reversedArguments(argc, argv));
  } catch (const CLI::ParseError& error) {
    status = program.exit(error);  // help and version, too
  }
  palpate::app::requirePrinted();
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace palpate::app;
  CLI::App program(
      "Palpate touches elastic surfaces: it precomputes the Green's functions of a body from its "
      "surface, presses it, and shows how stiff it feels.");
  program.name("palpate");
  program.set_version_flag("--version", PALPATE_VERSION);
  program.require_subcommand(1);
  program.footer(
      "To begin with:\n"
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
  for (const auto add :
       {addInfo, addRepair, addRefine, addRemesh, addOriginal, addPrecompute, addImport, addMeasure,
        addIdentify, addCorrect, addFoundation, addPress, addRecover, addGravity, addStiffness, addArtifacts,
        addAccuracy, addDevices, addTouch, addGrasp})
    add(program);
  catchInterrupts();
  try {
    return run(program, argc, argv);
  } catch (const std::exception& failure) {
    endProgressBar();
    std::cerr << "palpate: " << failure.what() << "\n";
    return 1;
  }
}
