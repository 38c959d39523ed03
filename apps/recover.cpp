// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <read_files.h>
#include <vtkContactRecovery.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>
#include <memory>

#include "commands.h"
#include "file_kinds.h"
#include "finite_check.h"
#include "measurement_options.h"
#include "picture/picture.h"
#include "report/identification_page.h"
#include "terminal.h"

namespace palpate::app {
namespace {

struct Options {
  std::string input, table, output, probe;
  TableOptions reading;
  double friction = 0.5, noise = 0, radius = -1;
  int samples = 50, seed = 1;
  bool firmSupport = false;
  PictureOptions picture;
  ReportOption report;
};

void addOptions(CLI::App& command, Options& o) {
  command.add_option("input", o.input, "A model from `palpate precompute`")->required();
  command
      .add_option("table", o.table,
                  "Displacements of points of its surface: a table (.csv), or a .vtp or .vtu that "
                  "carries it")
      ->required();
  requireWritable(command
                      .add_option("output", o.output,
                                  "The model with what was recovered: tractions, "
                                  "displacements, pressures, contacts, .vtp")
                      ->required(),
                  "models", ".vtp");
  o.reading.addTo(command);
  command.add_option("--probe", o.probe, "Whose displacements, where the table has several");
  command.add_option("--friction", o.friction, "Largest tangential over normal force; 0 for none")
      ->check(isFinite())
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command
      .add_option("--noise", o.noise,
                  "Standard deviation of a displacement's component, m; by default the table's sd, "
                  "or what the residuals tell")
      ->check(isFinite())
      ->check(CLI::NonNegativeNumber);
  command
      .add_option(
          "--patch-radius", o.radius,
          "Of the patches that forces are spread over, m; 0 for single vertices; by default "
          "as the displacements tell")
      ->check(isFinite())
      ->check(CLI::NonNegativeNumber);
  command.add_flag("--firm-support", o.firmSupport,
                   "The support gives way exactly as the model's does");
  command.add_option("--samples", o.samples, "Of noise, that the deviations are found from")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command.add_option("--seed", o.seed, "Of these")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()))
      ->capture_default_str();
  o.picture.addTo(command, "how the surface moves and the pressures on it");
  o.report.addTo(command, "what was found, how sure it is and how it fits");
  command.footer(
      "A table has a line of names, then a line for each displacement: vertex (or x, y, z, at "
      "rest),\n"
      "  u_x .. _z, empty where not seen, and optionally sd (or sd_x .. _z), its standard "
      "deviation,\n"
      "  and probe, where it holds several cases; what `palpate measure` writes besides is passed "
      "over.\n"
      "  palpate recover model.vtp seen.csv contacts.vtp --length-unit mm --image contacts.png");
}

std::array<double, 3> tuple(vtkPolyData* surface, const char* name, vtkIdType i) {
  std::array<double, 3> values;
  surface->GetFieldData()->GetArray(name)->GetTuple(i, values.data());
  return values;
}

double component(vtkPolyData* surface, const char* name, vtkIdType i) {
  return surface->GetFieldData()->GetArray(name)->GetComponent(i, 0);
}

std::string withDeviation(const std::array<double, 3>& value,
                          const std::array<double, 3>& deviation) {
  return vectorText(value.data()) + " +- " + vectorText(deviation.data());
}

double lengthOf(const std::array<double, 3>& v) {
  return std::hypot(v[0], v[1], v[2]);
}

void printContacts(vtkPolyData* model) {
  const vtkIdType count = model->GetFieldData()->GetArray("ContactForce")->GetNumberOfTuples();
  printRow("contacts", std::to_string(count));
  for (vtkIdType c = 0; c < count; ++c) {
    const auto force = tuple(model, "ContactForce", c);
    printRow("contact " + std::to_string(c + 1),
             number(lengthOf(force)) + " N at " +
                 vectorText(tuple(model, "ContactCentre", c).data()) + " +- " +
                 number(component(model, "ContactCentreDeviation", c), 2) + " m");
    printRow("  force, N", withDeviation(force, tuple(model, "ContactForceDeviation", c)));
    printRow("  torque about its centre, N m", vectorText(tuple(model, "ContactTorque", c).data()));
    const double peak = component(model, "ContactPeak", c);
    printRow("  largest pressure", number(component(model, "ContactPeakPressure", c)) +
                                       " Pa at vertex " + number(peak, 9) + " (" +
                                       vectorText(model->GetPoint(static_cast<vtkIdType>(peak))) +
                                       ")");
    printRow("  area, m^2", number(component(model, "ContactArea", c)));
  }
  printRow("all together, N", withDeviation(tuple(model, "RecoveredForce", 0),
                                            tuple(model, "RecoveredForceDeviation", 0)));
}

void printFit(vtkPolyData* model) {
  printRow("displacements",
           std::to_string(model->GetFieldData()->GetArray("ObservedPoint")->GetNumberOfTuples()));
  printRow("noise", number(fieldNumber(model, "ObservationNoise", -1), 3) + " m");
  if (const double misfit = fieldNumber(model, "ObservationMisfit", -1); misfit >= 0)
    printRow("noise over that given", number(misfit, 3));
  const double radius = fieldNumber(model, "LoadPatchRadius", 0);
  printRow("patches", radius > 0 ? "radius " + number(radius, 3) + " m" : "single vertices");
  if (const double share = fieldNumber(model, "SupportYieldShare", 0); share > 0)
    printRow("support yields otherwise", percent(share) + " of the displacements");
  if (const double error = fieldNumber(model, "ErrorEstimate", -1); error >= 0)
    printRow("error of the model itself", percent(error) + " (what the mesh may add to forces)");
}

void draw(vtkPolyData* model, const PictureOptions& options) {
  Picture picture;
  picture.towardsViewer = options.towardsViewer(model);
  View moved{model, "recovered displacement", "Displacement", "displacement\n(m)", true, {}};
  View pressed{model, "recovered pressure", "ContactPressure", "pressure\n(Pa)", false, {}};
  if (options.range.size() == 2) pressed.range = {options.range[0], options.range[1]};
  picture.views = {moved, pressed};
  drawPicture(picture, options.path);
}

}  // namespace

void addRecover(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("recover", "Recover contacts from the displacements that they cause");
  addOptions(*command, *options);
  command->callback([options] {
    options->picture.requireSensible();
    vtkNew<vtkContactRecovery> filter;
    filter->SetInputData(readSurface(options->input));
    if (isTableInArrays(options->table))
      filter->SetInputData(1, readTable(options->table));
    else
      filter->SetDisplacementFileName(options->table.c_str());
    filter->SetLengthUnit(options->reading.lengthUnit.c_str());
    filter->SetProbeName(options->probe.c_str());
    filter->SetFriction(options->friction);
    filter->SetNoise(options->noise);
    filter->SetPatchRadius(options->radius);
    filter->SetYieldingSupport(!options->firmSupport);
    filter->SetNumberOfSamples(options->samples);
    filter->SetSeed(options->seed);
    filter->SetPlaceTolerance(options->reading.placeTolerance);
    const auto model = run(filter);
    writeSurface(model, options->output);
    options->report.write([&](const RunDescription& run) { return recoveryPage(model, run); });
    if (!options->picture.path.empty()) draw(model, options->picture);
    printContacts(model);
    printFit(model);
    for (const std::string& warning : fieldStrings(model, "RecoveryWarnings"))
      printWarning(warning);
    printValidity(model, "let less press");
  });
}

}  // namespace palpate::app
