// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <read_files.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointContact.h>
#include <vtkPolyData.h>

#include <array>
#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "commands.h"
#include "picture/picture.h"
#include "terminal.h"

namespace palpate::app {
namespace {

struct Options {
  std::string input, output;
  std::vector<double> point, displacement, force, torque;
  MaskOptions mask;
  PictureOptions picture;
};

void printContact(vtkPolyData* pressed) {
  const auto force = fieldVector(pressed, "ContactForce");
  const auto from = fieldVector(pressed, "ContactPoint");
  const auto elastic = fieldVector(pressed, "ElasticContactPoint");
  const auto haptic = fieldVector(pressed, "HapticContactPoint");
  printRow("contact force, N", vectorText(force.data()));
  printRow("its length, N", number(std::hypot(force[0], force[1], force[2])));
  printRow("contact point", vectorText(from.data()));
  std::array<double, 3> moved, asked;
  for (int c = 0; c < 3; ++c) {
    moved[c] = elastic[c] - from[c];
    asked[c] = haptic[c] - from[c];
  }
  printRow("moves by", vectorText(moved.data()));
  printRow("probe moves by", vectorText(asked.data()));
  printRow("deformed contact point", vectorText(elastic.data()));
  printRow("probe", vectorText(haptic.data()));
  if (pressed->GetFieldData()->HasArray("ContactRotation"))
    printRow("turns by, rad", vectorText(fieldVector(pressed, "ContactRotation").data()));
}

void drawContact(vtkPolyData* pressed, const PictureOptions& options) {
  Picture picture;
  picture.towardsViewer = options.towardsViewer(pressed);
  View before{pressed, "undeformed (support in blue)", "", "", false, {}};
  View after{pressed, "pressed", "Displacement", "displacement\n(m)", true, {}};
  if (options.range.size() == 2) after.range = {options.range[0], options.range[1]};
  picture.views = {before, after};
  drawPicture(picture, options.path);
}

}  // namespace

void addPress(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("press", "Press or pull a model at a point");
  command->add_option("input", options->input, "A model from `palpate precompute`")->required();
  requireWritable(command->add_option("output", options->output,
                                      "The model with displacements and tractions, .vtp"),
                  "models", ".vtp");
  command->add_option("--at", options->point, "Where: the nearest point of the surface is taken")
      ->expected(3)
      ->required();
  auto* displacement =
      command
          ->add_option("--displacement", options->displacement, "By how much, in the points' unit")
          ->expected(3);
  auto* force = command->add_option("--force", options->force, "Or with what force on the body, N")
                    ->expected(3);
  displacement->excludes(force);
  command
      ->add_option("--torque", options->torque,
                   "And with what torque, N m, spread by a mask of three vertices or more")
      ->expected(3);
  options->mask.addTo(*command);
  options->picture.addTo(*command, "the surface before and after");
  command->footer(
      "Give the mask the radius of what touches: a single vertex is softer the finer the mesh.\n"
      "  palpate press model.vtp pressed.vtp --at 0 0 0.03 --force 0 0 -0.5 --radius 0.01");
  command->callback([options] {
    if (options->displacement.empty() && options->force.empty())
      throw CLI::RequiredError("--displacement or --force");
    options->picture.requireSensible();
    vtkNew<vtkPointContact> contact;
    contact->SetInputData(readSurface(options->input));
    contact->SetPoint(options->point.data());
    if (options->force.empty())
      contact->SetDisplacement(options->displacement.data());
    else
      contact->SetForce(options->force.data());
    options->mask.applyTo(contact);
    if (!options->torque.empty()) contact->SetTorque(options->torque.data());
    contact->SetRigidStiffness(options->mask.rigidStiffness);
    contact->SetMeasure(options->mask.measureNumber());
    const auto pressed = run(contact);
    if (!options->output.empty()) writeSurface(pressed, options->output);
    if (!options->picture.path.empty()) drawContact(pressed, options->picture);
    printContact(pressed);
  });
}

}  // namespace palpate::app
