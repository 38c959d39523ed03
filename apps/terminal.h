// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vtkSmartPointer.h>

#include <array>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI
class vtkMaskedContactAlgorithm;
class vtkPolyData;
class vtkPolyDataAlgorithm;

/// What the subcommands share: files, progress, numbers on the terminal.
namespace palpate::app {

/// Has an option's path checked before anything is computed: its ending, and that its folder can be
/// written to.
/// @param what    what is written, for the sentence.
/// @param ending  empty for any.
void requireWritable(CLI::Option* option, const std::string& what, const std::string& ending);
/// A sentence, nothing for a path that can be written.
std::string whyUnwritable(const std::string& path);
/// @throws std::runtime_error with the writer's sentence.
void writeSurface(vtkPolyData* surface, const std::string& path);

/// Updates a filter, with a progress bar where stderr is a terminal. Ctrl-C aborts it.
/// @throws std::runtime_error with the filter's sentence, or that it was interrupted.
vtkSmartPointer<vtkPolyData> run(vtkPolyDataAlgorithm* filter);

/// Turns Ctrl-C and termination into an abort that leaves nothing half done.
void catchInterrupts();
/// Whether one of them came.
bool isInterrupted();

/// "label   value" lines for people, on stdout.
void printRow(const std::string& label, const std::string& value);
/// @throws std::runtime_error if what was printed on stdout did not arrive.
void requirePrinted();
std::string number(double value, int digits = 4);
/// A share as percent, a dash for NaN.
std::string percent(double share);
std::string vectorText(const double* components);

/// A one-tuple field array, or a fallback.
double fieldNumber(vtkPolyData* surface, const char* name, double fallback);
std::vector<std::string> fieldStrings(vtkPolyData* surface, const char* name);
/// A three-component field tuple.
std::array<double, 3> fieldVector(vtkPolyData* surface, const char* name);

/// Prints the errors that a model is estimated to have, if it is, as percents.
void printErrors(vtkPolyData* model);

/// Prints by how much linear theory is strained, with a warning that ends with a cure where that is
/// too much.
void printValidity(vtkPolyData* deformed, const std::string& cure);

/// A line on stderr.
void printWarning(const std::string& sentence);

/// Prints the warnings that a model carries, on stderr.
void printWarnings(vtkPolyData* surface);

/// Mask options of a subcommand and their way into a filter.
struct MaskOptions {
  std::string mask = "linear", distance = "euclidean", measure = "vertex";
  double radius = 0, radiusEdges = 0, rigidStiffness = 0;
  void addTo(CLI::App& command);
  void applyTo(vtkMaskedContactAlgorithm* filter) const;
  /// The number by which the filters know the measure.
  int measureNumber() const { return measure == "mean"; }
};

/// Picture options of a subcommand.
struct PictureOptions {
  std::string path;
  std::vector<double> view, range;
  void addTo(CLI::App& command, const std::string& what);
  /// @throws std::invalid_argument for a view without direction or a range without extent.
  void requireSensible() const;
  std::array<double, 3> towardsViewer(vtkPolyData* surface) const;
};

}  // namespace palpate::app
