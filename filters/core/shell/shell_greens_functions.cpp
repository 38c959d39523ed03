// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shell/shell_greens_functions.h"

#include <sstream>
#include <stdexcept>
#include <utility>

#include "greens/reciprocity.h"
#include "greens/rigid_motions.h"
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

/// The same model with the vertex nearest to the middle of each piece fixed.
ElasticModel heldInTheMiddle(const ElasticModel& model) {
  const SurfaceMesh& mesh = model.mesh();
  std::vector<Eigen::Vector3d> middles(mesh.bodyCount(), Eigen::Vector3d::Zero());
  std::vector<int> counts(mesh.bodyCount(), 0), nearest(mesh.bodyCount(), -1);
  for (int v = 0; v < mesh.vertexCount(); ++v) {
    middles[mesh.bodyOfVertex(v)] += mesh.points().col(v);
    ++counts[mesh.bodyOfVertex(v)];
  }
  const auto away = [&](int v) {
    const int body = mesh.bodyOfVertex(v);
    return (mesh.points().col(v) - middles[body] / counts[body]).norm();
  };
  for (int v = 0; v < mesh.vertexCount(); ++v) {
    int& best = nearest[mesh.bodyOfVertex(v)];
    if (best < 0 || away(v) < away(best)) best = v;
  }
  std::vector<unsigned char> types(mesh.vertexCount(), 0);
  for (int v : nearest) types[v] = 1;
  return ElasticModel(model.sharedMesh(), model.material(), BoundaryConditions(std::move(types)),
                      model.smoothPatches(), model.domain());
}

}  // namespace

ComputedGreensFunctions computeFreeShellGreensFunctions(const ElasticModel& model,
                                                        const Eigen::Matrix3Xd& thickness,
                                                        const ShellOptions& options,
                                                        const ProgressCallback& callback) {
  requireAllColumns(options.columns, false);
  if (!model.conditions().fixedNodes().empty())
    throw std::invalid_argument("nothing holds an unsupported shell: leave all vertices free");
  if (options.estimateError)
    throw std::invalid_argument(
        "the error of an unsupported shell is not estimated: leave the estimate out");
  const ElasticModel held = heldInTheMiddle(model);
  const ThinShell shell(held, thickness, true);
  ComputedGreensFunctions ofHeld =
      computeShellGreensFunctions(held, shell, {{}, options.reciprocal, false}, callback);
  ComputedGreensFunctions result;
  GreensFunctionsInfo& info = result.info;
  info = infoOf(model, {});
  info.fingerprint =
      shellFingerprint(model.fingerprint(), thickness, heldComponents(model.conditions(), true));
  info.source = ofHeld.info.source + ", unsupported";
  info.reciprocal = options.reciprocal;
  info.diagnostics = std::move(ofHeld.info.diagnostics);
  info.diagnostics.rockingCompliance = Diagnostics().rockingCompliance;

  const Eigen::Index size = 3 * model.mesh().vertexCount();
  result.matrix = AlignedBuffer<double>(size * size);
  Eigen::Map<Eigen::MatrixXd> matrix(result.matrix.data(), size, size);
  matrix.setZero();
  const Eigen::Map<const Eigen::MatrixXd> columns(ofHeld.matrix.data(), size,
                                                  3 * ofHeld.info.columnNodes.size());
  for (std::size_t c = 0; c < ofHeld.info.columnNodes.size(); ++c)
    matrix.middleCols<3>(3 * ofHeld.info.columnNodes[c]) = columns.middleCols<3>(3 * c);
  Eigen::MatrixXd weight = std::move(ofHeld.info.weightResponse);
  for (int node : held.conditions().fixedNodes()) {  // whose rows are reactions
    matrix.middleRows<3>(3 * node).setZero();
    weight.middleRows<3>(3 * node).setZero();
  }
  const Eigen::MatrixXd motions = rigidMotionsOfBodies(model.mesh());
  const shell::ShellSystem system(held, shell);
  const double unit = system.length * system.length * system.length;
  Eigen::MatrixXd resultants = Eigen::MatrixXd::Zero(motions.cols(), 3);
  for (int v = 0; v < model.mesh().vertexCount(); ++v)
    resultants += unit * system.volumes[v] * motions.middleRows<3>(3 * v).transpose();
  info.weightResponse =
      balancedWeight(matrix, weight, resultants, info.vertexAreas, motions, motions);
  removeRigidMotions(result.matrix.data(), info.vertexAreas, motions, motions);
  info.diagnostics.reciprocityDefect =
      makeReciprocal(result.matrix.data(), info.conditions, info.vertexAreas, info.columnNodes,
                     options.reciprocal);
  return result;
}

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
