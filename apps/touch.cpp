// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "commands.h"
#include "library.h"
#include "terminal.h"
#include "touch/touch_window.h"

namespace palpate::app {
namespace {

void run(const TouchOptions& options) {
  static const auto touch = reinterpret_cast<TouchFunction>(
      loadFunction(kTouchLibrary, kTouchFunction, "there is nothing to touch with"));
  const std::string failure = touch(options);
  if (!failure.empty()) throw std::runtime_error(failure);
}

/// Negative numbers stand for options that were not given. CLI11's own check lets NaN pass.
void requireNotNegative(CLI::Option* option) {
  const auto complaint = [](const std::string& text) -> std::string {
    const double value = std::strtod(text.c_str(), nullptr);
    return value >= 0 ? "" : "must be a number that is not negative, not " + text;
  };
  option->check(CLI::Validator(complaint, ""));
}

void addLabOptions(CLI::App& command, TouchOptions& options) {
  command.add_flag("--lab", options.lab,
                   "Press a simulated device into the model instead, and find the stiffness it can "
                   "render against rate and damping");
  command.add_option("--at", options.at, "Where the lab presses: the nearest point of the surface")
      ->expected(3);
  requireNotNegative(command.add_option("--depth", options.depth, "How deep, in the points' unit"));
  command.add_option("--rates", options.rates, "Hz; by default 250 500 1000 2000 4000");
  command.add_option("--dampings", options.dampings, "N s/m; by default 0.1 0.5 2");
  command.add_option("--delays", options.delays, "Ticks from pose to force; by default 0 1");
}

void requireSensible(const TouchOptions& options) {
  if (options.model.empty() == options.scene.empty())
    throw CLI::RequiredError("a model or a --scene, one of the two,");
  if (options.headless && options.seconds <= 0 && !options.lab)
    throw CLI::RequiredError("--headless needs --seconds, which");
  if (!options.image.empty() && !options.headless && !options.lab)
    throw CLI::RequiredError("--image needs --headless or --lab, one of which");
}

}  // namespace

void addTouch(CLI::App& program) {
  auto options = std::make_shared<TouchOptions>();
  CLI::App* command = program.add_subcommand("touch", "Touch a model in a window, with forces");
  command->add_option("input", options->model, "A model from `palpate precompute`");
  command->add_option("--scene", options->scene,
                      "Or a scene, JSON: models, tools, devices and effects");
  auto* device = command->add_option(
      "--device", options->device,
      "mouse, scripted:FILE, simulated, hid, or hid:VVVV:PPPP as `palpate devices` lists it");
  command->add_option("--tool-radius", options->toolRadius,
                      "Touch with a ball of this radius instead of a point");
  requireNotNegative(command->add_option("--friction", options->friction,
                                         "Coulomb's coefficient; 0.3 by default"));
  requireNotNegative(
      command->add_option("--radius", options->maskRadius,
                          "Radius of a point's pressure mask; two mean edges by default"));
  requireNotNegative(command->add_option("--rigid-stiffness", options->stiffnessLimit,
                                         "Most stiffness that a point shows, N/m"));
  command->add_option("--rate", options->rate, "Ticks of the servo loop a second; 1000 by default");
  command
      ->add_option("--deformation", options->deformation,
                   "Whose displacements are computed: all, visible, contact or none")
      ->check(CLI::IsMember({"all", "visible", "contact", "none"}));
  command->add_option("--record", options->record, "Write the device's motion to this file");
  command->add_option("--forces", options->forces,
                      "Write the forces that a scripted device rendered to this file, CSV");
  requireNotNegative(command->add_option("--seconds", options->seconds, "End after this time"));
  command->add_flag("--headless", options->headless,
                    "Without a window, on virtual time: the same each time, bit for bit");
  command->add_flag("--plan", options->plan, "Print what a tick and a frame will compute, and end");
  requireWritable(
      command->add_option("--image", options->image, "Draw the last frame, or the lab's plot"),
      "pictures", ".png");
  addLabOptions(*command, *options);
  command->footer(
      "In the window: left button on the surface touches (wheel: deeper; Control: pull), right\n"
      "turns, middle moves. [ ] friction, , . mask, - + stiffness, w s wireframe, v stiffness,\n"
      "n anew, r reset, q quit.\n"
      "  palpate touch model.vtp\n"
      "  palpate touch model.vtp --device scripted:press.txt --headless --seconds 2 --image a.png\n"
      "  palpate touch model.vtp --lab --image zwidth.png");
  command->callback([options, device] {
    options->deviceGiven = device->count() > 0;
    requireSensible(*options);
    run(*options);
  });
}

void addGrasp(CLI::App& program) {
  auto options = std::make_shared<TouchOptions>();
  options->grasp = true;
  CLI::App* command =
      program.add_subcommand("grasp", "Grasp a model with a gloved hand, with a force per finger");
  command->add_option("input", options->model, "A model from `palpate precompute`")->required();
  command->add_option("--device", options->device,
                      "scripted:FILE, a glove's recording; by default a hand that closes");
  requireNotNegative(command->add_option("--hand-length", options->handLength,
                                         "Wrist to fingertip; by default to fit the model"));
  requireNotNegative(command->add_option("--friction", options->friction,
                                         "Coulomb's coefficient; 0.5 by default"));
  requireNotNegative(
      command->add_option("--frames", options->frames, "Frames to draw; 120 by default"));
  requireWritable(command->add_option("--image", options->image, "Draw the last frame"), "pictures",
                  ".png");
  command->footer("  palpate grasp model.vtp --image grasp.png");
  command->callback([options] { run(*options); });
}

}  // namespace palpate::app
