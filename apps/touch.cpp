// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "commands.h"
#include "contact/unilateral_contact_settings.h"
#include "library.h"
#include "terminal.h"
#include "touch/touch_window.h"
#include "touch_checks.h"

namespace palpate::app {
namespace {

constexpr double kFarthest = 1e6;
constexpr double kLargestFriction = 100;
constexpr double kMostSeconds = 86400;
constexpr double kMostFrames = 10000;

void run(TouchOptions& options) {
  options.isInterrupted = &isInterrupted;
  static const auto touch = reinterpret_cast<TouchFunction>(
      loadFunction(kTouchLibrary, kTouchFunction, "there is nothing to touch with"));
  const std::string failure = touch(options);
  if (!failure.empty()) throw std::runtime_error(failure);
}

/// CLI11's own checks let NaN pass, and take an empty text for zero.
double numberIn(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return text.empty() || *end != '\0' ? std::nan("") : value;
}

void requireBetween(CLI::Option* option, double least, double most) {
  const auto complaint = [least, most](const std::string& text) -> std::string {
    const double value = numberIn(text);
    if (value >= least && value <= most) return {};
    return "must be a number from " + number(least, 6) + " to " + number(most, 6) + ", not " + text;
  };
  option->check(CLI::Validator(complaint, ""));
}

void requirePositive(CLI::Option* option, double most) {
  const auto complaint = [most](const std::string& text) -> std::string {
    const double value = numberIn(text);
    if (value > 0 && value <= most) return {};
    return "must be a positive number of at most " + number(most, 6) + ", not " + text;
  };
  option->check(CLI::Validator(complaint, ""));
}

void addLabOptions(CLI::App& command, TouchOptions& options) {
  CLI::Option* lab =
      command.add_flag("--lab", options.lab,
                       "Press a simulated device into the model instead, and find the stiffness it "
                       "can render, the spectral norm |K|, against rate and damping");
  for (const char* other :
       {"--device", "--tool-radius", "--contacts", "--friction", "--rate", "--deformation",
        "--record", "--forces", "--seconds", "--headless", "--plan"})
    lab->excludes(other);
  CLI::Option* at =
      command
          .add_option("--at", options.at, "Where the lab presses: the nearest point of the surface")
          ->expected(3);
  CLI::Option* depth = command.add_option("--depth", options.depth, "How deep, m");
  CLI::Option* rates =
      command.add_option("--rates", options.rates, "Hz; by default 250 500 1000 2000 4000");
  CLI::Option* dampings =
      command.add_option("--dampings", options.dampings, "N s/m; by default 0.1 0.5 2");
  CLI::Option* delays =
      command.add_option("--delays", options.delays, "Ticks from pose to force; by default 0 1");
  requireBetween(at, -kFarthest, kFarthest);
  requirePositive(depth, kFarthest);
  requireBetween(rates, 10, 1e5);
  requireBetween(dampings, 1e-3, 1e3);
  requireBetween(delays, 0, 1000);
  for (CLI::Option* option : {at, depth, rates, dampings, delays}) option->needs(lab);
}

void addDeviceOptions(CLI::App& command, TouchOptions& options) {
  command.add_option(
      "--device", options.device,
      "mouse, scripted:FILE, simulated (a hand that presses and lifts every 2 s), hid, or "
      "hid:VVVV:PPPP as `palpate devices` lists it");
  requireBetween(
      command.add_option("--rate", options.rate,
                         "Ticks of the servo loop a second; 1000 by default. A device may report "
                         "less often, from 50 times a second on"),
      250, 10000);
  requireWritable(command.add_option("--record", options.record,
                                     "Write the device's motion and its rate to this file: the "
                                     "first 120 seconds, and a warning of what is left out"),
                  "recordings", "");
  requireWritable(command.add_option("--forces", options.forces,
                                     "Write the forces that a scripted device rendered to this "
                                     "file, CSV"),
                  "forces", "");
}

void addContactOptions(CLI::App& command, TouchOptions& options) {
  CLI::Option* ball =
      command.add_option("--tool-radius", options.toolRadius,
                         "Touch with a ball of this radius, m, instead of a point; of "
                         "a scene, in place of its first tool");
  requirePositive(ball, kFarthest);
  requireBetween(command.add_option("--friction", options.friction,
                                    "Coulomb's coefficient, up to 100; 0.3 by default"),
                 0, kLargestFriction);
  CLI::Option* mask =
      command.add_option("--radius", options.maskRadius,
                         "Radius of a point's pressure mask, m; two mean edges by default");
  requireBetween(mask, 0, kFarthest);
  CLI::Option* shape =
      command
          .add_option("--mask", options.maskShape,
                      "Functional of a point's pressure mask over its radius: linear (default), "
                      "uniform, gaussian or hertzian")
          ->check(CLI::IsMember({"linear", "uniform", "gaussian", "hertzian"}));
  CLI::Option* stiffness =
      command.add_option("--rigid-stiffness", options.stiffnessLimit,
                         "Stiffness k of fixed vertices, N/m; points show none of a larger "
                         "Frobenius norm than theirs, sqrt(3) k; 0 for the stiffest free vertex, "
                         "of tools with a shape 10 E times the mean edge");
  requireBetween(stiffness, 0, 1e15);
  ball->excludes(mask)->excludes(shape);
  requireBetween(command.add_option("--contacts", options.contacts,
                                    "Most contacts of a ball or another shape at a time, up to "
                                    "2000; by default as many as the model has vertices, from 128 "
                                    "to 500"),
                 1, UnilateralContactSettings::kMostContacts);
  command
      .add_option("--deformation", options.deformation,
                  "Whose displacements are computed: all, visible, contact or none")
      ->check(CLI::IsMember({"all", "visible", "contact", "none"}));
}

}  // namespace

void addTouch(CLI::App& program) {
  auto options = std::make_shared<TouchOptions>();
  CLI::App* command = program.add_subcommand("touch", "Touch a model in a window, with forces");
  command->add_option("input", options->model, "A model from `palpate precompute`");
  command->add_option("--scene", options->scene,
                      "Or a scene, JSON: models, tools, devices and effects");
  addDeviceOptions(*command, *options);
  addContactOptions(*command, *options);
  requirePositive(command->add_option("--seconds", options->seconds, "End after this time"),
                  kMostSeconds);
  command->add_flag("--headless", options->headless,
                    "Without a window, on virtual time: the same each time, bit for bit");
  CLI::Option* plan = command->add_flag("--plan", options->plan,
                                        "Print what a tick and a frame will compute, and end");
  CLI::Option* image =
      command->add_option("--image", options->image, "Draw the last frame, or the lab's plot");
  requireWritable(image, "pictures", ".png");
  plan->excludes("--record")->excludes("--forces")->excludes(image);
  addLabOptions(*command, *options);
  command->footer(
      "In the window: left button on the surface touches (wheel: deeper; Control: pull), right\n"
      "turns, middle moves. [ ] friction, , . mask, - + stiffness, w s wireframe, v stiffness,\n"
      "n anew, r reset, q quit.\n"
      "  palpate touch model.vtp\n"
      "  palpate touch model.vtp --device scripted:press.txt --headless --seconds 2 --image a.png\n"
      "  palpate touch model.vtp --lab --image zwidth.png");
  command->callback([options, command] {
    options->deviceGiven = command->count("--device") > 0;
    requireSensible(*options);
    options->waitsForMouse = waitsForMouse(*options);
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
  requirePositive(command->add_option("--hand-length", options->handLength,
                                      "Wrist to fingertip, m; by default to fit the model"),
                  kFarthest);
  requireBetween(command->add_option("--friction", options->friction,
                                     "Coulomb's coefficient, up to 100; 0.5 by default"),
                 0, kLargestFriction);
  requireBetween(command->add_option("--frames", options->frames, "Frames to draw; 120 by default"),
                 1, kMostFrames);
  requireWritable(command->add_option("--image", options->image, "Draw the last frame"), "pictures",
                  ".png");
  command->footer("  palpate grasp model.vtp --image grasp.png");
  command->callback([options] { run(*options); });
}

}  // namespace palpate::app
