// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/capacitance_solver.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <sstream>
#include <stdexcept>

#include "greens/support_tractions.h"
#include "model/support.h"

namespace palpate {
namespace {

bool sameSwitch(const ConstraintSwitch& a, const ConstraintSwitch& b) {
  return a.node == b.node && a.direction == b.direction && a.yield == b.yield;
}

bool switchOrder(const ConstraintSwitch& a, const ConstraintSwitch& b) {
  if (a.node != b.node) return a.node < b.node;
  return std::lexicographical_compare(a.direction.data(), a.direction.data() + 3,
                                      b.direction.data(), b.direction.data() + 3);
}

std::vector<ConstraintSwitch> sorted(std::vector<ConstraintSwitch> switches) {
  std::sort(switches.begin(), switches.end(), switchOrder);
  return switches;
}

/// Takes the components along the node's switched directions out of a given value.
Eigen::Vector3d withoutSwitched(Eigen::Vector3d value,
                                const std::vector<ConstraintSwitch>& sortedSwitches, int node) {
  std::vector<Eigen::Vector3d> basis;
  auto s = std::lower_bound(sortedSwitches.begin(), sortedSwitches.end(), node,
                            [](const ConstraintSwitch& a, int n) { return a.node < n; });
  for (; s != sortedSwitches.end() && s->node == node; ++s) {
    Eigen::Vector3d direction = s->direction;
    for (const Eigen::Vector3d& b : basis) direction -= b.dot(direction) * b;
    if (direction.norm() > 1e-9) basis.push_back(direction.normalized());
  }
  if (basis.size() == 3) return Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& b : basis) value -= b.dot(value) * b;
  return value;
}

}  // namespace

BoundaryValues switchWholeNodes(const std::vector<int>& nodes, const Eigen::Matrix3Xd& values) {
  if (values.cols() != static_cast<Eigen::Index>(nodes.size()))
    throw std::invalid_argument("there are " + std::to_string(values.cols()) +
                                " prescribed vectors for " + std::to_string(nodes.size()) +
                                " nodes");
  BoundaryValues out;
  out.switches = switchesOfNodes(nodes);
  out.prescribed = values.reshaped();
  return out;
}

CapacitanceSolver::CapacitanceSolver(std::shared_ptr<const GreensFunctions> greens,
                                     std::shared_ptr<const SurfaceMesh> mesh, int cacheCount)
    : greens_(std::move(greens)), mesh_(std::move(mesh)), cacheCount_(std::max(1, cacheCount)) {
  if (greens_->nodeCount() != mesh_->vertexCount())
    throw std::invalid_argument("the Green's functions have " +
                                std::to_string(greens_->nodeCount()) + " nodes, the surface " +
                                std::to_string(mesh_->vertexCount()) + " vertices");
}

/// After releases, the displacement constraints that remain must still hold every body.
void CapacitanceSolver::requireSupported(const std::vector<ConstraintSwitch>& switches) const {
  const Domain domain = greens_->info().domain;
  if (domain == Domain::Exterior || domain == Domain::Given) return;
  const bool releases = std::any_of(switches.begin(), switches.end(),
                                    [&](const auto& s) { return greens_->isFixed(s.node); });
  if (!releases) return;
  for (int body = 0; body < mesh_->bodyCount(); ++body) {
    std::vector<Eigen::Vector3d> points, directions;
    Eigen::AlignedBox3d box;
    int first = -1;
    bool turns = true;
    for (int node = 0; node < mesh_->vertexCount(); ++node) {
      if (mesh_->bodyOfVertex(node) != body) continue;
      const Eigen::Vector3d x = mesh_->points().col(node);
      box.extend(x);
      if (first < 0) first = node;
      if (greens_->info().rotationsHeld && greens_->isFixed(node)) turns = false;
      // What is constrained: the axes that releases leave of a fixed node.
      for (int c = 0; c < 3 && greens_->isFixed(node); ++c) {
        const Eigen::Vector3d left = withoutSwitched(Eigen::Vector3d::Unit(c), switches, node);
        if (left.norm() < 1e-9) continue;
        points.push_back(x);
        directions.push_back(left.normalized());
      }
    }
    for (const ConstraintSwitch& s : switches)
      if (mesh_->bodyOfVertex(s.node) == body && (!greens_->isFixed(s.node) || s.yield > 0)) {
        points.push_back(mesh_->points().col(s.node));
        directions.push_back(s.direction);
      }
    Eigen::Matrix3Xd pointMatrix(3, points.size()), directionMatrix(3, points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      pointMatrix.col(i) = points[i];
      directionMatrix.col(i) = directions[i];
    }
    const Eigen::Matrix3Xd axes = Eigen::Matrix3d::Identity().leftCols(turns ? 0 : 3);
    const RigidMotion motion =
        leastResistedMotion(pointMatrix, directionMatrix, box.diagonal().norm(), axes);
    if (motion.resistance < kSmallestResistance)
      throw std::invalid_argument("releasing these nodes would leave a rigid motion free (" +
                                  motion.describe() + ") of the body of vertex " +
                                  std::to_string(first));
  }
}

std::shared_ptr<const CapacitanceMatrix> CapacitanceSolver::matrixFor(
    const std::vector<ConstraintSwitch>& wanted) {
  const std::vector<ConstraintSwitch> key = sorted(wanted);
  const auto matches = [&](const std::shared_ptr<const CapacitanceMatrix>& kept) {
    const std::vector<ConstraintSwitch> have = sorted(kept->switches());
    return have.size() == key.size() &&
           std::equal(have.begin(), have.end(), key.begin(), sameSwitch);
  };
  const auto known = std::find_if(cache_.begin(), cache_.end(), matches);
  if (known != cache_.end()) {
    cache_.splice(cache_.begin(), cache_, known);
    return cache_.front();
  }
  cache_.push_front(std::make_shared<CapacitanceMatrix>(greens_, key));
  while (static_cast<int>(cache_.size()) > cacheCount_) cache_.pop_back();
  return cache_.front();
}

/// Values checked, switched components of the given values taken out, unknown values solved for.
struct CapacitanceSolver::Problem {
  std::vector<ConstraintSwitch> switches;  // sorted
  std::shared_ptr<const CapacitanceMatrix> matrix;
  Eigen::VectorXd switchedValues;  // in the order of the matrix's switches
  std::vector<int> nodes;          // nodes with a non-zero given or switched value
  Eigen::Matrix3Xd weights;        // their values
};

CapacitanceSolver::Problem CapacitanceSolver::prepare(const BoundaryValues& values) {
  const int n = greens_->nodeCount();
  if (values.prescribed.size() != static_cast<Eigen::Index>(values.switches.size()))
    throw std::invalid_argument("there are " + std::to_string(values.prescribed.size()) +
                                " prescribed values for " + std::to_string(values.switches.size()) +
                                " switched constraints");
  if (values.given.size() > 0 && values.given.cols() != n)
    throw std::invalid_argument("there are " + std::to_string(values.given.cols()) +
                                " given values for " + std::to_string(n) + " nodes");
  requireSwitches(*greens_, values.switches);
  if (!values.prescribed.allFinite() || !values.given.allFinite())
    throw std::invalid_argument("a prescribed value is not a finite number");

  Problem problem;
  problem.switches = sorted(values.switches);
  requireSupported(problem.switches);
  problem.matrix = matrixFor(values.switches);

  // Background: what the given values cause at the switches.
  Eigen::Matrix3Xd effective = Eigen::Matrix3Xd::Zero(3, n);
  for (Eigen::Index node = 0; node < values.given.cols(); ++node)
    if (!values.given.col(node).isZero(0))
      effective.col(node) =
          withoutSwitched(values.given.col(node), problem.switches, static_cast<int>(node));
  std::vector<int> loaded;
  for (int node = 0; node < n; ++node)
    if (!effective.col(node).isZero(0)) loaded.push_back(node);
  greens_->requireColumns(nodeList(loaded));
  const auto& order = problem.matrix->switches();
  std::vector<int> rows;
  for (const ConstraintSwitch& s : order) rows.push_back(s.node);
  Eigen::VectorXd background = Eigen::VectorXd::Zero(3 * rows.size());
  const Eigen::Matrix3Xd loads = effective(Eigen::all, loaded);
  greens_->accumulate(nodeList(loaded), loads.reshaped(), nodeList(rows), background);

  Eigen::VectorXd right(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto input = std::find_if(values.switches.begin(), values.switches.end(),
                                    [&](const auto& s) { return sameSwitch(s, order[k]); });
    right[k] = values.prescribed[input - values.switches.begin()] -
               order[k].direction.dot(background.segment<3>(3 * k));
  }
  problem.switchedValues.resize(order.size());
  problem.matrix->solve(right.data(), problem.switchedValues.data());
  for (std::size_t k = 0; k < order.size(); ++k)
    effective.col(order[k].node) += problem.switchedValues[k] * order[k].direction;
  for (int node = 0; node < n; ++node)
    if (!effective.col(node).isZero(0)) problem.nodes.push_back(node);
  problem.weights = effective(Eigen::all, problem.nodes);
  return problem;
}

BoundarySolution CapacitanceSolver::solve(const BoundaryValues& values) {
  const Problem problem = prepare(values);
  const int n = greens_->nodeCount();
  BoundarySolution solution;
  solution.displacement = solution.traction = Eigen::Matrix3Xd::Zero(3, n);
  solution.condition = problem.matrix->condition();
  Eigen::VectorXd response = Eigen::VectorXd::Zero(3 * n);
  greens_->accumulate(nodeList(problem.nodes), problem.weights.reshaped(), response);
  for (int node = 0; node < n; ++node) {
    Eigen::Matrix3Xd& unknown = greens_->isFixed(node) ? solution.traction : solution.displacement;
    unknown.col(node) = response.segment<3>(3 * node);
  }
  for (std::size_t i = 0; i < problem.nodes.size(); ++i) {
    const int node = problem.nodes[i];
    Eigen::Matrix3Xd& given = greens_->isFixed(node) ? solution.displacement : solution.traction;
    given.col(node) = problem.weights.col(i);
  }
  solution.switchedValues.resize(values.switches.size());
  const auto& order = problem.matrix->switches();
  for (std::size_t k = 0; k < values.switches.size(); ++k) {
    const auto at = std::find_if(order.begin(), order.end(),
                                 [&](const auto& s) { return sameSwitch(s, values.switches[k]); });
    solution.switchedValues[k] = problem.switchedValues[at - order.begin()];
  }
  return solution;
}

Eigen::Matrix3Xd CapacitanceSolver::solveAt(const BoundaryValues& values,
                                            const std::vector<int>& rows) {
  for (int row : rows)
    if (row < 0 || row >= greens_->nodeCount())
      throw std::invalid_argument("there is no node " + std::to_string(row) + " to evaluate");
  const Problem problem = prepare(values);
  Eigen::VectorXd response = Eigen::VectorXd::Zero(3 * rows.size());
  greens_->accumulate(nodeList(problem.nodes), problem.weights.reshaped(), nodeList(rows),
                      response);
  return response.reshaped(3, rows.size());
}

Wrench wrenchOf(const GreensFunctions& greens, const Eigen::Matrix3Xd& points,
                const std::vector<int>& nodes, const Eigen::Matrix3Xd& traction,
                const Eigen::Vector3d& centre) {
  Wrench wrench = kNoWrench;
  for (int node : nodes) {
    const Eigen::Vector3d force = greens.vertexArea(node) * traction.col(node);
    wrench.force += force;
    wrench.torque += (points.col(node) - centre).cross(force);
  }
  return wrench;
}

Eigen::Matrix3Xd forcePoints(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                             const Eigen::VectorXi& smoothPatches) {
  const Eigen::Matrix3Xd shares = supportShares(mesh, conditions, smoothPatches);
  Eigen::Matrix3Xd points = mesh.points();
  for (int v : conditions.fixedNodes()) {
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    double area = 0;
    for (int f : mesh.trianglesOfVertex(v)) {
      const Eigen::Vector3i corners = mesh.triangles().col(f);
      const double part =
          mesh.triangleAreas()[f] *
          (corners.array() == v).select(shares.col(f), Eigen::Vector3d::Zero()).sum();
      // The hat function's integral of x: a quarter from each corner, and another from the vertex.
      moment +=
          part / 4 * (mesh.points()(Eigen::all, corners).rowwise().sum() + mesh.points().col(v));
      area += part;
    }
    points.col(v) = moment / area;
  }
  return points;
}

}  // namespace palpate
