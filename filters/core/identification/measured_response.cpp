// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/measured_response.h"

#include <cmath>
#include <Eigen/Eigenvalues>

namespace palpate {
namespace {

/// Solves (c H + 1) x = b in place for a matrix H of Hessenberg's form, by elimination with
/// exchanges of neighbouring rows.
void solveShifted(const Eigen::MatrixXd& hessenberg, double c, Eigen::MatrixXd& b) {
  const Eigen::Index n = hessenberg.rows();
  Eigen::MatrixXd a = c * hessenberg;
  a.diagonal().array() += 1;
  for (Eigen::Index k = 0; k + 1 < n; ++k) {
    if (std::abs(a(k + 1, k)) > std::abs(a(k, k))) {
      a.row(k).tail(n - k).swap(a.row(k + 1).tail(n - k));
      b.row(k).swap(b.row(k + 1));
    }
    if (a(k, k) == 0) continue;
    const double factor = a(k + 1, k) / a(k, k);
    a.row(k + 1).tail(n - k) -= factor * a.row(k).tail(n - k);
    b.row(k + 1) -= factor * b.row(k);
  }
  a.triangularView<Eigen::Upper>().solveInPlace(b);
}

}  // namespace

MeasuredSetup measuredSetup(const SurfaceMesh& mesh, const Measurements& measurements,
                            const MeasuredPlaces& places, std::vector<SpreadForce> loads) {
  MeasuredSetup setup;
  setup.loads = std::move(loads);
  setup.places.resize(3, places.markers.size());
  for (std::size_t i = 0; i < measurements.displacements.size(); ++i) {
    const SurfacePoint& point = places.markers[i];
    setup.probeOf.push_back(measurements.displacements[i].probe);
    setup.nodes.push_back(mesh.triangles().col(point.triangle));
    setup.weights.push_back(point.barycentric);
    setup.places.col(i) = placeOf(mesh, point);
  }
  return setup;
}

Eigen::MatrixXd nodalForces(const MeasuredSetup& setup, const Measurements& measurements,
                            const Eigen::VectorXd& areas) {
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(3 * areas.size(), setup.probeCount());
  for (int p = 0; p < setup.probeCount(); ++p)
    for (std::size_t i = 0; i < setup.loads[p].nodes.size(); ++i) {
      const int node = setup.loads[p].nodes[i];
      forces.col(p).segment<3>(3 * node) +=
          setup.loads[p].density[i] * areas[node] * measurements.probes[p].force;
    }
  return forces;
}

Eigen::VectorXd seenAtMarkers(const MeasuredSetup& setup, const Eigen::MatrixXd& displacements) {
  Eigen::VectorXd seen = Eigen::VectorXd::Zero(3 * setup.markerCount());
  for (int i = 0; i < setup.markerCount(); ++i)
    for (int k = 0; k < 3; ++k)
      seen.segment<3>(3 * i) +=
          setup.weights[i][k] *
          displacements.col(setup.probeOf[i]).segment<3>(3 * setup.nodes[i][k]);
  return seen;
}

MeasuredResponse::MeasuredResponse(const GreensFunctions& greens, const MeasuredSetup& setup,
                                   bool yieldingSupport)
    : modulus_(greens.info().material.youngsModulus()), probeOf_(setup.probeOf) {
  std::vector<Eigen::MatrixXd> fields;
  for (const SpreadForce& load : setup.loads) fields.push_back(responseTo(greens, load));
  rows_.setZero(3 * setup.markerCount(), 3);
  for (int i = 0; i < setup.markerCount(); ++i)
    for (int k = 0; k < 3; ++k)
      if (const int node = setup.nodes[i][k]; !greens.isFixed(node))
        rows_.middleRows<3>(3 * i) +=
            setup.weights[i][k] * fields[setup.probeOf[i]].middleRows<3>(3 * node);
  if (yieldingSupport) prepareFoundation(greens, setup, fields);
}

void MeasuredResponse::prepareFoundation(const GreensFunctions& greens, const MeasuredSetup& setup,
                                         const std::vector<Eigen::MatrixXd>& fields) {
  const std::vector<int> fixed = greens.info().conditions.fixedNodes();
  const Eigen::Index size = 3 * fixed.size();
  if (size == 0) return;
  greens.requireColumns(nodeList(fixed));
  Eigen::MatrixXd stiffness(size, size);
  greens.gather(nodeList(fixed), nodeList(fixed), stiffness.data());
  loading_.resize(size, 3 * setup.probeCount());
  for (int p = 0; p < setup.probeCount(); ++p)
    for (std::size_t j = 0; j < fixed.size(); ++j)
      loading_.block<3, 3>(3 * j, 3 * p) = fields[p].middleRows<3>(3 * fixed[j]) / modulus_;
  readOut_.setZero(3 * setup.markerCount(), size);
  Eigen::MatrixXd blocks(3, size);
  for (int i = 0; i < setup.markerCount(); ++i)
    for (int k = 0; k < 3; ++k) {
      const int node = setup.nodes[i][k];
      const double weight = setup.weights[i][k];
      if (weight == 0) continue;
      if (greens.isFixed(node)) {
        for (std::size_t j = 0; j < fixed.size(); ++j)
          if (fixed[j] == node)
            readOut_.block<3, 3>(3 * i, 3 * j) += weight * Eigen::Matrix3d::Identity();
        continue;
      }
      greens.gather(nodeList({node}), nodeList(fixed), blocks.data());
      readOut_.middleRows<3>(3 * i) += weight * blocks;
    }
  const Eigen::HessenbergDecomposition<Eigen::MatrixXd> form(stiffness / modulus_);
  const Eigen::MatrixXd turn = form.matrixQ();
  stiffness_ = form.matrixH();
  loading_ = (turn.transpose() * loading_).eval();
  readOut_ = (readOut_ * turn).eval();
}

Eigen::MatrixXd MeasuredResponse::readOut(const Eigen::MatrixXd& support) const {
  Eigen::MatrixXd rows(rows_.rows(), 3);
  for (std::size_t i = 0; i < probeOf_.size(); ++i)
    rows.middleRows<3>(3 * i) =
        readOut_.middleRows<3>(3 * i) * support.middleCols<3>(3 * probeOf_[i]);
  return rows;
}

Eigen::VectorXd MeasuredResponse::residuals(const Measurements& measurements, double length) const {
  const Eigen::MatrixXd rows = onFoundation(length, nullptr);
  Eigen::VectorXd residuals(rows.rows());
  for (std::size_t i = 0; i < probeOf_.size(); ++i)
    residuals.segment<3>(3 * i) =
        measurements.displacements[i].displacement -
        rows.middleRows<3>(3 * i) * measurements.probes[probeOf_[i]].force;
  return residuals;
}

Eigen::MatrixXd MeasuredResponse::onFoundation(double length, Eigen::MatrixXd* derivative) const {
  if (derivative) derivative->setZero(rows_.rows(), 3);
  if (stiffness_.size() == 0) return rows_;
  // The support's displacement per force: -(c Xi_UU / E + 1)^-1 c Xi_UF / E.
  Eigen::MatrixXd support = length * loading_;
  solveShifted(stiffness_, length, support);
  if (derivative) {
    Eigen::MatrixXd change = loading_ - stiffness_ * support;
    solveShifted(stiffness_, length, change);
    *derivative = -readOut(change);
  }
  return rows_ - readOut(support);
}

}  // namespace palpate
