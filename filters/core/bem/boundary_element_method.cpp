// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/boundary_element_method.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "bem/body_surface.h"
#include "bem/exchanged_system.h"
#include "greens/dense_greens_functions.h"
#include "greens/reciprocity.h"
#include "greens/rigid_motions.h"
#include "linear_algebra/dense_lu.h"
#include "linear_algebra/iterative_solve.h"
#include "linear_algebra/multi_precision_solve.h"
#include "model/support.h"
#include "parallel.h"
#include "stopwatch.h"

namespace palpate {
namespace {

using bem::BodySurface;
using bem::CollocationScheme;

constexpr double kAssembleShare = 0.1;  // of the time, for the progress display
constexpr double kEstimateShare = 0.1;

/// Green's functions of all bodies in one matrix of the given storage.
template <class Scalar>
class Precomputation {
 public:
  Precomputation(const ElasticModel& model, const BoundaryElementOptions& options,
                 GreensFunctionsInfo& info, const Progress& progress)
      : model_(model), options_(options), info_(info), progress_(progress) {}

  AlignedBuffer<Scalar> run() {
    const int bodies = BodySurface::bodyCount(model_);
    if (options_.patchColumns)
      for (int body = 0; body < bodies; ++body) listPatchColumns(BodySurface(model_, body));
    const std::size_t rows = 3 * std::size_t(model_.mesh().vertexCount());
    const std::size_t columns = 3 * (info_.columnNodes.size() + info_.patchColumns.size());
    if (bodies > 1) {
      matrix_ = AlignedBuffer<Scalar>(rows * columns);
      std::memset(matrix_.data(), 0, matrix_.bytes());
    }
    for (int body = 0; body < bodies; ++body)
      computeBody(BodySurface(model_, body),
                  progress_.part(double(body) / bodies, double(body + 1) / bodies));
    return std::move(matrix_);
  }

 private:
  /// The traction nodes of vertices on sharp edges where the reference problem gives the traction.
  void listPatchColumns(const BodySurface& body) {
    const CollocationScheme scheme(body, options_.collocation);
    std::vector<bool> isUnknown(body.nodes.count(), false);
    for (const bem::TractionUnknown& unknown : scheme.tractions)
      for (int node : unknown.nodes) isUnknown[node] = true;
    for (int v = 0; v < body.vertexCount(); ++v)
      for (int node = body.nodes.first(v); node < body.nodes.end(v); ++node)
        if (body.nodes.end(v) - body.nodes.first(v) > 1 && !isUnknown[node])
          info_.patchColumns.push_back({body.vertices[v], body.nodes.patch[node]});
  }

  /// Which columns of the result belong to a body: local vertex or traction node, and the column.
  struct BodyColumns {
    bem::SystemColumns wanted;
    std::vector<int> resultColumn;
  };

  BodyColumns columnsOf(const BodySurface& body) const {
    std::vector<int> local(model_.mesh().vertexCount(), -1);
    for (int v = 0; v < body.vertexCount(); ++v) local[body.vertices[v]] = v;
    BodyColumns columns;
    for (std::size_t c = 0; c < info_.columnNodes.size(); ++c) {
      const int v = local[info_.columnNodes[c]];
      if (v < 0) continue;
      columns.wanted.vertices.push_back(v);
      columns.resultColumn.push_back(static_cast<int>(c));
    }
    for (std::size_t c = 0; c < info_.patchColumns.size(); ++c) {
      const int v = local[info_.patchColumns[c].node];
      if (v < 0) continue;
      for (int node = body.nodes.first(v); node < body.nodes.end(v); ++node)
        if (body.nodes.patch[node] == info_.patchColumns[c].patch)
          columns.wanted.patchTractions.push_back(node);
      columns.resultColumn.push_back(static_cast<int>(info_.columnNodes.size() + c));
    }
    return columns;
  }

  void computeBody(const BodySurface& body, const Progress& progress) {
    const BodyColumns columns = columnsOf(body);
    if (columns.resultColumn.empty()) return;
    const int threads = threadCount(options_.threads);
    Diagnostics& diagnostics = info_.diagnostics;
    Stopwatch watch;
    const CollocationScheme scheme(body, options_.collocation);
    bem::ExchangedSystem<Scalar> system =
        bem::assembleSystem<Scalar>(body, scheme, columns.wanted, options_.tolerance, threads,
                                    progress.part(0, kAssembleShare));
    if (model_.domain() == Domain::Unsupported) holdRigidMotions(body, system);
    addSeconds(diagnostics, "assemble", watch.seconds());

    const BlasThreads blasThreads(threads);
    const SolveReport report = solve(system, progress.part(kAssembleShare, 1));
    system.matrix = {};
    addSeconds(diagnostics, "solve", watch.seconds());
    requireRegular(report.conditionEstimate);
    diagnostics.conditionEstimate =
        std::max(diagnostics.conditionEstimate, report.conditionEstimate);
    diagnostics.solverResidual = std::max(diagnostics.solverResidual, report.residual);
    diagnostics.rotationDefect = std::max(diagnostics.rotationDefect, system.rotationDefect);
    diagnostics.peakBytes = std::max(diagnostics.peakBytes, report.peakBytes + matrix_.bytes());
    averageTractions(body, scheme, system);
    scaleToModel(body, columns, system);
    scatter(body, columns, system);
  }

  /// Without support H has the rigid motions R for its null space: H + R (R^T A R)^-1 R^T A is
  /// regular, and solves for balanced loads as H does.
  static void holdRigidMotions(const BodySurface& body, bem::ExchangedSystem<Scalar>& system) {
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(body.vertexCount());
    for (int node = 0; node < body.nodes.count(); ++node)
      areas[body.nodes.vertex[node]] += body.nodes.area[node];
    const Eigen::MatrixXd motions = rigidMotions(body.points, body.points.rowwise().mean(), 1);
    const Eigen::MatrixXd mean = meanRigidMotion(areas, motions);
    Columns matrix(system.matrix.data(), system.size, system.size,
                   Eigen::OuterStride<>(system.stride));
    for (int i = 0; i < system.size; ++i)
      matrix.row(system.diagonalRows[i]) += (motions.row(i) * mean).template cast<Scalar>();
  }

  SolveReport solve(bem::ExchangedSystem<Scalar>& system, const Progress& progress) const {
    if constexpr (std::is_same_v<Scalar, double>) {
      if (options_.solver == LinearSolver::Iterative)
        return solveIterativeInPlace(system.matrix, system.size, system.stride, system.diagonalRows,
                                     system.right, system.columns, {}, progress);
      if (options_.precision == Precision::Mixed)
        return solveMixedInPlace(system.matrix, system.size, system.stride, system.right,
                                 system.columns, progress);
    }
    return solveInPlace(system.matrix, system.size, system.stride, system.right, system.columns,
                        progress);
  }

  /// Half of a double's digits at least must be left, or a hundredth in float.
  static void requireRegular(double condition) {
    constexpr bool isFloat = std::is_same_v<Scalar, float>;
    const double epsilon = std::numeric_limits<Scalar>::epsilon();
    const double largest = isFloat ? 0.01 / epsilon : 1 / std::sqrt(epsilon);
    if (condition < largest) return;
    std::ostringstream text;
    text << "the boundary element system has the condition number " << condition << ", above "
         << largest << ": "
         << (isFloat ? "too much for float precision, use double or mixed"
                     : "the surface or its support is degenerate somewhere");
    throw std::runtime_error(text.str());
  }

  using Columns =
      Eigen::Map<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>, 0, Eigen::OuterStride<>>;
  static Columns solution(bem::ExchangedSystem<Scalar>& system) {
    return Columns(system.right.data(), system.size, system.columns,
                   Eigen::OuterStride<>(system.stride));
  }

  /// A fixed vertex's row becomes the area-weighted mean of its patches' tractions, so that area
  /// times row is the exact reaction.
  void averageTractions(const BodySurface& body, const CollocationScheme& scheme,
                        bem::ExchangedSystem<Scalar>& system) const {
    Columns x = solution(system);
    std::vector<double> area(body.vertexCount(), 0);
    for (int node = 0; node < body.nodes.count(); ++node)
      area[body.nodes.vertex[node]] += body.nodes.area[node];
    for (std::size_t t = 0; t < scheme.tractions.size(); ++t) {
      const int v = scheme.tractions[t].vertex, block = scheme.tractions[t].column;
      const bem::TractionUnknown& unknown = scheme.tractions[t];
      const auto share = static_cast<Scalar>(unknown.scale * unknown.area / area[v]);
      if (block == v)
        x.template middleRows<3>(3 * v) *= share;
      else
        x.template middleRows<3>(3 * v) += share * x.template middleRows<3>(3 * block);
    }
  }

  /// From lengths of the body and unit shear modulus to the model's units.
  void scaleToModel(const BodySurface& body, const BodyColumns& columns,
                    bem::ExchangedSystem<Scalar>& system) const {
    Columns x = solution(system);
    const double shearModulus = model_.material().shearModulus();
    for (int c = 0; c < columns.wanted.count(); ++c) {
      const bool givenDisplacement = c < static_cast<int>(columns.wanted.vertices.size()) &&
                                     body.fixed[columns.wanted.vertices[c]];
      const double perGiven = givenDisplacement ? 1 / body.length : 1 / shearModulus;
      for (int v = 0; v < body.vertexCount(); ++v)
        x.template block<3, 3>(3 * v, 3 * c) *=
            static_cast<Scalar>(perGiven * (body.fixed[v] ? shearModulus : body.length));
    }
  }

  /// Moves a body's columns into the result; a single body's matrix becomes the result in place.
  void scatter(const BodySurface& body, const BodyColumns& columns,
               bem::ExchangedSystem<Scalar>& system) {
    const std::size_t rows = 3 * std::size_t(model_.mesh().vertexCount());
    if (BodySurface::bodyCount(model_) == 1) {
      for (int c = 0; c < system.columns && rows < std::size_t(system.stride); ++c)
        std::memmove(system.right.data() + c * rows,
                     system.right.data() + c * std::size_t(system.stride), rows * sizeof(Scalar));
      matrix_ = std::move(system.right);
      matrix_.truncate(rows * system.columns);
      return;
    }
    for (int c = 0; c < columns.wanted.count(); ++c)
      for (int j = 0; j < 3; ++j) {
        const Scalar* from = system.right.data() + (3 * std::size_t(c) + j) * system.stride;
        Scalar* to = matrix_.data() + (3 * std::size_t(columns.resultColumn[c]) + j) * rows;
        for (int v = 0; v < body.vertexCount(); ++v)
          std::copy_n(from + 3 * v, 3, to + 3 * std::size_t(body.vertices[v]));
      }
  }

  const ElasticModel& model_;
  const BoundaryElementOptions& options_;
  GreensFunctionsInfo& info_;
  Progress progress_;
  AlignedBuffer<Scalar> matrix_;
};

std::string describeSource(const ElasticModel& model, const BoundaryElementOptions& options) {
  static const char* const precisions[] = {"double", "mixed", "float"};
  std::ostringstream text;
  text << "boundary elements (linear triangles, "
       << (options.collocation == Collocation::Vertex ? "vertex" : "averaged") << " collocation), "
       << (model.domain() == Domain::Exterior      ? "exterior domain, "
           : model.domain() == Domain::Unsupported ? "interior domain, unsupported, "
                                                   : "interior domain, ")
       << precisions[static_cast<int>(options.precision)] << " precision, "
       << (options.solver == LinearSolver::Iterative ? "iterative solver, " : "")
       << "integration tolerance " << options.tolerance << ", "
       << (options.reciprocal ? "reciprocal" : "raw");
  return text.str();
}

/// A fully fixed incompressible body would leave its mean pressure undetermined.
void requireDeterminedPressure(const ElasticModel& model, const std::vector<int>& columns) {
  if (model.material().poissonRatio() < 0.5 || model.domain() == Domain::Exterior) return;
  std::vector<bool> hasFree(model.mesh().bodyCount(), false);
  for (int node : model.conditions().freeNodes()) hasFree[model.mesh().bodyOfVertex(node)] = true;
  for (int node : columns)
    if (!hasFree[model.mesh().bodyOfVertex(node)])
      throw std::invalid_argument(
          "the body of vertex " + std::to_string(node) +
          " is incompressible and fixed all over: its pressure is undetermined");
}

/// Bodies whose mesh resolves them stay below a quarter; beyond this, symmetrising cannot mend it.
constexpr double kLargestReciprocityDefect = 0.5;

void warnOfReciprocityDefect(Diagnostics& diagnostics) {
  if (!(diagnostics.reciprocityDefect > kLargestReciprocityDefect)) return;
  std::ostringstream text;
  text.precision(3);
  text << "the compliance is far from reciprocal (defect " << diagnostics.reciprocityDefect
       << "), so that much of it is wrong: the mesh is too coarse for thin walls, or strips of "
          "needles cross an auxetic body; remesh it";
  diagnostics.warnings.push_back(text.str());
}

/// Moves the patch columns, which stand last, to a matrix of their own; makes the rest reciprocal.
template <class Scalar>
void finish(AlignedBuffer<Scalar>& matrix, AlignedBuffer<Scalar>& patchMatrix,
            const ElasticModel& model, const BoundaryElementOptions& options,
            GreensFunctionsInfo& info) {
  Stopwatch watch;
  if (model.domain() == Domain::Unsupported) {
    const Eigen::MatrixXd motions = rigidMotionsOfBodies(model.mesh());
    removeRigidMotions(matrix.data(), info.vertexAreas, motions, motions);
  }
  const std::size_t block = 9 * std::size_t(model.mesh().vertexCount());
  if (!info.patchColumns.empty()) {
    patchMatrix = AlignedBuffer<Scalar>(block * info.patchColumns.size());
    std::copy_n(matrix.data() + block * info.columnNodes.size(), patchMatrix.size(),
                patchMatrix.data());
    matrix.truncate(block * info.columnNodes.size());
  }
  // Up to nu = 0.45 the change of volume is not small enough to be lost, and a column does not
  // depend on which others were asked for; from 0.49 on it is kept.
  const double keptShare =
      std::clamp((model.material().poissonRatio() - 0.45) / (0.49 - 0.45), 0.0, 1.0);
  std::vector<Eigen::Matrix3Xd> kept;
  if (model.domain() != Domain::Exterior && keptShare > 0) kept = unitPressures(model.mesh());
  info.diagnostics.reciprocityDefect =
      makeReciprocal(matrix.data(), info.conditions, info.vertexAreas, info.columnNodes,
                     options.reciprocal, kept, keptShare);
  warnOfReciprocityDefect(info.diagnostics);
  info.reciprocal = options.reciprocal;
  if (model.domain() == Domain::Interior) {
    const DenseGreensFunctions<Scalar> view(info, matrix.data(), patchMatrix.data(), nullptr);
    info.diagnostics.rockingCompliance = rockingCompliance(view, model.mesh());
  }
  addSeconds(info.diagnostics, "check", watch.seconds());
}

}  // namespace

EstimatedMethod estimatedMethod(const BoundaryElementOptions& options) {
  BoundaryElementOptions all;
  all.collocation = options.collocation;
  all.tolerance = options.tolerance;
  all.reciprocal = options.reciprocal;
  all.threads = options.threads;
  const auto solve = [all](const ElasticModel& model, const Progress& progress) {
    const auto report = [&](double fraction, const char*) {
      progress.report(fraction, "estimate");
      return true;
    };
    return computeBoundaryElementGreensFunctions(model, all, report).take();
  };
  return {solve, true};
}

ComputedGreensFunctions computeBoundaryElementGreensFunctions(const ElasticModel& model,
                                                              const BoundaryElementOptions& options,
                                                              const ProgressCallback& progress) {
  if (!(options.tolerance >= 0 && options.tolerance < 1))
    throw std::invalid_argument("the integration tolerance must be at least 0 and below 1, not " +
                                std::to_string(options.tolerance));
  if (options.solver == LinearSolver::Iterative && options.precision != Precision::Double)
    throw std::invalid_argument("the iterative solver works in double precision alone");
  ComputedGreensFunctions result;
  GreensFunctionsInfo& info = result.info;
  info = infoOf(model, options.columns);
  info.source = describeSource(model, options);
  info.diagnostics.quadratureTolerance = options.tolerance;
  info.diagnostics.warnings =
      modelWarnings(model, info.diagnostics.wallRatio, info.diagnostics.supportWidth);
  requireDeterminedPressure(model, info.columnNodes);

  if (model.domain() == Domain::Unsupported)
    requireAllColumns(options.columns, options.patchColumns);
  const Progress whole(progress);
  const Progress own = whole.part(0, options.estimateError ? 1 - kEstimateShare : 1);
  if (options.precision == Precision::Float) {
    result.floatMatrix = Precomputation<float>(model, options, info, own).run();
    finish(result.floatMatrix, result.floatPatchMatrix, model, options, info);
  } else {
    result.matrix = Precomputation<double>(model, options, info, own).run();
    finish(result.matrix, result.patchMatrix, model, options, info);
  }
  if (options.estimateError) {
    Stopwatch watch;
    info.diagnostics.error = estimateError(model, estimatedMethod(options), *result.view(),
                                           whole.part(1 - kEstimateShare, 1));
    addSeconds(info.diagnostics, "estimate", watch.seconds());
  }
  whole.report(1, "done");
  return result;
}

}  // namespace palpate
