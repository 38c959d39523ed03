// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imported/imported_greens_functions.h"

#include <algorithm>
#include <cmath>

#include "greens/reciprocity.h"
#include "greens/rigid_motions.h"
#include "imported/given_checks.h"
#include "imported/response.h"
#include "imported/static_condensation.h"
#include "mesh/shells.h"
#include "mesh/triangle_sides.h"
#include "sentence.h"
#include "stopwatch.h"

namespace palpate {
namespace {

using imported::NodePlaces;
using imported::Response;

constexpr const char* kKinds[] = {"compliance", "stiffness"};

void requireSense(const ImportOptions& options) {
  const auto isUnit = [](double unit) { return unit > 1e-30 && unit < 1e30; };
  if (!isUnit(options.lengthUnit) || !isUnit(options.forceUnit))
    refuse("units must be positive, not ", options.lengthUnit, " m and ", options.forceUnit, " N");
  if (!(options.nodeTolerance > 0 && options.nodeTolerance <= 0.1))
    refuse(
        "the distance up to which a node is at a vertex must be above 0 and at most 0.1 of the "
        "surface's diagonal, not ",
        options.nodeTolerance);
  if (options.youngsModulus != 0) Material(options.youngsModulus, 0);  // checks it
}

/// @throws for a closed surface whose normals point into what it encloses.
void requireOutwards(const SurfaceMesh& mesh) {
  bool isClosed = true;
  forEachEdge(sortedSides(mesh.triangles()),
              [&](auto first, auto last) { isClosed = isClosed && last - first == 2; });
  if (!isClosed) return;
  if (enclosedVolume(mesh.points(), mesh.triangles()) <= 0)
    refuse(
        "the normals of this closed surface point into what it encloses: turn its triangles "
        "round (`palpate repair`)");
}

/// The vertices by what becomes of them, and their rows.
struct Parts {
  std::vector<int> free, fixed, held;
  std::vector<int> rows;  ///< of the free, then the fixed ones
};

/// A vertex that a compliance does not move, or that a stiffness does not couple to any other, as
/// where its rows were replaced by ones on the diagonal, is held where the matrix is from.
Parts partsOf(const ElasticModel& model, const NodePlaces& places, const GivenMatrix& matrix,
              MatrixKind kind) {
  const std::vector<RowContent> contents = matrix.rowContents();
  const auto most = [&](int v) {
    RowContent content = RowContent::Nothing;
    for (int row : places.rowsOfVertex.col(v))
      if (row >= 0) content = std::max(content, contents[row]);
    return content;
  };
  const bool anyCoupled = std::count(contents.begin(), contents.end(), RowContent::Coupling) > 0;
  Parts parts;
  for (int v = 0; v < model.mesh().vertexCount(); ++v) {
    const RowContent content = most(v);
    const bool isFixed = model.conditions().isFixed(v), isGiven = places.rowsOfVertex(0, v) >= 0,
               isAlone = content == RowContent::DiagonalAlone && anyCoupled,
               isLoose = kind == MatrixKind::Stiffness && isGiven &&
                         (content == RowContent::Nothing || isAlone);
    if (isLoose && !isFixed)
      refuse("the stiffness does not couple vertex ", v,
             " to any other: fix the vertex if it is held where the matrix is from");
    if (!isGiven || isLoose || content == RowContent::Nothing)
      parts.held.push_back(v);
    else
      (isFixed ? parts.fixed : parts.free).push_back(v);
  }
  if (parts.free.empty()) refuse("no free vertex can move: there is nothing that could be touched");
  for (const std::vector<int>* part : {&parts.free, &parts.fixed})
    for (int v : *part)
      for (int c = 0; c < 3; ++c) parts.rows.push_back(places.rowsOfVertex(c, v));
  return parts;
}

/// Reads a matrix into the response of the surface, and notes what it found on the way.
class Import {
 public:
  Import(const ElasticModel& model, MatrixKind kind, const GivenMatrix& matrix,
         const NodeTable& nodes, const ImportOptions& options, Progress progress)
      : model_(model), kind_(kind), matrix_(matrix), options_(options), progress_(progress) {
    NodeTable placed = nodes.count() > 0 ? nodes : matrix.nodes;
    placed.points *= options.lengthUnit;
    places_ = imported::nodePlaces(matrix, placed, options.order, model.mesh(), model.conditions(),
                                   options.nodeTolerance * model.mesh().diagonal());
    parts_ = partsOf(model, places_, matrix, kind);
    defect_ = matrix.asymmetry();
    const bool mayBeRaw = kind == MatrixKind::Compliance && !options.reciprocal;
    if (!(defect_ <= kMostAsymmetry) && !mayBeRaw)
      refuse("the ", kKinds[int(kind)], " is not symmetric (|M - M^T| / |M| = ", defect_,
             ", at most ", kMostAsymmetry,
             kind == MatrixKind::Compliance ? " unless it shall stay raw" : "",
             "): no linear elastic body has such a one");
  }

  ImportedGreensFunctions result();

 private:
  void compute(Diagnostics& diagnostics);
  Response stiffnessResponse();
  Response looseResponse(Eigen::MatrixXd stiffness);
  Response complianceResponse();
  Eigen::Matrix3Xd pointsOf(const std::vector<int>& vertices) const {
    return model_.mesh().points()(Eigen::all, vertices);
  }
  std::string source() const;
  std::vector<int> columns() const;
  void fill(ComputedGreensFunctions& greens) const;

  const ElasticModel& model_;
  MatrixKind kind_;
  const GivenMatrix& matrix_;
  const ImportOptions& options_;
  Progress progress_;
  NodePlaces places_;
  Parts parts_;
  double defect_ = 0;
  Response response_;
  std::vector<std::string> warnings_;
};

Response Import::stiffnessResponse() {
  imported::requireOrder(matrix_, places_, options_.order);
  Eigen::MatrixXd stiffness =
      imported::condensedStiffness(matrix_, parts_.rows, places_, progress_.part(0.1, 0.5));
  stiffness *= options_.forceUnit / options_.lengthUnit;
  if (options_.unsupported) return looseResponse(std::move(stiffness));
  Eigen::VectorXi pieces(parts_.free.size());
  for (std::size_t i = 0; i < parts_.free.size(); ++i)
    pieces[i] = model_.mesh().bodyOfVertex(parts_.free[i]);
  imported::requireHeld(stiffness, pointsOf(parts_.free), pieces, pointsOf(parts_.fixed),
                        warnings_);
  int row = -1;
  const Eigen::Index free = 3 * parts_.free.size();
  Response response =
      imported::responseOfStiffness(std::move(stiffness), free, row, progress_.part(0.5, 0.9));
  if (row >= 0)
    refuse("the stiffness is not positive definite (found at ", places_.nameOf(parts_.rows[row]),
           "): some deformation would cost no work");
  return response;
}

/// K + s R R^T holds the body by springs that loads which balance each other do not stretch.
Response Import::looseResponse(Eigen::MatrixXd stiffness) {
  if (static_cast<int>(parts_.free.size()) < model_.mesh().vertexCount() ||
      !options_.columns.empty() || model_.mesh().bodyCount() > 1)
    refuse(
        "an unsupported body is in one piece, and all of its vertices are free nodes of the matrix "
        "with Green's functions: leave out what fixes them, and columns");
  imported::requireLoose(stiffness, model_.mesh().points());
  const Eigen::MatrixXd motions = rigidMotionsOfBodies(model_.mesh());
  const double each = stiffness.trace() / static_cast<double>(stiffness.rows());
  stiffness += 3 * each / static_cast<double>(stiffness.rows()) * motions * motions.transpose();
  int row = -1;
  const Eigen::Index size = stiffness.rows();
  Response response =
      imported::responseOfStiffness(std::move(stiffness), size, row, progress_.part(0.5, 0.9));
  if (row >= 0)
    refuse("the stiffness leaves more than rigid motions free (found at ",
           places_.nameOf(parts_.rows[row]), "): some deformation would cost no work");
  return response;
}

Response Import::complianceResponse() {
  if (options_.unsupported)
    refuse("a loose body has no compliance: an unsupported body is imported by its stiffness");
  imported::requireNoStiffness(matrix_, places_);
  Eigen::MatrixXd compliance = matrix_.block(parts_.rows, parts_.rows);
  compliance *= options_.lengthUnit / options_.forceUnit;
  if (options_.reciprocal) compliance = ((compliance + compliance.transpose()) / 2).eval();
  const imported::Negativity negative =
      imported::requireCompliance(compliance, defect_, warnings_, progress_.part(0.1, 0.6));
  if (negative.share > 0)
    refuse("the compliance has a negative eigenvalue, ", negative.value, " m/N or -",
           negative.share, " of the largest (found at ", places_.nameOf(parts_.rows[negative.row]),
           "): forces on that body would win energy");
  progress_.report(0.6, "solve");
  int row = -1;
  const Eigen::Index free = 3 * parts_.free.size();
  Response response =
      imported::responseOfCompliance(std::move(compliance), free, options_.reciprocal, row);
  if (row >= 0)
    refuse("the compliance cannot hold the fixed vertices apart (found at ",
           places_.nameOf(parts_.rows[free + row]), "): they do not move by themselves");
  return response;
}

void Import::compute(Diagnostics& diagnostics) {
  Stopwatch watch;
  response_ = kind_ == MatrixKind::Stiffness ? stiffnessResponse() : complianceResponse();
  if (!response_.compliance.allFinite() || !response_.reactions.allFinite() ||
      !response_.holding.allFinite())
    refuse("the ", kKinds[int(kind_)], " cannot be inverted where vertices are fixed");
  addSeconds(diagnostics, "solve", watch.seconds());
  diagnostics.peakBytes = matrix_.bytes() + sizeof(double) * 3 * response_.compliance.size();
  diagnostics.reciprocityDefect = defect_;
}

std::string Import::source() const {
  std::string text = sentence("imported ", kKinds[int(kind_)], " (", matrix_.format(), ", ",
                              places_.nodeCount, " nodes");
  if (!places_.others.empty())
    text += sentence(", ", places_.others.size(), " degrees of freedom ",
                     kind_ == MatrixKind::Stiffness ? "condensed out" : "left out");
  if (!parts_.held.empty())
    text += sentence(", ", parts_.held.size(), " vertices held where it is from");
  if (options_.unsupported) text += ", unsupported";
  return text + (options_.reciprocal || kind_ == MatrixKind::Stiffness ? ")" : "), raw");
}

std::vector<int> Import::columns() const {
  if (options_.columns.empty()) return parts_.free;
  const std::vector<int> wanted = checkedColumns(model_, options_.columns);
  for (int node : wanted)
    if (std::binary_search(parts_.held.begin(), parts_.held.end(), node))
      refuse("vertex ", node,
             " is held where the matrix is from, which gives no Green's function of it");
  return wanted;
}

/// Xi from the response: per pascal or metre, as metres or pascals.
void Import::fill(ComputedGreensFunctions& greens) const {
  const GreensFunctionsInfo& info = greens.info;
  const Eigen::Index rows = 3 * info.vertexAreas.size(), free = parts_.free.size(),
                     fixed = parts_.fixed.size();
  std::vector<Eigen::Index> place(info.vertexAreas.size(), -1);
  for (Eigen::Index i = 0; i < free; ++i) place[parts_.free[i]] = i;
  for (Eigen::Index i = 0; i < fixed; ++i) place[parts_.fixed[i]] = i;
  greens.matrix = AlignedBuffer<double>(rows * 3 * info.columnNodes.size());
  Eigen::Map<Eigen::MatrixXd> matrix(greens.matrix.data(), rows, 3 * info.columnNodes.size());
  matrix.setZero();
  for (std::size_t c = 0; c < info.columnNodes.size(); ++c) {
    const int node = info.columnNodes[c];
    const bool isFixed = info.conditions.isFixed(node);
    const double per = isFixed ? 1 : info.vertexAreas[node];
    const Eigen::MatrixXd& ofFree = isFixed ? response_.moved : response_.compliance;
    const Eigen::MatrixXd& ofFixed = isFixed ? response_.holding : response_.reactions;
    for (Eigen::Index i = 0; i < free; ++i)
      matrix.block<3, 3>(3 * parts_.free[i], 3 * c) =
          per * ofFree.block<3, 3>(3 * i, 3 * place[node]);
    for (Eigen::Index i = 0; i < fixed; ++i)
      matrix.block<3, 3>(3 * parts_.fixed[i], 3 * c) =
          per / info.vertexAreas[parts_.fixed[i]] * ofFixed.block<3, 3>(3 * i, 3 * place[node]);
  }
}

ImportedGreensFunctions Import::result() {
  Diagnostics diagnostics;
  compute(diagnostics);
  const double apparent =
      options_.unsupported
          ? imported::looseModulus(response_.compliance, model_.mesh().meanEdgeLength())
          : imported::apparentModulus(response_.compliance, model_.mesh().diagonal());
  imported::warnOfUnits(apparent, warnings_);
  std::vector<unsigned char> types(model_.mesh().vertexCount(), 0);
  for (int node : parts_.fixed) types[node] = 1;
  ElasticModel model(model_.sharedMesh(),
                     Material(options_.youngsModulus > 0 ? options_.youngsModulus : apparent, 0),
                     BoundaryConditions(std::move(types)), model_.smoothPatches(), Domain::Given);
  ComputedGreensFunctions greens;
  greens.info = infoOf(model, columns());
  greens.info.homogeneous = false;
  greens.info.reciprocal = options_.reciprocal || kind_ == MatrixKind::Stiffness;
  greens.info.source = source();
  greens.info.diagnostics = std::move(diagnostics);
  greens.info.diagnostics.warnings = std::move(warnings_);
  progress_.report(0.9, "check");
  fill(greens);
  if (options_.unsupported) {
    const Eigen::MatrixXd motions = rigidMotionsOfBodies(model.mesh());
    removeRigidMotions(greens.matrix.data(), greens.info.vertexAreas, motions, motions);
  } else {
    greens.info.diagnostics.rockingCompliance = rockingCompliance(*greens.view(), model.mesh());
  }
  progress_.report(1, "done");
  return {std::move(model), std::move(greens)};
}

}  // namespace

ImportedGreensFunctions importGreensFunctions(const ElasticModel& model, MatrixKind kind,
                                              const GivenMatrix& matrix, const NodeTable& nodes,
                                              const ImportOptions& options,
                                              const ProgressCallback& progress) {
  if (model.domain() != Domain::Given)
    throw std::invalid_argument("a matrix is given of no domain that Palpate knows");
  requireSense(options);
  requireOutwards(model.mesh());
  return Import(model, kind, matrix, nodes, options, Progress(progress)).result();
}

}  // namespace palpate
