// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/elastic_foundation.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <numeric>
#include <utility>

#include "greens/gravity.h"
#include "greens/reciprocity.h"
#include "greens/replaced_rows.h"
#include "greens/rigid_motions.h"
#include "sentence.h"
#include "stopwatch.h"

namespace palpate {
namespace {

constexpr double kSymmetric = 1e-9;  // relative: what rounding leaves of a rotated block

/// What springs there are: the vertices that they release, and the free ones that they act on.
struct Springs {
  std::vector<int> released, free;

  Springs(const GreensFunctions& greens, const Eigen::Matrix3Xd& blocks) {
    if (blocks.cols() != 3 * greens.nodeCount())
      refuse("there are springs for ", blocks.cols() / 3.0, " vertices of ", greens.nodeCount());
    for (int v = 0; v < greens.nodeCount(); ++v) {
      const Eigen::Matrix3d block = blocks.middleCols<3>(3 * v);
      if (block.isZero(0)) continue;
      if (!block.allFinite()) refuse("the spring at vertex ", v, " is not finite");
      if ((block - block.transpose()).norm() > kSymmetric * block.norm())
        refuse("the spring at vertex ", v, " is not symmetric: it would win energy");
      const Eigen::Vector3d stiffness =
          Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(block, Eigen::EigenvaluesOnly)
              .eigenvalues();
      if (stiffness[0] < -kSymmetric * stiffness[2])
        refuse("the spring at vertex ", v, " has the negative stiffness ", stiffness[0], " N/m");
      if (greens.isFixed(v) && !(stiffness[0] > kSymmetric * stiffness[2]))
        refuse("vertex ", v,
               " is fixed, and its spring resists some directions only: give it a stiffness in all "
               "three, or none to keep it fixed");
      (greens.isFixed(v) ? released : free).push_back(v);
    }
    if (released.empty() && free.empty())
      refuse(
          "there is no spring of any stiffness: give the foundation one, or single vertices "
          "springs");
    for (int v : released)
      if (!greens.hasColumn(v))
        refuse("the Green's functions of the support (vertex ", v,
               ") were not computed, so that it cannot give way: precompute with "
               "--support-columns (in Python columns=np.arange(n))");
  }
};

/// Whether nothing holds the bodies: the model says so, or tractions that vary like a rigid motion,
/// which are then balanced by themselves, do nothing.
bool isUnsupported(const GreensFunctions& greens, const ElasticModel& model) {
  if (model.domain() == Domain::Unsupported) return true;
  const bool canBe = model.domain() == Domain::Shell || model.domain() == Domain::Given;
  if (!canBe || greens.columnCount() < greens.nodeCount() ||
      !model.conditions().fixedNodes().empty())
    return false;
  constexpr double rounding = 1e-6;  // of thin sheets, which answer little to most loads
  std::vector<int> all(greens.nodeCount());
  std::iota(all.begin(), all.end(), 0);
  const auto answerTo = [&](const Eigen::VectorXd& tractions) {
    Eigen::VectorXd answer = Eigen::VectorXd::Zero(tractions.size());
    greens.accumulate(nodeList(all), tractions, answer);
    return answer.norm();
  };
  // As large, as smooth, and of no rigid motion.
  const Eigen::MatrixXd motions = rigidMotionsOfBodies(model.mesh());
  const Eigen::Matrix3Xd& points = model.mesh().points();
  const Eigen::Vector3d middle = points.rowwise().mean();
  double scale = 0;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::VectorXd bent(3 * greens.nodeCount());
    for (int v = 0; v < greens.nodeCount(); ++v)
      bent.segment<3>(3 * v).setConstant(
          std::pow((points(axis, v) - middle[axis]) / model.mesh().diagonal(), 2));
    scale = std::max(scale, answerTo(bent));
  }
  for (const auto& motion : motions.colwise())
    if (answerTo(motion) > rounding * scale) return false;
  return true;
}

/// The answers of a body to all that is given: columns of Xi, and what its weight does; inside, at
/// its probes, those to the former.
class Answers {
 public:
  Answers(const GreensFunctions& greens, const ElasticModel& model, const Eigen::Matrix3Xd& springs,
          const Springs& where, std::shared_ptr<const ProbeRows> probes)
      : greens_(greens),
        model_(model),
        springs_(springs),
        where_(where),
        probes_(std::move(probes)),
        isLoose_(isUnsupported(greens, model)),
        types_(model.conditions().types()) {
    for (int v : where.released) types_[v] = 0;
    greens.requireColumns(nodeList(model.conditions().freeNodes()));
    for (int v = 0; v < greens.nodeCount(); ++v)
      if (greens.hasColumn(v)) columns_.push_back(v);
    std::vector<int> rows(greens.nodeCount());
    std::iota(rows.begin(), rows.end(), 0);
    ofWeight_ = isLoose_ ? looseWeightResponse(greens, model.mesh(), model.smoothPatches())
                         : greens.info().weightResponse;
    answers_.resize(3 * rows.size(), 3 * columns_.size() + ofWeight_.cols());
    greens.gather(nodeList(rows), nodeList(columns_), answers_.data());
    answers_.rightCols(ofWeight_.cols()) = ofWeight_.topRows(answers_.rows());
    inside_ = Eigen::MatrixXd::Zero(probes_ ? probes_->rows().rows() : 0, answers_.cols());
    for (std::size_t c = 0; probes_ && c < columns_.size(); ++c)
      inside_.middleCols<3>(3 * c) = probes_->rows().middleCols<3>(3 * columns_[c]);
  }

  const std::vector<int>& columns() const { return columns_; }
  const std::vector<unsigned char>& types() const { return types_; }
  const Eigen::MatrixXd& matrix() const { return answers_; }

  /// Null where the body has none.
  std::shared_ptr<const ProbeRows> probes() const {
    if (!probes_) return nullptr;
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(inside_.rows(), probes_->rows().cols());
    for (std::size_t c = 0; c < columns_.size(); ++c)
      rows.middleCols<3>(3 * columns_[c]) = inside_.middleCols<3>(3 * c);
    return withRows(*probes_, std::move(rows));
  }

  /// Lets fixed vertices move on their springs.
  void release() {
    const std::vector<int>& nodes = where_.released;
    if (nodes.empty()) return;
    const Eigen::MatrixXd moved = columnsOf(answers_, nodes),
                          movedInside = columnsOf(inside_, nodes);
    Eigen::MatrixXd stiffness = rowsOf(nodes, moved);
    scaleRows(nodes, stiffness);
    if (greens_.info().reciprocal) stiffness = ((stiffness + stiffness.transpose()) / 2).eval();
    addSprings(nodes, stiffness);
    Eigen::MatrixXd forces = rowsOf(nodes, answers_);  // that hold each vertex where it is
    scaleRows(nodes, forces);
    forces = -forces;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t c = 0; c < columns_.size(); ++c)
        if (columns_[c] == nodes[i]) {
          answers_.middleCols<3>(3 * c).setZero();  // from a displacement to a traction
          inside_.middleCols<3>(3 * c).setZero();
          forces.middleCols<3>(3 * c).setZero();
          forces.block<3, 3>(3 * i, 3 * c).diagonal().setConstant(greens_.vertexArea(nodes[i]));
        }
    const Eigen::MatrixXd displacement = solved(stiffness, forces);
    answers_.noalias() += moved * displacement;
    inside_.noalias() += movedInside * displacement;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      answers_.middleRows<3>(3 * nodes[i]) = displacement.middleRows<3>(3 * i);
  }

  /// Lets springs take their part of what acts on free vertices.
  void hold() {
    const std::vector<int>& nodes = where_.free;
    if (nodes.empty()) return;
    // What the springs cause.
    const Eigen::MatrixXd perSpring = stretched(nodes, columnsOf(answers_, nodes)),
                          insidePerSpring = stretched(nodes, columnsOf(inside_, nodes));
    const Eigen::Index count = perSpring.cols();
    const Eigen::MatrixXd loosened =
        Eigen::MatrixXd::Identity(count, count) + rowsOf(nodes, perSpring);
    if (!isLoose_) {
      const Eigen::MatrixXd stretches = solved(loosened, rowsOf(nodes, answers_));
      answers_.noalias() -= perSpring * stretches;
      inside_.noalias() -= insidePerSpring * stretches;
      return;
    }
    // With the rigid motion alpha: loosened u_s - R_s alpha = v_s, R_s^T S u_s = resultants.
    const Eigen::MatrixXd motions = rigidMotionsOfBodies(model_.mesh());
    const Eigen::Index six = motions.cols();
    Eigen::MatrixXd both = Eigen::MatrixXd::Zero(count + six, count + six);
    both.topLeftCorner(count, count) = loosened;
    both.topRightCorner(count, six) = -rowsOf(nodes, motions);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      both.block(count, 3 * i, six, 3) =
          motions.middleRows<3>(3 * nodes[i]).transpose() * blockOf(nodes[i]);
    Eigen::MatrixXd right(count + six, answers_.cols());
    right.topRows(count) = rowsOf(nodes, answers_);
    for (std::size_t c = 0; c < columns_.size(); ++c)
      right.block(count, 3 * c, six, 3) =
          greens_.vertexArea(columns_[c]) * motions.middleRows<3>(3 * columns_[c]).transpose();
    right.bottomRightCorner(six, ofWeight_.cols()) = ofWeight_.bottomRows(six);
    // Rows of the balance in the springs' own size, so that pivots compare.
    const double size = both.bottomLeftCorner(six, count).cwiseAbs().maxCoeff();
    both.bottomRows(six) /= size;
    right.bottomRows(six) /= size;
    const Eigen::MatrixXd found = solved(both, right);
    answers_ -= (perSpring * found.topRows(count)).eval();
    answers_.noalias() += motions * found.bottomRows(six);
    if (!probes_) return;
    inside_.noalias() -= insidePerSpring * found.topRows(count);
    inside_.noalias() +=
        rigidMotionsInside(model_.sharedMesh(), probes_->points()) * found.bottomRows(six);
  }

 private:
  Eigen::Matrix3d blockOf(int node) const { return springs_.middleCols<3>(3 * node); }

  Eigen::MatrixXd columnsOf(const Eigen::MatrixXd& all, const std::vector<int>& nodes) const {
    Eigen::MatrixXd result(all.rows(), 3 * nodes.size());
    std::size_t i = 0;  // both ascend
    for (std::size_t c = 0; c < columns_.size() && i < nodes.size(); ++c)
      if (columns_[c] == nodes[i]) result.middleCols<3>(3 * i++) = all.middleCols<3>(3 * c);
    return result;
  }

  /// From per traction to per stretch of these nodes' springs.
  Eigen::MatrixXd stretched(const std::vector<int>& nodes, Eigen::MatrixXd columns) const {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      columns.middleCols<3>(3 * i) =
          (columns.middleCols<3>(3 * i) * blockOf(nodes[i]) / greens_.vertexArea(nodes[i])).eval();
    return columns;
  }

  static Eigen::MatrixXd rowsOf(const std::vector<int>& nodes, const Eigen::MatrixXd& matrix) {
    Eigen::MatrixXd result(3 * nodes.size(), matrix.cols());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      result.middleRows<3>(3 * i) = matrix.middleRows<3>(3 * nodes[i]);
    return result;
  }

  void scaleRows(const std::vector<int>& nodes, Eigen::MatrixXd& rows) const {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      rows.middleRows<3>(3 * i) *= greens_.vertexArea(nodes[i]);
  }

  void addSprings(const std::vector<int>& nodes, Eigen::MatrixXd& stiffness) const {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      stiffness.block<3, 3>(3 * i, 3 * i) += blockOf(nodes[i]);
  }

  static Eigen::MatrixXd solved(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right) {
    const Eigen::PartialPivLU<Eigen::MatrixXd> factors(matrix);
    constexpr double leastReciprocalCondition = 1e-13;
    if (!(factors.rcond() > leastReciprocalCondition))
      throw std::invalid_argument(
          "these springs leave a motion of the body free, or are too soft beside it to be told "
          "from "
          "none: hold it in more directions, or stiffer");
    return factors.solve(right);
  }

  const GreensFunctions& greens_;
  const ElasticModel& model_;
  const Eigen::Matrix3Xd& springs_;
  const Springs& where_;
  std::shared_ptr<const ProbeRows> probes_;
  bool isLoose_;
  std::vector<unsigned char> types_;
  std::vector<int> columns_;
  Eigen::MatrixXd ofWeight_;
  Eigen::MatrixXd answers_, inside_;
};

}  // namespace

Eigen::Matrix3Xd foundationSprings(const SurfaceMesh& mesh, const std::vector<int>& vertices,
                                   double normal, double shear) {
  for (double stiffness : {normal, shear})
    if (!(stiffness >= 0 && std::isfinite(stiffness)))
      refuse("a foundation's stiffness must be a number of at least 0, not ", stiffness, " Pa/m");
  std::vector<bool> isHeld(mesh.vertexCount(), false);
  for (int v : vertices) isHeld[v] = true;
  const auto heldCorners = [&](int triangle) {
    int count = 0;
    for (int v : mesh.triangles().col(triangle)) count += isHeld[v];
    return count;
  };
  Eigen::Matrix3Xd springs = Eigen::Matrix3Xd::Zero(3, 3 * mesh.vertexCount());
  for (int v : vertices) {
    Eigen::Vector3d within = Eigen::Vector3d::Zero();  // area times normal of what is held
    double area = 0;
    for (int f : mesh.trianglesOfVertex(v))
      if (heldCorners(f) == 3) {
        within += mesh.triangleAreas()[f] / 3 * mesh.triangleNormals().col(f);
        area += mesh.triangleAreas()[f] / 3;
      }
    const bool isAlone = area == 0;
    const Eigen::Vector3d n =
        isAlone ? Eigen::Vector3d(mesh.vertexNormals().col(v)) : within.normalized();
    springs.middleCols<3>(3 * v) =
        (isAlone ? mesh.vertexAreas()[v] : area) *
        (shear * Eigen::Matrix3d::Identity() + (normal - shear) * n * n.transpose());
  }
  return springs;
}

FoundedGreensFunctions onElasticFoundation(const GreensFunctions& greens, const ElasticModel& model,
                                           const Eigen::Matrix3Xd& springs,
                                           std::shared_ptr<const ProbeRows> probes,
                                           const ProgressCallback& callback) {
  const Progress progress(callback);
  progress.report(0, "gather");
  Stopwatch watch;
  const Springs where(greens, springs);
  if (!probes) probes = greens.info().probes;
  Answers answers(greens, model, springs, where, std::move(probes));
  progress.report(0.2, "release");
  answers.release();
  progress.report(0.6, "hold");
  answers.hold();

  FoundedGreensFunctions result{
      ElasticModel(model.sharedMesh(), model.material(), BoundaryConditions(answers.types()),
                   model.smoothPatches(), Domain::Given),
      {}};
  GreensFunctionsInfo& info = result.greens.info;
  const GreensFunctionsInfo& before = greens.info();
  info = infoOf(result.model, answers.columns());
  info.homogeneous = false;
  info.rotationsHeld = before.rotationsHeld;
  info.reciprocal = before.reciprocal;
  info.density = before.density;
  info.source = sentence(before.source, ", on springs at ",
                         where.released.size() + where.free.size(), " vertices");
  info.diagnostics = before.diagnostics;
  info.diagnostics.error = {};
  info.diagnostics.seconds.clear();
  const Eigen::Index columns = 3 * answers.columns().size();
  result.greens.matrix = AlignedBuffer<double>(answers.matrix().rows() * columns);
  Eigen::Map<Eigen::MatrixXd>(result.greens.matrix.data(), answers.matrix().rows(), columns) =
      answers.matrix().leftCols(columns);
  if (answers.matrix().cols() > columns) info.weightResponse = answers.matrix().rightCols<3>();
  info.probes = answers.probes();
  info.diagnostics.reciprocityDefect =
      makeReciprocal(result.greens.matrix.data(), info.conditions, info.vertexAreas,
                     info.columnNodes, info.reciprocal);
  info.diagnostics.rockingCompliance = rockingCompliance(*result.greens.view(), model.mesh());
  addSeconds(info.diagnostics, "found", watch.seconds());
  progress.report(1, "done");
  return result;
}

}  // namespace palpate
