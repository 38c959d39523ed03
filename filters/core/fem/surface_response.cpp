// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fem/surface_response.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <memory>
#include <utility>

#include "fem/hat_products.h"
#include "greens/rigid_motions.h"
#include "model/support.h"
#include "sentence.h"

namespace palpate::fem {
namespace {

/// One column costs about as much as this part of a whole Schur complement's share of it.
constexpr int kColumnsWorthSchur = 8;
constexpr int kColumnsAtOnce = 96;

using Sparse = Eigen::SparseMatrix<double>;

/// Every third row of a matrix from a first one on, as a matrix.
auto component(const Eigen::MatrixXd& matrix, int k) {
  return Eigen::Map<const Eigen::MatrixXd, 0, Eigen::Stride<Eigen::Dynamic, 3>>(
      matrix.data() + k, matrix.rows() / 3, matrix.cols(),
      Eigen::Stride<Eigen::Dynamic, 3>(matrix.rows(), 3));
}
auto component(Eigen::MatrixXd& matrix, int k) {
  return Eigen::Map<Eigen::MatrixXd, 0, Eigen::Stride<Eigen::Dynamic, 3>>(
      matrix.data() + k, matrix.rows() / 3, matrix.cols(),
      Eigen::Stride<Eigen::Dynamic, 3>(matrix.rows(), 3));
}

class Condensation {
 public:
  Condensation(SolidSystem system, const ElasticModel& model, const MortarShares& shares)
      : system_(std::move(system)),
        shares_(shares),
        mesh_(model.mesh()),
        freeNumber_(mesh_.vertexCount(), -1),
        fixedNumber_(mesh_.vertexCount(), -1),
        free_(model.conditions().freeNodes()),
        hatRows_(3 * static_cast<int>(system_.hats.size())) {
    for (std::size_t i = 0; i < free_.size(); ++i) freeNumber_[free_[i]] = static_cast<int>(i);
    for (std::size_t i = 0; i < system_.fixedVertices.size(); ++i)
      fixedNumber_[system_.fixedVertices[i]] = static_cast<int>(i);
    findProducts();
  }

  SurfaceResponse run(const std::vector<WantedColumn>& wanted, const Progress& progress) {
    const int columns = 3 * static_cast<int>(wanted.size());
    SurfaceResponse response;
    const Eigen::MatrixXd given = movedRigidly();
    const Eigen::Index motions = given.cols();
    Eigen::MatrixXd answer;
    progress.report(0, "factor");
    if (kColumnsWorthSchur * columns < system_.keptCount()) {
      Eigen::MatrixXd all(system_.keptCount(), columns + motions);
      all << whatIsGiven(wanted), given;
      answer = solved(all, response.peakBytes, progress);
    } else {
      const SparseFactorization factored(std::move(system_.entries), system_.keptCount(),
                                         system_.pressureCount == 0);
      requireHeld(factored, system_.pressureCount);
      response.peakBytes =
          factored.peakBytes() + 2 * sizeof(double) * factored.schurComplement().size();
      progress.report(0.9, "condense");
      answer.resize(system_.keptCount(), columns + motions);
      answer.leftCols(columns) = appliedTo(factored.schurComplement(), wanted);
      answer.rightCols(motions).noalias() = factored.schurComplement() * given;
    }
    if (motions > 0) {
      response.rigidMotionDefect = defectOf(answer.rightCols(motions));
      requireRigidMotions(response.rigidMotionDefect);
    }
    answer.conservativeResize(Eigen::NoChange, columns);
    response.columns = atVertices(answer, wanted);
    response.probes = -answer.bottomRows(13 * system_.probeCount);
    if (isHeld()) return response;
    response.displacedMotions = shownMotions(shares_.displacement);
    response.loadedMotions = shownMotions(shares_.load);
    // Springs that a rigid motion R stretches bear L = K R, and R^T F = L^T K^-1 F of any load F.
    response.weightResultants =
        -answer.rightCols<3>().middleRows(system_.loadRow(), system_.rigidLoadCount());
    return response;
  }

 private:
  void findProducts() {
    const Eigen::Index free = free_.size(), fixed = system_.fixedVertices.size();
    const Sparse products =
        productsBetween(system_.hatProducts, freeNumber_, free, freeNumber_, free);
    toFixed_ = productsBetween(system_.hatProducts, freeNumber_, free, fixedNumber_, fixed);
    for (int k = 0; k < (system_.held.cols() > 0 ? 3 : 1); ++k) {
      const auto isHeld = [&](Eigen::Index i) { return system_.isHeldAlong(k, free_[i]); };
      Sparse own = products, across = toFixed_;
      own.prune([&](Eigen::Index row, Eigen::Index column, double) {
        return row == column || (!isHeld(row) && !isHeld(column));
      });
      across.prune([&](Eigen::Index row, Eigen::Index, double) { return !isHeld(row); });
      products_.push_back(std::make_unique<HatProducts>(own));
      shared_.push_back(products_.back()->solve(Eigen::MatrixXd(across)));
    }
    inverseAreas_.resize(free_.size());
    for (std::size_t i = 0; i < free_.size(); ++i)
      inverseAreas_[i] = system_.length * system_.length / mesh_.vertexAreas()[free_[i]];
  }

  /// M along an axis, and M^-1 toFixed_.
  const HatProducts& products(int axis) const {
    return *products_[products_.size() > 1 ? axis : 0];
  }
  const Eigen::MatrixXd& shared(int axis) const { return shared_[shared_.size() > 1 ? axis : 0]; }

  /// By fixed vertices, and not by springs.
  bool isHeld() const { return !system_.fixedVertices.empty(); }

  /// 3 #vertices by 6, about the middle of the mesh.
  Eigen::MatrixXd motionsOf(const std::vector<int>& vertices) const {
    const Eigen::Matrix3Xd& points = mesh_.points();
    return rigidMotions(points(Eigen::all, vertices), points.rowwise().mean(), system_.length);
  }

  /// What is given, (-t, w, loads), where the body is moved rigidly by what holds it.
  Eigen::MatrixXd movedRigidly() const {
    // Where single components are held, a rigid motion of the support is none of the body.
    const bool isFollowed = system_.held.cols() == 0;
    const Eigen::Index motions = !isFollowed ? 0 : isHeld() ? 6 : system_.rigidLoadCount();
    Eigen::MatrixXd given = Eigen::MatrixXd::Zero(system_.keptCount(), motions);
    if (motions > 0 && isHeld())
      given.middleRows(hatRows_, 3 * system_.fixedVertices.size()) =
          motionsOf(system_.fixedVertices);
    else if (motions > 0)
      given.middleRows(system_.loadRow(), motions).setIdentity();
    return given;
  }

  /// R of rigid motions of bodies that nothing holds.
  Eigen::MatrixXd shownMotions(double share) const {
    Eigen::MatrixXd motions = rigidMotionsOfBodies(mesh_);
    for (int k = 0; k < 3; ++k)
      component(motions, k) = weighted(share, k, system_.hatProducts * component(motions, k));
    return motions;
  }

  /// kept by 3 #wanted: (-t, w, loads) of each column.
  Eigen::MatrixXd whatIsGiven(const std::vector<WantedColumn>& wanted) const {
    Eigen::MatrixXd given = Eigen::MatrixXd::Zero(system_.keptCount(), 3 * wanted.size());
    for (std::size_t c = 0; c < wanted.size(); ++c) {
      const auto set = [&](int row, double value) {
        for (int k = 0; k < 3; ++k) given(row + k, 3 * c + k) = value;
      };
      if (wanted[c].kind == WantedColumn::Traction) {
        set(3 * wanted[c].index, -1);
      } else if (wanted[c].kind == WantedColumn::Load) {
        set(system_.weightRow(), 1);
      } else if (wanted[c].kind == WantedColumn::Displacement) {
        set(hatRows_ + 3 * fixedNumber_[wanted[c].index], 1);
      } else {
        for (int k = 0; k < 3; ++k) {
          const Eigen::VectorXd traction = spreadForce(wanted[c].index, k);
          for (std::size_t h = 0; h < system_.hats.size(); ++h)
            given(3 * h + k, 3 * c + k) = -traction[freeNumber_[system_.hats[h].vertex]];
        }
      }
    }
    return given;
  }

  /// R (see computeFiniteElementGreensFunctions) with this share of M^-1, times #free rows.
  Eigen::MatrixXd weighted(double share, int axis, const Eigen::MatrixXd& rows) const {
    Eigen::MatrixXd result = (1 - share) * (inverseAreas_.asDiagonal() * rows);
    if (share > 0) result += share * products(axis).solve(rows);
    return result;
  }

  /// The traction at free vertices that a unit force of one is spread to.
  Eigen::VectorXd spreadForce(int vertex, int axis) const {
    return weighted(shares_.load, axis, Eigen::VectorXd::Unit(free_.size(), freeNumber_[vertex]));
  }

  /// The Schur complement times whatIsGiven, without forming the latter.
  Eigen::MatrixXd appliedTo(const Eigen::MatrixXd& schur,
                            const std::vector<WantedColumn>& wanted) const {
    Eigen::MatrixXd answer(schur.rows(), 3 * wanted.size());
    const bool anyForce = std::any_of(wanted.begin(), wanted.end(), [](const WantedColumn& w) {
      return w.kind == WantedColumn::Force;
    });
    for (int k = 0; k < 3; ++k) {
      Eigen::MatrixXd ofForces;
      if (anyForce) {
        ofForces.setZero(free_.size(), schur.rows());
        for (std::size_t h = 0; h < system_.hats.size(); ++h)
          ofForces.row(freeNumber_[system_.hats[h].vertex]) += schur.row(3 * h + k);
        ofForces = weighted(shares_.load, k, ofForces);
      }
      for (std::size_t c = 0; c < wanted.size(); ++c) {
        const int index = wanted[c].index;
        if (wanted[c].kind == WantedColumn::Force)
          answer.col(3 * c + k) = -ofForces.row(freeNumber_[index]).transpose();
        else if (wanted[c].kind == WantedColumn::Traction)
          answer.col(3 * c + k) = -schur.col(3 * index + k);
        else if (wanted[c].kind == WantedColumn::Load)
          answer.col(3 * c + k) = schur.col(system_.weightRow() + k);
        else
          answer.col(3 * c + k) = schur.col(hatRows_ + 3 * fixedNumber_[index] + k);
      }
    }
    return answer;
  }

  /// The same, column by column, by solving with the unknowns' own matrix.
  Eigen::MatrixXd solved(const Eigen::MatrixXd& given, std::size_t& peakBytes,
                         const Progress& progress) {
    const int unknowns = system_.unknownCount();
    SplitEntries parts(system_.entries, unknowns);
    system_.entries = {};
    const SparseFactorization factored(std::move(parts.own), 0, system_.pressureCount == 0);
    requireHeld(factored, system_.pressureCount);
    peakBytes = factored.peakBytes() + sizeof(double) * std::size_t(unknowns) * kColumnsAtOnce;
    Eigen::MatrixXd answer = parts.corner.selfadjointView<Eigen::Lower>() * given;
    for (Eigen::Index first = 0; first < given.cols(); first += kColumnsAtOnce) {
      const Eigen::Index count = std::min<Eigen::Index>(kColumnsAtOnce, given.cols() - first);
      Eigen::MatrixXd columns = parts.coupling.transpose() * given.middleCols(first, count);
      factored.solve(columns);
      answer.middleCols(first, count).noalias() -= parts.coupling * columns;
      progress.report(0.5 + 0.5 * double(first + count) / given.cols(), "solve");
    }
    return answer;
  }

  /// Of null pivots beside kept rows the library does not tell: they spoil what it gives.
  static void requireRigidMotions(double defect) {
    constexpr double mostRounding = 1e-4;  // of what is solved to ten digits and more
    if (!(defect <= mostRounding))
      throw std::runtime_error(
          sentence("the sparse system is singular to rounding: where its support moves, the body "
                   "follows with a relative error of ",
                   defect, "; a part of it is not held, or materials differ by too much"));
  }

  /// 3 #free by any: displacement times hat of each free vertex, integrated.
  Eigen::MatrixXd meansUnderHats(const Eigen::Ref<const Eigen::MatrixXd>& answer) const {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * free_.size(), answer.cols());
    for (std::size_t h = 0; h < system_.hats.size(); ++h)
      result.middleRows<3>(3 * freeNumber_[system_.hats[h].vertex]) += answer.middleRows<3>(3 * h);
    return result;
  }

  /// 3 #free by any: displacements of free vertices while fixed ones rest.
  Eigen::MatrixXd displacements(const Eigen::Ref<const Eigen::MatrixXd>& answer) const {
    Eigen::MatrixXd result = meansUnderHats(answer);
    for (int k = 0; k < 3; ++k)
      component(result, k) = weighted(shares_.displacement, k, component(result, k));
    return result;
  }

  /// By the displacements nearest in the mean square, in which rigid motions are exact.
  double defectOf(const Eigen::Ref<const Eigen::MatrixXd>& answer) const {
    const Eigen::MatrixXd expected = isHeld() ? motionsOf(free_) : rigidMotionsOfBodies(mesh_);
    const Eigen::MatrixXd held = motionsOf(system_.fixedVertices);
    const Eigen::MatrixXd means = meansUnderHats(answer);
    double largest = 0;
    for (int k = 0; k < 3; ++k) {
      Eigen::MatrixXd shown = component(means, k);
      if (isHeld()) shown -= toFixed_ * component(held, k);
      const Eigen::MatrixXd found = products(k).solve(shown);
      largest = std::max(largest, (found - component(expected, k)).cwiseAbs().maxCoeff());
    }
    return largest / expected.cwiseAbs().maxCoeff();
  }

  Eigen::MatrixXd atVertices(const Eigen::MatrixXd& answer,
                             const std::vector<WantedColumn>& wanted) const {
    Eigen::MatrixXd columns(3 * mesh_.vertexCount(), answer.cols());
    const Eigen::MatrixXd free = displacements(answer);
    for (std::size_t i = 0; i < free_.size(); ++i)
      columns.middleRows<3>(3 * free_[i]) = free.middleRows<3>(3 * i);
    for (std::size_t i = 0; i < system_.fixedVertices.size(); ++i)
      columns.middleRows<3>(3 * system_.fixedVertices[i]) = answer.middleRows<3>(hatRows_ + 3 * i);
    for (std::size_t c = 0; c < wanted.size(); ++c) shareWithSupport(wanted[c], 3 * c, columns);
    return columns;
  }

  /// The hats of free vertices reach onto the support: where a vertex's displacement is the one
  /// nearest in the mean square, that of the support is taken off, and by Betti's theorem what a
  /// force puts on the support itself is none of its reaction.
  void shareWithSupport(const WantedColumn& wanted, int column, Eigen::MatrixXd& columns) const {
    if (wanted.kind == WantedColumn::Force) {
      for (std::size_t i = 0; i < system_.fixedVertices.size(); ++i)
        for (int k = 0; k < 3; ++k)
          columns(3 * system_.fixedVertices[i] + k, column + k) +=
              shares_.load * shared(k)(freeNumber_[wanted.index], i);
    } else if (wanted.kind == WantedColumn::Displacement) {
      for (std::size_t i = 0; i < free_.size(); ++i)
        for (int k = 0; k < 3; ++k)
          columns(3 * free_[i] + k, column + k) -=
              shares_.displacement * shared(k)(i, fixedNumber_[wanted.index]);
    }
  }

  SolidSystem system_;
  MortarShares shares_;
  const SurfaceMesh& mesh_;
  std::vector<int> freeNumber_, fixedNumber_, free_;
  int hatRows_;
  // One for all axes, or where components are held one an axis: held hats are then none of M's.
  std::vector<std::unique_ptr<HatProducts>> products_;
  Eigen::VectorXd inverseAreas_;
  Sparse toFixed_;  // products of free vertices' hats with fixed ones'
  std::vector<Eigen::MatrixXd> shared_;
};

}  // namespace

SurfaceResponse surfaceResponse(SolidSystem system, const ElasticModel& model,
                                const std::vector<WantedColumn>& wanted, const MortarShares& shares,
                                const Progress& progress) {
  return Condensation(std::move(system), model, shares).run(wanted, progress);
}

}  // namespace palpate::fem
