// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <read_files.h>
#include <vtkBoundaryElementGreensFunctions.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkFiniteElementGreensFunctions.h>
#include <vtkHalfSpaceGreensFunctions.h>
#include <vtkIdTypeArray.h>
#include <vtkIsotropicRemeshing.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkReferenceBoundaryConditions.h>
#include <vtkShellGreensFunctions.h>
#include <vtkSmartPointer.h>
#include <vtkSolidBoundary.h>
#include <vtkToleranceGreensFunctions.h>
#include <vtkUnstructuredGrid.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "commands.h"
#include "file_kinds.h"
#include "subdivision_option.h"
#include "support_options.h"
#include "terminal.h"

namespace palpate::app {
namespace {

struct Options {
  std::string input, output, method = "bem";
  SupportOptions support;
  std::string precision = "double", solver = "direct", collocation = "averaged",
              domain = "interior";
  double integrationTolerance = 1e-6, smoothAngle = 30;
  double tolerance = 0;  // of the error, 0 for none
  int levels = 4, layers = 3, vertices = 3000;
  std::string subdivision = "flat";
  std::string element = "quadratic";
  double cellSize = 0, edgeLength = 0;
  std::vector<double> probes;  // three each
  double thickness = 0;        // 0 for that of the surface's array
  bool hinged = false, estimate = false;
  bool raw = false, patchColumns = false, supportPatch = false, noEstimate = false;
  std::vector<vtkIdType> columns;
  bool supportColumns = false;
  int threads = 0;
};

void addAccuracyOptions(CLI::App& command, Options& o) {
  const char* const chosen = "By tolerance (what is cheapest is chosen)";
  CLI::Option* tolerance =
      command
          .add_option("--tolerance", o.tolerance,
                      "Largest relative error, estimated, e.g. 0.05: refines the surface as needed")
          ->check(CLI::Range(1e-12, 1 - 1e-12))
          ->group(chosen);
  const auto addMost = [&](const char* name, int& value, const CLI::Range& range,
                           const char* what) {
    command.add_option(name, value, what)
        ->check(range)
        ->needs(tolerance)
        ->capture_default_str()
        ->group(chosen);
  };
  addMost("--max-levels", o.levels, {0, 9}, "Refinements at most, 0 to keep the surface");
  addMost("--max-layers", o.layers, {0, 9}, "Layers along the rim of the support, 0 for none");
  addMost("--max-vertices", o.vertices, {4, 100000}, "Vertices at most, refined or not");
  addSubdivision(command, o.subdivision)->needs(tolerance)->group(chosen);
  command.add_option("--precision", o.precision, "double, mixed or float")
      ->check(CLI::IsMember({"double", "mixed", "float"}))
      ->excludes(tolerance)
      ->capture_default_str();
  command
      .add_option("--integration-tolerance", o.integrationTolerance,
                  "Relative tolerance of the integrals")
      ->excludes(tolerance)
      ->capture_default_str();
  command
      .add_option("--solver", o.solver,
                  "direct, or iterative: cheaper for few columns of large surfaces, in double")
      ->check(CLI::IsMember({"direct", "iterative"}))
      ->excludes(tolerance)
      ->capture_default_str();
  CLI::Option* columns =
      command.add_option("--columns", o.columns, "Compute only these vertices' Green's functions")
          ->excludes(tolerance);
  command
      .add_flag("--support-columns", o.supportColumns,
                "Also compute those of fixed vertices, so that the support can be released or "
                "give way")
      ->excludes(tolerance)
      ->excludes(columns);
  command.add_flag(
      "--support-patch", o.supportPatch,
      "End the support's traction at its rim, not half an edge beyond (more accurate)");
  command.add_flag("--no-estimate", o.noEstimate, "Do not estimate the error")->excludes(tolerance);
}

void addOptions(CLI::App& command, Options& o) {
  command
      .add_option(
          "input", o.input,
          "A triangle surface: closed; flat for a half-space below it; any for a shell, whose "
          "middle it is; for fem also a volume mesh of tetrahedra, .vtu or .vtk")
      ->required();
  requireWritable(
      command
          .add_option("output", o.output, "The model: the surface with its Green's functions, .vtp")
          ->required(),
      "models", ".vtp");
  command
      .add_option("--method", o.method,
                  "bem; fem: tetrahedra inside the surface; halfspace: all below a flat one, "
                  "exact; or shell: "
                  "a thin layer about it")
      ->check(CLI::IsMember({"bem", "fem", "halfspace", "shell"}))
      ->capture_default_str();
  o.support.addTo(command);
  addAccuracyOptions(command, o);
  command.add_option("--collocation", o.collocation, "averaged, or vertex as in the paper")
      ->check(CLI::IsMember({"averaged", "vertex"}))
      ->capture_default_str();
  command
      .add_option("--domain", o.domain,
                  "Material inside the surface, or outside it; or inside, of a body that nothing "
                  "holds")
      ->check(CLI::IsMember({"interior", "exterior", "unsupported"}))
      ->capture_default_str();
  command
      .add_option("--smooth-angle", o.smoothAngle, "Traction may jump at sharper edges, degrees")
      ->capture_default_str();
  command.add_flag("--patch-columns", o.patchColumns,
                   "Also responses to tractions on single patches of sharp edges");
  command.add_flag("--raw", o.raw, "Do not symmetrise the compliance");
  command.add_option("--threads", o.threads, "0 for all cores")->check(CLI::Range(0, 1024));
  command
      .add_option("--edge-length", o.edgeLength,
                  "Remesh the surface to edges of about this length first, m: the model is of the "
                  "coarser mesh, and shows on the original by `palpate original`")
      ->check(CLI::PositiveNumber)
      ->excludes("--tolerance")
      ->excludes("--columns");
  const char* const finite = "Finite elements";
  command.add_option("--element", o.element, "quadratic, or linear")
      ->check(CLI::IsMember({"quadratic", "linear"}))
      ->capture_default_str()
      ->group(finite);
  command
      .add_option(
          "--cell-size", o.cellSize,
          "Largest circumradius of the tetrahedra, m; 0: as the surface's triangles ask for")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str()
      ->group(finite);
  command
      .add_option(
          "--probe", o.probes,
          "Places inside whose displacement and stress are to be known, of several materials, "
          "too")
      ->type_name("X Y Z ...")
      ->group(finite);
  const char* const shells = "Plates and shells";
  command
      .add_option("--thickness", o.thickness,
                  "Thickness, m; by default the surface's point or cell array Thickness")
      ->check(CLI::Validator(
          [](const std::string& text) {
            return std::strtod(text.c_str(), nullptr) > 0
                       ? ""
                       : "must be a positive number, not " + text;
          },
          ""))
      ->group(shells);
  command.add_flag("--hinged", o.hinged, "Fixed vertices may turn: they are not clamped")
      ->group(shells);
  command
      .add_flag("--estimate", o.estimate,
                "Estimate the error of up to a thousand vertices on four times as many, in sixteen "
                "times the time")
      ->group(shells);
}

/// Options and the methods that have them.
struct OptionOf {
  const char *name, *methods;
};
constexpr OptionOf kOptionsOf[] = {{"--tolerance", "bem"},
                                   {"--precision", "bem"},
                                   {"--integration-tolerance", "bem"},
                                   {"--solver", "bem"},
                                   {"--support-patch", "bem"},
                                   {"--no-estimate", "bem fem"},
                                   {"--collocation", "bem"},
                                   {"--domain", "bem fem shell"},
                                   {"--edge-length", "bem fem"},
                                   {"--support-columns", "bem fem shell"},
                                   {"--smooth-angle", "bem fem"},
                                   {"--patch-columns", "bem fem"},
                                   {"--threads", "bem halfspace"},
                                   {"--element", "fem"},
                                   {"--cell-size", "fem"},
                                   {"--probe", "fem"},
                                   {"--thickness", "shell"},
                                   {"--hinged", "shell"},
                                   {"--estimate", "shell"}};

void refuseForeignOptions(const CLI::App& command, const Options& o) {
  for (const OptionOf& option : kOptionsOf)
    if (std::string(option.methods).find(o.method) == std::string::npos &&
        command.count(option.name) > 0)
      throw std::invalid_argument(std::string(option.name) + " makes no sense with --method " +
                                  o.method + ": leave it out");
}

void setColumns(vtkGreensFunctionsAlgorithm* filter, const std::vector<vtkIdType>& columns) {
  if (columns.empty()) return;
  vtkNew<vtkIdTypeArray> nodes;
  for (vtkIdType node : columns) nodes->InsertNextValue(node);
  filter->SetColumnNodes(nodes);
}

vtkSmartPointer<vtkGreensFunctionsAlgorithm> halfSpace(const Options& o) {
  auto filter = vtkSmartPointer<vtkHalfSpaceGreensFunctions>::New();
  filter->SetReciprocal(!o.raw);
  filter->SetNumberOfThreads(o.threads);
  return filter;
}

vtkSmartPointer<vtkGreensFunctionsAlgorithm> finiteElements(const Options& o) {
  auto filter = vtkSmartPointer<vtkFiniteElementGreensFunctions>::New();
  filter->SetElement(o.element == "quadratic");
  filter->SetCellSize(o.cellSize);
  filter->SetUnsupported(o.domain == "unsupported");
  if (o.probes.size() % 3 != 0)
    throw std::invalid_argument("--probe takes three coordinates a place");
  for (std::size_t i = 0; i < o.probes.size(); i += 3)
    filter->AddProbe(o.probes[i], o.probes[i + 1], o.probes[i + 2]);
  filter->SetEstimateError(!o.noEstimate);
  filter->SetReciprocal(!o.raw);
  filter->SetSmoothAngle(o.smoothAngle);
  filter->SetPatchColumns(o.patchColumns);
  return filter;
}

vtkSmartPointer<vtkGreensFunctionsAlgorithm> thinShell(const Options& o) {
  auto filter = vtkSmartPointer<vtkShellGreensFunctions>::New();
  filter->SetThickness(o.thickness);
  filter->SetClamped(!o.hinged);
  filter->SetUnsupported(o.domain == "unsupported");
  filter->SetEstimateError(o.estimate);
  filter->SetReciprocal(!o.raw);
  return filter;
}

void setMethod(vtkBoundaryElementGreensFunctions* filter, const Options& o) {
  filter->SetPrecision(o.precision == "mixed" ? 1 : o.precision == "float" ? 2 : 0);
  filter->SetSolver(o.solver == "iterative");
  filter->SetCollocation(o.collocation == "vertex");
  filter->SetDomain(o.domain == "exterior"      ? vtkBoundaryElementGreensFunctions::EXTERIOR
                    : o.domain == "unsupported" ? vtkBoundaryElementGreensFunctions::UNSUPPORTED
                                                : vtkBoundaryElementGreensFunctions::INTERIOR);
  filter->SetTolerance(o.integrationTolerance);
  filter->SetSmoothAngle(o.smoothAngle);
  filter->SetReciprocal(!o.raw);
  filter->SetEstimateError(!o.noEstimate);
  if (o.supportPatch) filter->SupportPatchOn();
  filter->SetPatchColumns(o.patchColumns);
  filter->SetNumberOfThreads(o.threads);
}

/// The method as asked for, or one that chooses by tolerance.
vtkSmartPointer<vtkGreensFunctionsAlgorithm> method(const Options& o) {
  if (o.method == "halfspace") return halfSpace(o);
  if (o.method == "fem") return finiteElements(o);
  if (o.method == "shell") return thinShell(o);
  vtkSmartPointer<vtkBoundaryElementGreensFunctions> filter;
  if (o.tolerance > 0) {
    auto chooser = vtkSmartPointer<vtkToleranceGreensFunctions>::New();
    chooser->SetErrorTolerance(o.tolerance);
    chooser->SetMaximumNumberOfLevels(o.levels);
    chooser->SetMaximumNumberOfLayers(o.layers);
    chooser->SetMaximumNumberOfVertices(o.vertices);
    chooser->SetSubdivision(static_cast<int>(subdivisionNamed(o.subdivision)));
    filter = chooser;
  } else {
    filter = vtkSmartPointer<vtkBoundaryElementGreensFunctions>::New();
  }
  setMethod(filter, o);
  return filter;
}

/// Sets the surface with its support, and what fills it if the input does.
void setInput(vtkGreensFunctionsAlgorithm* filter, const Options& o) {
  vtkNew<vtkReferenceBoundaryConditions> conditions;
  o.support.applyTo(conditions);
  if (isVolumeFile(o.input)) {
    if (o.method != "fem")
      throw std::invalid_argument(o.input + " is a volume mesh: add --method fem");
    for (const auto& [name, value] :
         {std::pair("--cell-size", o.cellSize), std::pair("--edge-length", o.edgeLength)})
      if (value > 0)
        throw std::invalid_argument(std::string(name) +
                                    " makes no sense with a volume mesh: leave it out");
    const auto volume = readVolume(o.input);
    vtkNew<vtkSolidBoundary> boundary;
    boundary->SetInputData(volume);
    conditions->SetInputData(run(boundary));
    filter->SetInputData(1, volume);
  } else {
    conditions->SetInputData(readSurface(o.input));
  }
  auto posed = run(conditions);
  if (o.edgeLength > 0) {
    vtkNew<vtkIsotropicRemeshing> remeshing;
    remeshing->SetInputData(posed);
    remeshing->SetEdgeLength(o.edgeLength);
    remeshing->SetSmoothAngle(o.smoothAngle);
    remeshing->KeepOriginalOn();
    posed = run(remeshing);
  }
  filter->SetInputData(posed);
  std::vector<vtkIdType> columns = o.columns;
  if (o.supportColumns) {
    columns.resize(posed->GetNumberOfPoints());
    std::iota(columns.begin(), columns.end(), 0);
  }
  setColumns(filter, columns);
}

void printModel(vtkPolyData* model) {
  for (const std::string& step : fieldStrings(model, "ToleranceSteps")) printRow("tried", step);
  vtkDataArray* nodes = model->GetFieldData()->GetArray("GreensFunctionNodes");
  printRow("vertices", std::to_string(model->GetNumberOfPoints()));
  if (vtkDataArray* original = model->GetFieldData()->GetArray("OriginalPoints")) {
    printRow("vertices of the original", std::to_string(original->GetNumberOfTuples()));
    printRow("their largest distance from it, m",
             number(fieldNumber(model, "OriginalDistance", 0)));
    printRow("volume over the original's, less 1",
             percent(fieldNumber(model, "OriginalVolumeChange", 0)));
  }
  printRow("Green's functions", std::to_string(nodes->GetNumberOfTuples()));
  vtkDataArray* seconds = model->GetFieldData()->GetArray("StageSeconds");
  const std::vector<std::string> stages = fieldStrings(model, "StageNames");
  for (std::size_t i = 0; i < stages.size(); ++i)
    printRow("seconds to " + stages[i], number(seconds->GetComponent(i, 0), 3));
  const double condition = fieldNumber(model, "ConditionEstimate", -1);
  printRow("condition number", condition < 0 ? "not estimated" : number(condition, 3));
  printErrors(model);
  printRow("reciprocity defect", number(fieldNumber(model, "ReciprocityDefect", -1), 3));
  const auto printMeasured = [&](const char* name, const char* label) {
    if (const double value = fieldNumber(model, name, -1); value >= 0)
      printRow(label, number(value, 3));
  };
  printMeasured("RotationDefect", "integration defect");
  printMeasured("SolverResidual", "solver residual");
}

}  // namespace

void addPrecompute(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "precompute", "Compute the Green's functions of an elastic body from its surface");
  addOptions(*command, *options);
  command->footer(
      "The estimated error is of displacements under forces spread over a fifth of the surface's "
      "size\n"
      "(info says how far), for two dozen places; refine the surface to lower it, or give "
      "--tolerance.\n"
      "  palpate precompute part.stl part.vtp --young 2e9 --poisson 0.35 \\\n"
      "      --fix-half-space 0 0 0.001  0 0 1");
  command->callback([options, command] {
    refuseForeignOptions(*command, *options);
    if (options->domain == "exterior" && options->method != "bem")
      throw std::invalid_argument("--domain exterior makes no sense with --method " +
                                  options->method + ": leave it out");
    if (options->domain == "unsupported" && options->support.fixes())
      throw std::invalid_argument(
          "--domain unsupported is of bodies that nothing holds: leave out what fixes them");
    const auto filter = method(*options);
    setInput(filter, *options);
    const auto model = run(filter);
    writeSurface(model, options->output);
    printModel(model);
    printWarnings(model);
  });
}

}  // namespace palpate::app
