// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <read_files.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInteriorProbe.h>
#include <vtkNew.h>
#include <vtkOriginalSurface.h>
#include <vtkPointContact.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSurfaceStress.h>

#include <array>
#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "commands.h"
#include "picture/picture.h"
#include "terminal.h"

namespace palpate::app {
namespace {

struct Options {
  std::string input, output;
  std::vector<double> point, displacement, force, torque;
  std::vector<double> probes;  // three each
  bool stress = false, original = false;
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

void printStress(vtkPolyData* pressed) {
  double range[2];
  pressed->GetCellData()->GetArray("VonMisesStress")->GetRange(range);
  printRow("largest von Mises stress at the surface, Pa", number(range[1]));
}

/// The fields at these places, or null if there are none.
vtkSmartPointer<vtkPolyData> probe(vtkPolyData* pressed, const std::vector<double>& places) {
  if (places.empty()) return nullptr;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (std::size_t i = 0; i < places.size(); i += 3) points->InsertNextPoint(&places[i]);
  vtkNew<vtkPolyData> set;
  set->SetPoints(points);
  vtkNew<vtkInteriorProbe> probe;
  probe->SetInputData(pressed);
  probe->SetProbeData(set);
  const auto probed = run(probe);
  vtkDataArray* inside = probed->GetPointData()->GetArray("InsideMaterial");
  for (vtkIdType i = 0; i < inside->GetNumberOfTuples(); ++i)
    if (inside->GetComponent(i, 0) == 0)
      throw std::invalid_argument("the probe at " + vectorText(points->GetPoint(i)) +
                                  " is not inside the body");
  return probed;
}

void printProbes(vtkPolyData* probed) {
  for (vtkIdType i = 0; probed && i < probed->GetNumberOfPoints(); ++i) {
    const auto tuple = [&](const char* name) {
      return probed->GetPointData()->GetArray(name)->GetTuple(i);
    };
    printRow("probe", vectorText(probed->GetPoint(i)));
    printRow("  moves by", vectorText(tuple("Displacement")));
    printRow("  von Mises stress, Pa", number(*tuple("VonMisesStress")));
    printRow("  principal stresses, Pa", vectorText(tuple("PrincipalStress")));
    if (*tuple("EdgesFromSurface") < 1)
      printWarning("the probe at " + vectorText(probed->GetPoint(i)) +
                   " is less than an edge below the surface, whose kinks stresses show there");
  }
}

void drawContact(vtkPolyData* pressed, const PictureOptions& options) {
  Picture picture;
  picture.towardsViewer = options.towardsViewer(pressed);
  View before{pressed, "undeformed (support in blue)", "", "", false, {}};
  View after{pressed, "pressed", "Displacement", "displacement\n(m)", true, {}};
  if (pressed->GetCellData()->HasArray("VonMisesStress"))
    after = {pressed, "pressed", "VonMisesStress", "von Mises\n(Pa)", true, {}};
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
  command->add_flag("--stress", options->stress,
                    "Also strain and stress at the surface; the picture shows von Mises'");
  command
      ->add_option("--probe", options->probes,
                   "Also displacement and stress at these places inside the body")
      ->type_name("X Y Z ...");
  command->add_flag("--original", options->original,
                    "Write and draw the surface that the model's was remeshed from (precompute "
                    "--edge-length), not the model");
  options->picture.addTo(*command, "the surface before and after");
  command->footer(
      "Give the mask the radius of what touches: a single vertex is softer the finer the mesh.\n"
      "  palpate press model.vtp pressed.vtp --at 0 0 0.03 --force 0 0 -0.5 --radius 0.01");
  command->callback([options] {
    if (options->displacement.empty() && options->force.empty())
      throw CLI::RequiredError("--displacement or --force");
    options->picture.requireSensible();
    if (options->probes.size() % 3 != 0)
      throw std::invalid_argument("--probe takes three coordinates a place");
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
    auto pressed = run(contact);
    if (options->stress) {
      vtkNew<vtkSurfaceStress> stress;
      stress->SetInputData(pressed);
      pressed = run(stress);
    }
    const auto probed = probe(pressed, options->probes);
    auto shown = pressed;
    if (options->original) {
      vtkNew<vtkOriginalSurface> original;
      original->SetInputData(pressed);
      shown = run(original);
    }
    if (!options->output.empty()) writeSurface(shown, options->output);
    if (!options->picture.path.empty()) drawContact(shown, options->picture);
    printContact(pressed);
    if (options->stress) printStress(pressed);
    printProbes(probed);
    printValidity(pressed, "press less, or spread it by a larger mask");
  });
}

}  // namespace palpate::app
