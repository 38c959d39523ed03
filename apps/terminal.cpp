// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "terminal.h"

#include <read_files.h>
#include <unistd.h>
#include <vtkCallbackCommand.h>
#include <vtkDataArray.h>
#include <vtkElasticSurfaceWriter.h>
#include <vtkElastostaticAlgorithm.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkMaskedContactAlgorithm.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cerrno>
#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "greens/surface_fields.h"
#include "picture/picture.h"
#include "progress_bar.h"

namespace palpate::app {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void onProgress(vtkObject* caller, unsigned long, void*, void*) {
  auto* filter = static_cast<vtkPolyDataAlgorithm*>(caller);
  if (interrupted) filter->SetAbortExecute(1);
  drawProgress(filter->GetProgress(), filter->GetProgressText());
}

/// In the order of vtkMaskedContactAlgorithm::MaskType.
const std::vector<std::string> kMasks{"linear",   "uniform",  "gaussian",
                                      "hertzian", "gradient", "biharmonic"};

}  // namespace

void requireWritable(CLI::Option* option, const std::string& what, const std::string& ending) {
  const auto complaint = [what, ending](const std::string& name) -> std::string {
    if (name.empty()) return "the name of a file is missing";
    const std::filesystem::path path = name;
    if (!ending.empty() && CLI::detail::to_lower(path.extension().string()) != ending)
      return what + " are written as " + ending + ": choose a name that ends so, not " + name;
    return whyUnwritable(name);
  };
  option->check(CLI::Validator(complaint, ""));
}

std::string whyUnwritable(const std::string& name) {
  const std::filesystem::path path = name,
                              folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown))
    return name + " cannot be written: it is a folder";
  if (std::filesystem::exists(path, unknown) && !std::filesystem::is_regular_file(path, unknown))
    return name + " cannot be written: it is not an ordinary file";
  if (!std::filesystem::is_directory(folder, unknown))
    return name + " cannot be written: there is no folder " + folder.string();
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    return name + " cannot be written: " + std::strerror(errno);
  return {};
}

void writeSurface(vtkPolyData* surface, const std::string& path) {
  vtkNew<vtkElasticSurfaceWriter> writer;
  silence(writer);
  if (!writer->Write(surface, path.c_str())) throw std::runtime_error(writer->GetFailureMessage());
}

vtkSmartPointer<vtkPolyData> run(vtkPolyDataAlgorithm* filter) {
  silence(filter);
  silence(filter->GetExecutive());
  vtkNew<vtkCallbackCommand> progress;
  progress->SetCallback(onProgress);
  filter->AddObserver(vtkCommand::ProgressEvent, progress);
  filter->Update();
  endProgressBar();
  if (interrupted) throw std::runtime_error("interrupted; nothing was written");
  const auto* elastostatic = vtkElastostaticAlgorithm::SafeDownCast(filter);
  if (elastostatic && *elastostatic->GetFailureMessage())
    throw std::runtime_error(elastostatic->GetFailureMessage());
  return filter->GetOutput();
}

void catchInterrupts() {
  struct sigaction action = {};
  action.sa_handler = [](int) { interrupted = 1; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGHUP, &action, nullptr);  // the terminal was closed
  signal(SIGXFSZ, SIG_IGN);             // a file that may not grow is a failure like others
}

bool isInterrupted() {
  return interrupted != 0;
}

void printRow(const std::string& label, const std::string& value) {
  const int width = std::max(28, static_cast<int>(label.size()) + 2);
  std::cout << std::left << std::setw(width) << label << value << "\n";
}

void requirePrinted() {
  if (!std::cout.flush() || std::fflush(stdout) != 0 || std::ferror(stdout))
    throw std::runtime_error("standard output cannot be written to");
}

std::string number(double value, int digits) {
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return text.str();
}

std::string percent(double share) {
  return std::isnan(share) ? "–" : number(100 * share, 3) + " %";
}

std::string vectorText(const double* v) {
  return number(v[0]) + "  " + number(v[1]) + "  " + number(v[2]);
}

double fieldNumber(vtkPolyData* surface, const char* name, double fallback) {
  vtkDataArray* array = surface->GetFieldData()->GetArray(name);
  return array && array->GetNumberOfValues() > 0 ? array->GetComponent(0, 0) : fallback;
}

std::vector<std::string> fieldStrings(vtkPolyData* surface, const char* name) {
  std::vector<std::string> values;
  auto* array = vtkStringArray::SafeDownCast(surface->GetFieldData()->GetAbstractArray(name));
  for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i)
    values.push_back(array->GetValue(i));
  return values;
}

std::array<double, 3> fieldVector(vtkPolyData* surface, const char* name) {
  std::array<double, 3> value{0, 0, 0};
  vtkDataArray* array = surface->GetFieldData()->GetArray(name);
  if (array && array->GetNumberOfComponents() == 3) array->GetTuple(0, value.data());
  return value;
}

void printErrors(vtkPolyData* model) {
  const double error = fieldNumber(model, "ErrorEstimate", -1);
  if (error < 0) return;
  const auto share = [&](const char* name) { return percent(fieldNumber(model, name, -1)); };
  printRow("estimated error", share("ErrorEstimate"));
  printRow("error of contact compliances", share("ContactErrorEstimate"));
  printRow("error of 95 % of loads", share("MostErrorEstimate"));
  printRow("loads spread over", number(fieldNumber(model, "ErrorLoadLength", -1), 3));
  printRow("error by mesh", share("DiscretizationError"));
  printRow("error by integrals", share("IntegrationError"));
  printRow("error by solver", share("SolverError"));
  printRow("error by storage", share("StorageError"));
}

void printValidity(vtkPolyData* deformed, const std::string& cure) {
  const double largest = fieldNumber(deformed, "LargestDisplacementGradient", 0);
  printRow("largest displacement gradient", number(largest, 3));
  if (largest > DisplacementGradients::kTrusted)
    printWarning(
        "displacements change by more than a tenth of the way they change over: linear theory is "
        "off by more than 5 % there; " +
        cure);
}

void printWarning(const std::string& sentence) {
  std::cerr << "palpate: warning: " << sentence << "\n";
}

void printWarnings(vtkPolyData* surface) {
  for (const std::string& warning : fieldStrings(surface, "Warnings")) printWarning(warning);
}

void MaskOptions::addTo(CLI::App& command) {
  auto* length =
      command.add_option("--radius", radius,
                         "Radius of the pressure mask, in the unit of the points; without "
                         "it the load goes to single vertices");
  auto* edges = command.add_option("--radius-edges", radiusEdges,
                                   "The radius as a multiple of the mean edge length");
  length->excludes(edges);
  command
      .add_option("--mask", mask,
                  "How the pressure falls with distance: linear, uniform, gaussian or hertzian, or "
                  "the smooth pressure nearest to a point load: gradient or biharmonic")
      ->check(CLI::IsMember(kMasks))
      ->capture_default_str();
  command
      .add_option("--distance", distance,
                  "Straight (euclidean) or along the surface (geodesic), not across grooves")
      ->check(CLI::IsMember({"euclidean", "geodesic"}))
      ->capture_default_str();
  command
      .add_option(
          "--measure", measure,
          "The displacement that a stiffness goes by: that of the vertex, or the mean under "
          "the mask")
      ->check(CLI::IsMember({"vertex", "mean"}))
      ->capture_default_str();
  command.add_option("--rigid-stiffness", rigidStiffness,
                     "Stiffness k of fixed vertices, N/m; none of a larger Frobenius norm than "
                     "theirs, sqrt(3) k, is shown; 0 for the stiffest free vertex");
}

void MaskOptions::applyTo(vtkMaskedContactAlgorithm* filter) const {
  filter->SetMask(static_cast<int>(std::find(kMasks.begin(), kMasks.end(), mask) - kMasks.begin()));
  filter->SetDistance(distance == "geodesic");
  filter->SetRadiusInEdgeLengths(radiusEdges != 0);
  filter->SetRadius(radiusEdges != 0 ? radiusEdges : radius);
}

void PictureOptions::addTo(CLI::App& command, const std::string& what) {
  requireWritable(
      command.add_option("--image", path, "Draw " + what + " to this PNG file; needs no display"),
      "pictures", ".png");
  command
      .add_option("--view", view,
                  "Direction from the object to the eye, three numbers; by default onto the free "
                  "surface")
      ->expected(3);
  command.add_option("--range", range, "Smallest and largest value of the colours")->expected(2);
}

void PictureOptions::requireSensible() const {
  const double length = view.empty() ? 1 : std::hypot(view[0], view[1], view[2]);
  if (!(length > 0 && std::isfinite(length)))
    throw std::invalid_argument("--view must be a direction: three finite numbers, not all zero");
  if (!range.empty() && !(std::isfinite(range[1] - range[0]) && range[0] < range[1]))
    throw std::invalid_argument("--range must be two finite numbers, the smaller one first");
}

std::array<double, 3> PictureOptions::towardsViewer(vtkPolyData* surface) const {
  if (view.empty()) return directionOntoFreeSurface(surface);
  return {view[0], view[1], view[2]};
}

}  // namespace palpate::app
