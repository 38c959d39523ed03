// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fem/finite_element_method.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>

#include "fem/solid_system.h"
#include "fem/surface_response.h"
#include "greens/error_estimate.h"
#include "greens/reciprocity.h"
#include "greens/replaced_rows.h"
#include "greens/rigid_motions.h"
#include "mesh/surface_locator.h"
#include "sentence.h"
#include "stopwatch.h"

namespace palpate {
namespace {

using fem::LoadHat;
using fem::WantedColumn;

/// One hat a free vertex, or where tractions on single patches are wanted one a patch that meets at
/// it.
std::vector<LoadHat> loadHats(const ElasticModel& model, bool byPatch) {
  std::vector<LoadHat> hats;
  for (int v : model.conditions().freeNodes()) {
    std::set<int> patches;
    for (int f : model.mesh().trianglesOfVertex(v)) patches.insert(model.smoothPatches()[f]);
    if (byPatch && patches.size() > 1)
      for (int patch : patches) hats.push_back({v, patch});
    else
      hats.push_back({v, -1});
  }
  return hats;
}

std::vector<WantedColumn> wantedColumns(const GreensFunctionsInfo& info,
                                        const std::vector<LoadHat>& hats) {
  std::vector<WantedColumn> wanted;
  for (int node : info.columnNodes)
    wanted.push_back(
        {info.conditions.isFixed(node) ? WantedColumn::Displacement : WantedColumn::Force, node});
  for (const PatchColumn& column : info.patchColumns)
    for (std::size_t h = 0; h < hats.size(); ++h)
      if (hats[h].vertex == column.node && hats[h].patch == column.patch)
        wanted.push_back({WantedColumn::Traction, static_cast<int>(h)});
  wanted.push_back({WantedColumn::Load, 0});
  return wanted;
}

std::string describeSource(const SolidBody& body, SolidElement element) {
  std::ostringstream text;
  text << "finite elements (" << (element == SolidElement::Linear ? "linear" : "quadratic")
       << " tetrahedra, " << body.mesh().cellCount() << " of them";
  if (body.materialCount() > 1) text << ", " << body.materialCount() << " materials";
  text << ")";
  return text.str();
}

AlignedBuffer<double> taken(const Eigen::Ref<const Eigen::MatrixXd>& columns) {
  AlignedBuffer<double> buffer(columns.size());
  Eigen::Map<Eigen::MatrixXd>(buffer.data(), columns.rows(), columns.cols()) = columns;
  return buffer;
}

constexpr double kEstimateShare = 0.3;

void requireHeldComponents(const HeldDisplacements& held, const ElasticModel& model) {
  if (held.cols() == 0) return;
  if (held.cols() != model.mesh().vertexCount())
    refuse("there are held components of ", held.cols(), " vertices, the surface has ",
           model.mesh().vertexCount());
  if (model.domain() == Domain::Unsupported)
    refuse("an unsupported body has no held components: leave them out");
  for (int v : model.conditions().freeNodes())
    if (held.col(v).all()) refuse("vertex ", v, " is free, but all of it is held: fix it");
}

/// Rows of probes in the model's units, of the nodes whose columns there are.
std::shared_ptr<const ProbeRows> probesOf(const SolidBody& body, const Eigen::Matrix3Xd& points,
                                          const GreensFunctionsInfo& info,
                                          const Eigen::MatrixXd& values,
                                          const std::vector<double>& perGiven, double length,
                                          double stiffness) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(values.rows(), 3 * info.conditions.nodeCount());
  for (std::size_t c = 0; c < info.columnNodes.size(); ++c)
    rows.middleCols<3>(3 * info.columnNodes[c]) = perGiven[c] * values.middleCols<3>(3 * c);
  std::vector<Matrix6d> stiffnesses;
  for (const fem::SolidProbe& probe : fem::locateProbes(body, points)) {
    const Eigen::Index row = 13 * static_cast<Eigen::Index>(stiffnesses.size());
    rows.middleRows<3>(row) *= length;
    rows.row(row + 12) *= stiffness;
    stiffnesses.push_back(body.material(probe.cell).stiffness());
  }
  return std::make_shared<const ProbeRows>(points, std::move(rows), std::move(stiffnesses));
}

/// From bodies that springs hold to those that nothing does, as removeRigidMotions does: Green's
/// functions, weight and probes.
void loosen(const ElasticModel& model, const fem::SurfaceResponse& response,
            ComputedGreensFunctions& result) {
  GreensFunctionsInfo& info = result.info;
  const Eigen::Index size = 3 * info.vertexAreas.size();
  const Eigen::Map<const Eigen::MatrixXd> held(result.matrix.data(), size, size);
  const Eigen::MatrixXd &displaced = response.displacedMotions, &loaded = response.loadedMotions;
  const Eigen::MatrixXd mean = meanRigidMotion(info.vertexAreas, displaced),
                        balance = meanRigidMotion(info.vertexAreas, loaded);
  info.weightResponse = balancedWeight(held, info.weightResponse, response.weightResultants,
                                       info.vertexAreas, displaced, loaded);
  if (const auto probes = info.probes) {
    Eigen::MatrixXd rows = probes->rows();
    rows -= rigidMotionsInside(model.sharedMesh(), probes->points()) * (mean * held);
    rows -= (rows * loaded).eval() * balance;
    info.probes = withRows(*probes, std::move(rows));
  }
  removeRigidMotions(result.matrix.data(), info.vertexAreas, displaced, loaded);
}

/// The same method for another mesh, filled with the same material.
EstimatedMethod estimatedMethod(const FiniteElementOptions& options, const Elasticity& material) {
  FiniteElementOptions all;
  all.element = options.element;
  all.reciprocal = options.reciprocal;
  const auto solve = [all, material](const ElasticModel& model, const Progress& progress) {
    progress.report(0, "estimate");
    const Tetrahedralization filled = tetrahedralize(model.mesh());
    const ElasticModel onIt = onBoundary(model, filled);
    const auto report = [&](double fraction, const char*) {
      progress.report(0.5 + fraction / 2, "estimate");
      return true;
    };
    return computeFiniteElementGreensFunctions(
               onIt, SolidBody(onIt.mesh(), filled.mesh, {material}), all, report)
        .take();
  };
  return {solve, false};
}

}  // namespace

std::uint64_t heldFingerprint(const HeldDisplacements& held, std::uint64_t ofModel) {
  return Fingerprint()
      .add(&ofModel, sizeof ofModel)
      .add(held.data(), sizeof(bool) * held.size())
      .value();
}

ElasticModel onBoundary(const ElasticModel& model, const Tetrahedralization& filled) {
  if (filled.newBoundaryPoints > 0)
    throw std::runtime_error("filling the surface took new vertices on it");
  if (filled.lostTriangles == 0) return model;
  const SurfaceLocator locator(model.sharedMesh());
  const auto mesh =
      std::make_shared<const SurfaceMesh>(model.mesh().points(), filled.mesh.boundary());
  Eigen::VectorXi patches(mesh->triangleCount());
  for (int f = 0; f < patches.size(); ++f) {
    const Eigen::Vector3d middle =
        mesh->points()(Eigen::all, mesh->triangles().col(f)).rowwise().mean();
    patches[f] = model.smoothPatches()[locator.nearest(middle).triangle];
  }
  return ElasticModel(mesh, model.material(), model.conditions(), std::move(patches),
                      model.domain());
}

ComputedGreensFunctions computeFiniteElementGreensFunctions(const ElasticModel& model,
                                                            const SolidBody& body,
                                                            const FiniteElementOptions& options,
                                                            const ProgressCallback& callback) {
  if (model.domain() != Domain::Interior && model.domain() != Domain::Unsupported)
    throw std::invalid_argument("finite elements fill the inside of a surface, no other domain");
  if (model.domain() == Domain::Unsupported)
    requireAllColumns(options.columns, options.patchColumns);
  requireHeldComponents(options.held, model);
  const bool isEstimated =
      options.estimateError && body.materialCount() == 1 && options.held.cols() == 0;
  const Progress whole(callback);
  const Progress progress = whole.part(0, isEstimated ? 1 - kEstimateShare : 1);
  ComputedGreensFunctions result;
  GreensFunctionsInfo& info = result.info;
  info = infoOf(model, options.columns);
  if (options.held.any()) info.fingerprint = heldFingerprint(options.held, info.fingerprint);
  // What holds single components bears tractions that nobody is told, without which the surface's
  // solution says nothing of the inside.
  info.homogeneous = body.isOf(model.material()) && !options.held.any();
  info.density = body.density();
  info.source = describeSource(body, options.element);
  info.reciprocal = options.reciprocal;
  info.diagnostics.warnings =
      options.element == SolidElement::Linear
          ? modelWarnings(model, info.diagnostics.wallRatio, info.diagnostics.supportWidth)
          : supportWarnings(model, info.diagnostics.supportWidth);

  Stopwatch watch;
  std::vector<LoadHat> hats = loadHats(model, options.patchColumns);
  for (const LoadHat& hat : hats)
    if (hat.patch >= 0) info.patchColumns.push_back({hat.vertex, hat.patch});
  const std::vector<WantedColumn> wanted = wantedColumns(info, hats);
  fem::SolidSystem system(model, body, options.element, std::move(hats), options.held,
                          fem::locateProbes(body, options.probes), progress.part(0, 0.1));
  addSeconds(info.diagnostics, "assemble", watch.seconds());

  const fem::MortarShares shares =
      options.reciprocal ? fem::MortarShares{0.5, 0.5} : fem::MortarShares{0, 1};
  const double length = system.length, stiffness = system.stiffness;
  fem::SurfaceResponse response =
      fem::surfaceResponse(std::move(system), model, wanted, shares, progress.part(0.1, 0.95));
  std::vector<double> perGiven = perGivenOfNodes(info, length, stiffness);
  perGiven.resize(perGiven.size() + info.patchColumns.size(), 1 / stiffness);
  perGiven.push_back(length / stiffness);  // of the weight
  if (options.probes.cols() > 0)
    info.probes =
        probesOf(body, options.probes, info, response.probes, perGiven, length, stiffness);
  scaleToModel(info, length, stiffness, perGiven, response.columns);
  addSeconds(info.diagnostics, "solve", watch.seconds());
  info.diagnostics.rotationDefect = response.rigidMotionDefect;
  info.diagnostics.peakBytes = response.peakBytes + sizeof(double) * response.columns.size();

  const Eigen::Index ownColumns = 3 * info.columnNodes.size();
  result.matrix = taken(response.columns.leftCols(ownColumns));
  if (!info.patchColumns.empty())
    result.patchMatrix =
        taken(response.columns.middleCols(ownColumns, 3 * info.patchColumns.size()));
  info.weightResponse = response.columns.rightCols<3>();
  if (info.domain == Domain::Unsupported) {
    response.weightResultants *= length * length * length;
    loosen(model, response, result);
  }
  info.diagnostics.reciprocityDefect =
      makeReciprocal(result.matrix.data(), info.conditions, info.vertexAreas, info.columnNodes,
                     options.reciprocal);
  if (info.domain == Domain::Interior)
    info.diagnostics.rockingCompliance = rockingCompliance(*result.view(), model.mesh());
  addSeconds(info.diagnostics, "check", watch.seconds());
  if (isEstimated) {
    info.diagnostics.error = estimateError(model, estimatedMethod(options, body.material(0)),
                                           *result.view(), whole.part(1 - kEstimateShare, 1));
    addSeconds(info.diagnostics, "estimate", watch.seconds());
  }
  whole.report(1, "done");
  return result;
}

}  // namespace palpate
