// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <read_files.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkGreensFunctionIdentification.h>
#include <vtkIdentificationByCrossValidation.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkReferenceBoundaryConditions.h>
#include <vtkSolidBoundary.h>
#include <vtkStiffnessFieldIdentification.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>
#include <memory>

#include "commands.h"
#include "file_kinds.h"
#include "finite_check.h"
#include "measurement_options.h"
#include "report/identification_page.h"
#include "report/identification_tables.h"
#include "support_options.h"
#include "terminal.h"
#include "whole_file.h"

namespace palpate::app {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct Options {
  std::string input, output, method = "bem", loss = "cauchy", field;
  MeasurementOptions measurements;
  SupportOptions support;
  ReportOption report;
  double poisson = kUnknown, largestRatio = 10, tolerance = 1e-4;
  std::vector<double> poissonRange;
  bool isChosen = false, yieldingSupport = false, isRegistered = false, noEstimate = false;
  double fieldLength = 0, fieldDeviation = 0;
  int folds = 5, nextProbes = 0, threads = 0, modes = 50;
};

void addUnknowns(CLI::App& command, Options& o) {
  const char* const group = "Unknowns, besides Young's modulus";
  CLI::Option* poisson = command.add_option("--poisson", o.poisson,
                                            "Poisson's ratio, if it is known; else identified");
  poisson->check(isFinite())->check(CLI::Range(-0.999999, 0.5))->group(group);
  command
      .add_option("--poisson-range", o.poissonRange,
                  "Where it is looked for; 0 to 0.499, for fem 0 to 0.449")
      ->expected(2)
      ->check(isFinite())
      ->excludes(poisson)
      ->group(group);
  command
      .add_option("--largest-ratio", o.largestRatio,
                  "Of Young's moduli of two regions (fem: cells' MaterialRegion)")
      ->check(isFinite())
      ->capture_default_str()
      ->group(group);
  command
      .add_flag("--yielding-support", o.yieldingSupport,
                "The support is an elastic foundation of unknown stiffness")
      ->group(group);
  command
      .add_flag("--register", o.isRegistered,
                "The measurements' frame is the surface's but for an unknown rigid motion")
      ->group(group);
}

void addField(CLI::App& command, Options& o) {
  const char* const group = "Stiffness that varies inside (--method fem)";
  CLI::Option* field = command.add_option(
      "--field", o.field, "Identify how it varies, and write the tetrahedra with it here, .vtu");
  requireWritable(field, "fields", ".vtu");
  field->group(group);
  command.add_option("--modes", o.modes, "Of the field; more resolve smaller places")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str()
      ->needs(field)
      ->group(group);
  command
      .add_option("--field-length", o.fieldLength,
                  "Over what stiffness varies, m; by default .15 of the diagonal")
      ->check(isFinite())
      ->check(CLI::PositiveNumber)
      ->needs(field)
      ->group(group);
  command
      .add_option(
          "--field-deviation", o.fieldDeviation,
          "Standard deviation of ln E that is expected; by default as the measurements tell")
      ->check(isFinite())
      ->check(CLI::Range(0.01, 10.0))
      ->needs(field)
      ->group(group);
}

void addOptions(CLI::App& command, Options& o) {
  command
      .add_option("input", o.input,
                  "The body at rest: a closed triangle surface, or for fem a volume mesh (.vtu, "
                  ".vtk)")
      ->required();
  requireWritable(
      command
          .add_option("output", o.output, "The model: the surface with its Green's functions, .vtp")
          ->required(),
      "models", ".vtp");
  o.measurements.addTo(command);
  command.add_flag(
      "--choose", o.isChosen,
      "Identify the material, with --method fem also stiffness that varies inside, and "
      "a correction of the material's model; keep the simplest that predicts probes "
      "left out about best");
  addUnknowns(command, o);
  addField(command, o);
  o.support.addPlacesTo(command);
  command.add_option("--method", o.method, "bem, or fem: tetrahedra inside the surface")
      ->check(CLI::IsMember({"bem", "fem"}))
      ->capture_default_str();
  command
      .add_option("--loss", o.loss,
                  "How residuals count while outliers are looked for: none (as they are), huber, "
                  "cauchy or tukey")
      ->check(CLI::IsMember({"none", "huber", "cauchy", "tukey"}))
      ->capture_default_str();
  command.add_option("--folds", o.folds, "Of the cross-validation by probes; 0 for none")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command
      .add_option("--interpolation-tolerance", o.tolerance,
                  "Of responses between the materials that are computed, relative")
      ->check(isFinite())
      ->check(CLI::Range(1e-9, 0.1))
      ->capture_default_str();
  command
      .add_option("--next-probes", o.nextProbes,
                  "Propose so many further probes that would tell most")
      ->check(CLI::Range(0, 100));
  command.add_flag("--no-estimate", o.noEstimate, "Do not estimate the model's own error");
  command.add_option("--threads", o.threads, "0 for all cores")->check(CLI::Range(0, 1024));
  o.report.addTo(command, "what was found, how sure it is and how it fits");
  command.footer(
      "A table has a line of names, then a line for each displacement, in SI units or as told:\n"
      "  probe, contact_vertex (or contact_x .. _z), radius, force_x .. _z, vertex (or x, y, z),\n"
      "  u_x .. _z, and optionally sd (or sd_x .. _z), its standard deviation.\n"
      "  palpate identify part.stl part.vtp --measurements rig.csv --length-unit mm \\\n"
      "      --fix-half-space 0 0 0.001  0 0 1\n"
      "`palpate measure` makes such tables of a model, to try this on.");
}

/// Sets the surface with its support, and what fills it if the input does.
void setInput(vtkGreensFunctionIdentification* filter, const Options& o) {
  vtkNew<vtkReferenceBoundaryConditions> conditions;
  o.support.applyTo(conditions);
  conditions->RequireMaterialOff();
  if (isVolumeFile(o.input)) {
    if (o.method != "fem")
      throw std::invalid_argument(o.input + " is a volume mesh: add --method fem");
    const auto volume = readVolume(o.input);
    vtkNew<vtkSolidBoundary> boundary;
    boundary->SetInputData(volume);
    conditions->SetInputData(run(boundary));
    filter->SetInputData(1, volume);
  } else {
    conditions->SetInputData(readSurface(o.input));
  }
  filter->SetInputData(run(conditions));
  o.measurements.applyTo(filter, 2);
}

void set(vtkGreensFunctionIdentification* filter, const Options& o) {
  filter->SetMethod(o.method == "fem");
  filter->SetPoissonRatio(o.poisson);
  if (!o.poissonRange.empty()) filter->SetPoissonRange(o.poissonRange[0], o.poissonRange[1]);
  filter->SetLargestRatio(o.largestRatio);
  filter->SetYieldingSupport(o.yieldingSupport);
  filter->SetRegister(o.isRegistered);
  filter->SetLoss(o.loss == "huber" ? 1 : o.loss == "cauchy" ? 2 : o.loss == "tukey" ? 3 : 0);
  filter->SetNumberOfFolds(o.folds);
  filter->SetNumberOfNextProbes(o.nextProbes);
  filter->SetInterpolationTolerance(o.tolerance);
  filter->SetEstimateError(!o.noEstimate);
  filter->SetNumberOfThreads(o.threads);
}

double component(vtkPolyData* model, const char* name, vtkIdType tuple, int c = 0) {
  return model->GetFieldData()->GetArray(name)->GetComponent(tuple, c);
}

void printParameters(vtkPolyData* model) {
  const std::vector<std::string> names = fieldStrings(model, "IdentifiedNames"),
                                 units = fieldStrings(model, "IdentifiedUnits");
  const bool hasShare = model->GetFieldData()->GetArray("ParameterDeviationByRegistration");
  const auto value = [&](std::size_t i, int c) {
    return component(model, "IdentifiedParameters", static_cast<vtkIdType>(i), c);
  };
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string text = number(value(i, 0));
    if (value(i, 1) > 0)
      text += " +- " + number(value(i, 1), 2) + " (95 % by noise" +
              (hasShare ? " and registration: " : ": ") + number(value(i, 2)) + " to " +
              number(value(i, 3)) + ")";
    const double byProbes = component(model, "ProbewiseDeviation", static_cast<vtkIdType>(i));
    if (lacksFit(model) && byProbes >= 0)
      text += ", +- " + number(byProbes, 2) + " by probes left out";
    printRow(names[i] + (units[i].empty() ? "" : ", " + units[i]), text);
  }
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      printRow("correlation", number(component(model, "IdentifiedCorrelations",
                                               static_cast<vtkIdType>(i), static_cast<int>(j)),
                                     2) +
                                  " of " + names[i] + " with " + names[j]);
}

void printProbes(vtkPolyData* model) {
  const std::vector<std::string> names = fieldStrings(model, "ProbeNames");
  for (std::size_t p = 0; p < names.size(); ++p) {
    const auto id = static_cast<vtkIdType>(p);
    printRow("probe " + names[p],
             "residual " + percent(component(model, "ProbeRelativeResidual", id)) + ", " +
                 number(component(model, "ProbeResidual", id), 3) + " m, " +
                 number(component(model, "ProbeOutliers", id)) + " outliers");
  }
}

/// Probes that would tell most, and the deviations with all up to each.
void printNextProbes(vtkPolyData* model) {
  vtkDataArray* vertices = model->GetFieldData()->GetArray("NextProbeVertex");
  const std::vector<std::string> names = fieldStrings(model, "IdentifiedNames");
  for (vtkIdType i = 0; vertices && i < vertices->GetNumberOfTuples(); ++i) {
    double place[3], force[3];
    model->GetPoint(static_cast<vtkIdType>(vertices->GetComponent(i, 0)), place);
    model->GetFieldData()->GetArray("NextProbeForce")->GetTuple(i, force);
    std::string text = "at vertex " + number(vertices->GetComponent(i, 0), 9) + " (" +
                       vectorText(place) + "), force " + vectorText(force) + ":";
    for (std::size_t p = 0; p < names.size(); ++p)
      text += (p > 0 ? ", " : " ") + names[p] + " +- " +
              number(component(model, "NextProbeDeviations", i, static_cast<int>(p)), 2);
    printRow("next probe " + std::to_string(i + 1), text);
  }
}

void printField(vtkPolyData* model, vtkUnstructuredGrid* grid) {
  double moduli[2], deviations[2];
  grid->GetCellData()->GetArray("YoungsModulus")->GetRange(moduli);
  grid->GetCellData()->GetArray("LogModulusDeviation")->GetRange(deviations);
  printRow("Young's modulus in the body, Pa", number(moduli[0], 3) + " to " + number(moduli[1], 3));
  printRow("deviation of its logarithm",
           number(deviations[0], 2) + " to " + number(deviations[1], 2));
  printRow("deviation that was expected of it", number(fieldNumber(model, "FieldDeviation", 1), 2));
  printRow("one modulus all over fits to", percent(fieldNumber(model, "UniformFitError", -1)) +
                                               ", the field to " +
                                               percent(fieldNumber(model, "FitError", -1)));
  printRow("unknowns that are determined", number(fieldNumber(model, "DeterminedUnknowns", 0), 3));
}

/// Of what was chosen among.
void printTried(vtkPolyData* model) {
  const std::vector<std::string> names = fieldStrings(model, "TriedModels");
  for (std::size_t i = 0; i < names.size(); ++i)
    printRow("error at probes left out, " + names[i],
             percent(component(model, "TriedHoldOutErrors", static_cast<vtkIdType>(i))));
}

void writeField(vtkUnstructuredGrid* grid, const std::string& path) {
  replaceFile(path, [&](const std::string& name) {
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->SetFileName(name.c_str());
    writer->SetInputData(grid);
    if (!writer->Write()) throw std::runtime_error(path + " could not be written");
  });
}

void printModel(vtkPolyData* model, const MeasurementOptions& measurements) {
  for (const std::string& source : fieldStrings(model, "GreensFunctionSource"))
    printRow("made by", source);
  printParameters(model);
  if (model->GetFieldData()->GetArray("RegistrationDistance")) {
    printRow("turn of the table's frame", registrationText(model).turn + " degrees about x, y, z");
    printRow("its shift", registrationText(model).shift + " m");
    printRow("places off the surface", number(fieldNumber(model, "RegistrationDistance", -1), 3) +
                                           " m (rms); " + registrationShareText(model));
  }
  printRow("noise", number(fieldNumber(model, "MeasurementNoise", -1), 3) + " m");
  if (const double misfit = fieldNumber(model, "MeasurementMisfit", -1); misfit >= 0)
    printRow("noise over that given", number(misfit, 3));
  printRow("residuals of neighbours", neighboursText(model));
  printProbes(model);
  printRow("outliers", measurements.outliersOf(model));
  if (const double error = fieldNumber(model, "HoldOutError", -1); error >= 0)
    printRow("error at probes left out", percent(error) + ", noise and all; fitted ones " +
                                             percent(fieldNumber(model, "FitError", -1)));
  if (const double error = fieldNumber(model, "ResponseInterpolationError", 0); error > 0)
    printRow("error of interpolation", percent(error));
  printNextProbes(model);
  if (const std::string off = offByMeshText(model); !off.empty())
    printRow("the mesh makes too large", off);
  else if (const double error = fieldNumber(model, "ErrorEstimate", -1); error >= 0)
    printRow("error of the model itself",
             percent(error) + " (what the mesh may add to Young's modulus)");
}

/// Options that would do nothing.
void refuseForeignOptions(const CLI::App& command, const Options& o) {
  const auto refuse = [&](const char* name, const std::string& with) {
    if (command.count(name) > 0)
      throw std::invalid_argument(std::string(name) + " makes no sense with " + with +
                                  ": leave it out");
  };
  if (!o.field.empty() && !o.isChosen)
    for (const char* name : {"--largest-ratio", "--interpolation-tolerance", "--threads"})
      refuse(name, "--field");
  if (o.method == "fem") refuse("--threads", "--method fem");
  if (o.method == "bem") refuse("--largest-ratio", "--method bem");
}

}  // namespace

void addIdentify(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "identify", "Identify a body's material, and its Green's functions, from measurements");
  addOptions(*command, *options);
  command->callback([options, command] {
    bool isField = !options->field.empty();
    if (isField && options->method != "fem")
      throw std::invalid_argument("a field takes finite elements: add --method fem");
    refuseForeignOptions(*command, *options);
    vtkNew<vtkStiffnessFieldIdentification> ofField;
    vtkNew<vtkGreensFunctionIdentification> ofMaterial;
    vtkNew<vtkIdentificationByCrossValidation> ofAny;
    vtkStiffnessFieldIdentification* const withField =
        options->isChosen ? ofAny.Get() : ofField.Get();
    withField->SetNumberOfModes(options->modes);
    withField->SetFieldLength(options->fieldLength);
    withField->SetFieldDeviation(options->fieldDeviation);
    vtkGreensFunctionIdentification* const filter =
        isField || options->isChosen ? withField : ofMaterial.Get();
    set(filter, *options);
    setInput(filter, *options);
    const auto model = run(filter);
    auto* const field = vtkUnstructuredGrid::SafeDownCast(withField->GetOutputDataObject(1));
    if (options->isChosen) isField = field->GetNumberOfCells() > 0;
    if (isField && !options->field.empty()) writeField(field, options->field);
    writeSurface(model, options->output);
    options->report.write([&](const RunDescription& run) {
      return identificationPage(model, isField ? field : nullptr, run);
    });
    if (options->isChosen) printTried(model);
    if (isField && options->field.empty())
      printRow("field", "taken but not written: name a file by --field");
    printModel(model, options->measurements);
    if (isField) printField(model, field);
    printWarnings(model);
  });
}

}  // namespace palpate::app
