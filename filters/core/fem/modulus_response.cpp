// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fem/modulus_response.h"

#include <Eigen/SparseCore>
#include <numeric>
#include <utility>

#include "fem/hat_products.h"
#include "fem/solid_system.h"
#include "sentence.h"

namespace palpate {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// The equations of a body, factored, and how forces at free vertices enter them and displacements
/// leave them: both by R (see computeFiniteElementGreensFunctions).
class FactoredBody {
 public:
  FactoredBody(fem::SolidSystem system, const SurfaceMesh& mesh, std::vector<int> free)
      : system_(std::move(system)),
        free_(std::move(free)),
        unknowns_(system_.unknownCount()),
        products_(amongFree(mesh.vertexCount())),
        inverseAreas_(system_.length * system_.length * mesh.vertexAreas()(free_).cwiseInverse()),
        parts_(system_.entries, unknowns_),
        hats_(parts_.coupling.middleRows(0, 3 * free_.size())),
        factored_(std::move(parts_.own), 0, system_.pressureCount == 0) {
    fem::requireHeld(factored_, system_.pressureCount);
  }

  const fem::SolidSystem& system() const { return system_; }
  int unknownCount() const { return unknowns_; }

  void solve(Eigen::Ref<Eigen::MatrixXd> columns) const { factored_.solve(columns); }

  /// Right-hand sides of forces.
  /// @param forces  3 #V by any, N.
  Eigen::MatrixXd loads(const Eigen::MatrixXd& forces) const {
    Eigen::MatrixXd own(3 * free_.size(), forces.cols());
    for (std::size_t i = 0; i < free_.size(); ++i)
      own.middleRows<3>(3 * i) = forces.middleRows<3>(3 * free_[i]);
    return hats_.transpose() *
           averaged(own / (system_.stiffness * system_.length * system_.length));
  }

  /// @return 3 #V by any, m.
  Eigen::MatrixXd displacements(const Eigen::MatrixXd& solution, int vertices) const {
    const Eigen::MatrixXd own = system_.length * averaged(hats_ * solution);
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * vertices, solution.cols());
    for (std::size_t i = 0; i < free_.size(); ++i)
      all.middleRows<3>(3 * free_[i]) = own.middleRows<3>(3 * i);
    return all;
  }

 private:
  Sparse amongFree(int vertices) const {
    std::vector<int> number(vertices, -1);
    for (std::size_t i = 0; i < free_.size(); ++i) number[free_[i]] = static_cast<int>(i);
    return fem::productsBetween(system_.hatProducts, number, free_.size(), number, free_.size());
  }

  /// R B, component by component.
  Eigen::MatrixXd averaged(const Eigen::MatrixXd& rows) const {
    Eigen::MatrixXd result(rows.rows(), rows.cols());
    for (int k = 0; k < 3; ++k) {
      const Eigen::MatrixXd one = rows(Eigen::seqN(k, free_.size(), 3), Eigen::all);
      result(Eigen::seqN(k, free_.size(), 3), Eigen::all) =
          (products_.solve(one) + inverseAreas_.asDiagonal() * one) / 2;
    }
    return result;
  }

  fem::SolidSystem system_;
  std::vector<int> free_;
  int unknowns_;
  fem::HatProducts products_;
  Eigen::VectorXd inverseAreas_;
  fem::SplitEntries parts_;
  Sparse hats_;  // 3 #free by #unknowns
  SparseFactorization factored_;
};

/// What a relative change of each cell's modulus takes from the equations of given solutions:
/// dK_c u, a matrix of #unknowns by #T for every solution.
class CellForces {
 public:
  CellForces(const FactoredBody& factored, const SolidBody& body, Eigen::Index solutions)
      : system_(factored.system()),
        body_(body),
        rows_(factored.unknownCount()),
        entries_(solutions) {}

  void add(const fem::SolidNodes& nodes, int cell, const Eigen::MatrixXd& solutions) {
    const Elasticity& material = body_.material(cell);
    const Eigen::Matrix<double, 3, 4> corners =
        body_.mesh().points()(Eigen::all, body_.mesh().tetrahedra().col(cell)) / system_.length;
    fem::integrateElement(corners, SolidElement::Quadratic,
                          material.stiffness() / system_.stiffness, material.isSplit(), matrices_);
    const int count = 3 * nodes.perCell();
    Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(count, solutions.cols());
    for (int i = 0; i < count; ++i)
      forPlaces(nodes, cell, i,
                [&](int place, double weight) { moved.row(i) += weight * solutions.row(place); });
    const Eigen::MatrixXd forces = matrices_.stiffness * moved;
    for (int i = 0; i < count; ++i)
      forPlaces(nodes, cell, i,
                [&](int place, double weight) { put(place, cell, weight * forces.row(i)); });
    if (!material.isSplit()) return;
    // Pressures resist the more, the stiffer: -M / lambda falls as 1 / E.
    int places[4];
    Eigen::MatrixXd pressures(4, solutions.cols());
    for (int v = 0; v < 4; ++v) {
      places[v] = system_.pressurePlace(body_, cell, v);
      pressures.row(v) = solutions.row(places[v]);
    }
    const Eigen::MatrixXd changes =
        material.compressibility() * system_.stiffness * matrices_.mass * pressures;
    for (int v = 0; v < 4; ++v) put(places[v], cell, changes.row(v));
  }

  Sparse of(Eigen::Index solution) const {
    Sparse forces(rows_, body_.mesh().cellCount());
    forces.setFromTriplets(entries_[solution].begin(), entries_[solution].end());
    return forces;
  }

 private:
  template <class Act>
  void forPlaces(const fem::SolidNodes& nodes, int cell, int component, const Act& act) const {
    const auto& at = system_.placeOf(nodes.cells(component / 3, cell), component % 3);
    for (int end = 0; end < at.count(); ++end)
      if (at.place[end] < rows_) act(at.place[end], at.weight);
  }

  void put(int place, int cell, const Eigen::RowVectorXd& values) {
    for (Eigen::Index s = 0; s < values.size(); ++s)
      entries_[s].emplace_back(place, cell, values[s]);
  }

  const fem::SolidSystem& system_;
  const SolidBody& body_;
  int rows_;
  fem::ElementMatrices matrices_;
  std::vector<std::vector<Eigen::Triplet<double>>> entries_;
};

}  // namespace

ModulusResponse::ModulusResponse(const ElasticModel& model, TetrahedralMesh mesh,
                                 Eigen::MatrixXd modes, Eigen::MatrixXd forces)
    : model_(model), mesh_(std::move(mesh)), modes_(std::move(modes)), forces_(std::move(forces)) {
  if (modes_.rows() != mesh_.cellCount())
    refuse("modes have ", modes_.rows(), " rows for ", mesh_.cellCount(), " tetrahedra");
  if (forces_.rows() != 3 * model.mesh().vertexCount())
    refuse("forces have ", forces_.rows(), " rows for ", model.mesh().vertexCount(), " vertices");
  if (model.domain() != Domain::Interior || model.conditions().fixedNodes().empty())
    refuse("a body whose stiffness varies must be held at some of its vertices");
}

SolidBody ModulusResponse::body(const Eigen::VectorXd& modulus, double poissonRatio) const {
  std::vector<Elasticity> materials;
  materials.reserve(modulus.size());
  for (double young : modulus) materials.emplace_back(Material(young, poissonRatio));
  std::vector<int> number(modulus.size());
  std::iota(number.begin(), number.end(), 0);
  return SolidBody(model_.mesh(), mesh_, std::move(materials), std::move(number));
}

ModulusResponse::Answer ModulusResponse::at(const Eigen::VectorXd& modulus, double poissonRatio,
                                            bool derivatives, const Progress& progress) const {
  const SolidBody body = this->body(modulus, poissonRatio);
  const std::vector<int> free = model_.conditions().freeNodes();
  std::vector<fem::LoadHat> hats;
  for (int v : free) hats.push_back({v, -1});
  const int vertices = model_.mesh().vertexCount();
  const FactoredBody factored(fem::SolidSystem(model_, body, SolidElement::Quadratic,
                                               std::move(hats), {}, {}, progress.part(0, 0.2)),
                              model_.mesh(), free);
  progress.report(0.4, "solve");
  Eigen::MatrixXd solutions = factored.loads(forces_);
  factored.solve(solutions);
  Answer answer{factored.displacements(solutions, vertices), {}};
  if (!derivatives) return answer;
  const fem::SolidNodes nodes(mesh_, SolidElement::Quadratic);
  CellForces forces(factored, body, solutions.cols());
  for (int cell = 0; cell < mesh_.cellCount(); ++cell) forces.add(nodes, cell, solutions);
  for (Eigen::Index load = 0; load < solutions.cols(); ++load) {
    progress.report(0.5 + 0.5 * double(load) / solutions.cols(), "differentiate");
    Eigen::MatrixXd changes = forces.of(load) * modes_;
    factored.solve(changes);
    answer.byModes.push_back(-factored.displacements(changes, vertices));
  }
  return answer;
}

}  // namespace palpate
