// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shell/shell_greens_functions.h"

#include <sstream>
#include <stdexcept>
#include <utility>

#include "greens/reciprocity.h"
#include "shell/shell_refinement.h"
#include "shell/shell_response.h"
#include "shell/shell_system.h"
#include "shell/shell_warnings.h"
#include "stopwatch.h"

namespace palpate {
namespace {

constexpr double kOwnShare = 0.1;        ///< of the time with an estimate
constexpr double kLargestDefect = 0.05;  // of a rigid motion: beyond, little else can be right

/// shellResponse, if rounding lets it be one.
shell::ShellResponse soundResponse(shell::ShellSystem system, const ElasticModel& model,
                                   const ThinShell& shell, const std::vector<int>& nodes,
                                   Eigen::Ref<Eigen::MatrixXd> out, const Progress& progress) {
  double defect = -1;
  try {
    const auto response = shell::shellResponse(std::move(system), model, nodes, out, progress);
    if (response.rigidMotionDefect < kLargestDefect) return response;
    defect = response.rigidMotionDefect;
  } catch (const SingularSystem&) {
    // Its support has been found to hold it.
  }
  throw std::runtime_error(shell::roundingSentence(model, shell, defect));
}

std::string describeSource(const ElasticModel& model, const ThinShell& shell) {
  std::ostringstream text;
  text << "thin shell (DKT and OPT triangles, " << model.mesh().triangleCount()
       << " of them, thickness " << shell.thinnest();
  if (shell.thickest() > shell.thinnest()) text << " to " << shell.thickest();
  text << ", " << (shell.isClamped() ? "clamped" : "hinged") << ")";
  return text.str();
}

}  // namespace

ComputedGreensFunctions computeShellGreensFunctions(const ElasticModel& model,
                                                    const ThinShell& shell,
                                                    const ShellOptions& options,
                                                    const ProgressCallback& callback) {
  const Progress whole(callback);
  const Progress progress = whole.part(0, options.estimateError ? kOwnShare : 1);
  ComputedGreensFunctions result;
  GreensFunctionsInfo& info = result.info;
  info = infoOf(model, options.columns);
  info.fingerprint = shell.fingerprint(model);
  info.rotationsHeld = shell.isClamped();
  info.source = describeSource(model, shell);
  info.reciprocal = options.reciprocal;

  Stopwatch watch;
  progress.report(0, "assemble");
  shell::ShellSystem system(model, shell);
  addSeconds(info.diagnostics, "assemble", watch.seconds());

  const double length = system.length;
  const Eigen::Index rows = 3 * model.mesh().vertexCount(), columns = 3 * info.columnNodes.size();
  result.matrix = AlignedBuffer<double>(rows * columns);
  Eigen::Map<Eigen::MatrixXd> matrix(result.matrix.data(), rows, columns);
  shell::ShellResponse response = soundResponse(std::move(system), model, shell, info.columnNodes,
                                                matrix, progress.part(0.05, 0.95));
  const double stiffness = info.material.youngsModulus();
  scaleToModel(info, length, stiffness, perGivenOfNodes(info, length, stiffness), matrix);
  scaleToModel(info, length, stiffness, {length / stiffness}, response.ofWeight);
  info.weightResponse = std::move(response.ofWeight);
  addSeconds(info.diagnostics, "solve", watch.seconds());
  info.diagnostics.rotationDefect = response.rigidMotionDefect;
  info.diagnostics.peakBytes = response.peakBytes + result.matrix.bytes();

  info.diagnostics.reciprocityDefect =
      makeReciprocal(result.matrix.data(), info.conditions, info.vertexAreas, info.columnNodes,
                     options.reciprocal);
  info.diagnostics.rockingCompliance = rockingCompliance(*result.view(), model.mesh());
  info.diagnostics.warnings = shell::shellWarnings(model, shell, info.diagnostics.rotationDefect);
  addSeconds(info.diagnostics, "check", watch.seconds());
  if (options.estimateError) {
    info.diagnostics.error =
        estimateShellError(model, shell, *result.view(), whole.part(kOwnShare, 1));
    addSeconds(info.diagnostics, "estimate", watch.seconds());
  }
  whole.report(1, "done");
  return result;
}

}  // namespace palpate
