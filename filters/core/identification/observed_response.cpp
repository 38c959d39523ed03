// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/observed_response.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <string>

#include "sentence.h"

namespace palpate {
namespace {

constexpr double kUsualNoise = 0.01;  // of the largest displacement

constexpr double kLargestDisplacement = 0.5;  // of the diagonal, as linear theory goes
constexpr double kLeastDisplacement = 1e-7;   // likewise
constexpr int kLeastValues = 9;

std::string shownVector(const Eigen::Vector3d& v) {
  return sentence("(", shortly(v.x()), ", ", shortly(v.y()), ", ", shortly(v.z()), ")");
}

/// The largest component seen.
double largestOf(const Eigen::Matrix3Xd& displacements) {
  double largest = 0;
  for (double u : displacements.reshaped())
    if (!std::isnan(u)) largest = std::max(largest, std::abs(u));
  return largest;
}

}  // namespace

ObservedDisplacements observedUnder(const Measurements& measurements,
                                    const std::vector<SurfacePoint>& markers,
                                    const std::string& probe, double noise) {
  constexpr std::size_t most = 8;
  std::string names;
  int chosen = probe.empty() && measurements.probes.size() == 1 ? 0 : -1;
  for (std::size_t p = 0; p < measurements.probes.size(); ++p) {
    if (!probe.empty() && measurements.probes[p].name == probe) chosen = static_cast<int>(p);
    if (p < most) names += (p > 0 ? ", " : "") + measurements.probes[p].name;
  }
  if (measurements.probes.size() > most) names += " ...";
  if (chosen < 0)
    refuse(measurements.source, probe.empty() ? ": choose one of the " : ": there is no probe ",
           probe.empty() ? sentence(measurements.probes.size(), " probes: ") : probe + " among ",
           names);
  if (!(noise >= 0 && std::isfinite(noise)))
    refuse("the noise must not be negative, not ", noise, " m");
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < measurements.displacements.size(); ++i)
    if (measurements.displacements[i].probe == chosen) rows.push_back(i);
  ObservedDisplacements observed;
  observed.displacements.resize(3, rows.size());
  if (noise > 0 || measurements.hasDeviations())
    observed.deviations.setConstant(3, rows.size(), noise);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const MeasuredDisplacement& measured = measurements.displacements[rows[i]];
    observed.points.push_back(markers[rows[i]]);
    observed.displacements.col(i) = measured.displacement;
    if (noise == 0 && measurements.hasDeviations()) observed.deviations.col(i) = measured.deviation;
  }
  return observed;
}

void requireUsable(const SurfaceMesh& mesh, const ObservedDisplacements& observed) {
  const Eigen::Index count = static_cast<Eigen::Index>(observed.points.size());
  if (observed.displacements.cols() != count)
    refuse("there are ", count, " points, but ", observed.displacements.cols(), " displacements");
  if (observed.deviations.cols() != 0 && observed.deviations.cols() != count)
    refuse("there are ", count, " points, but ", observed.deviations.cols(),
           " standard deviations");
  int values = 0;
  double largest = 0;
  Eigen::AlignedBox3d box;
  for (Eigen::Index i = 0; i < count; ++i) {
    const SurfacePoint& point = observed.points[i];
    if (point.triangle < 0 || point.triangle >= mesh.triangleCount() ||
        !point.barycentric.allFinite())
      refuse("point ", i, " is not on the surface");
    box.extend(placeOf(mesh, point));
    const Eigen::Vector3d u = observed.displacements.col(i);
    if (u.array().isInf().any() || u.array().isNaN().all())
      refuse("the displacement ", shownVector(u), " of point ", i, " is not finite");
    for (int c = 0; c < 3; ++c) {
      if (std::isnan(u[c])) continue;
      ++values;
      largest = std::max(largest, std::abs(u[c]));
      if (observed.deviations.cols() > 0 &&
          !(observed.deviations(c, i) > 0 && std::isfinite(observed.deviations(c, i))))
        refuse("the standard deviation of point ", i, " must be positive, not ",
               observed.deviations(c, i));
    }
  }
  if (values < kLeastValues)
    refuse("a contact's force and place are not recovered from ", values,
           " components of displacements: observe at least ", kLeastValues,
           ", better a hundred, all round the body");
  if (largest == 0) refuse("nothing moved: no displacement is other than zero");
  if (box.diagonal().norm() < mesh.meanEdgeLength())
    refuse("all ", count, " points are within ", shortly(box.diagonal().norm()),
           " m of one place, less than an edge of the mesh: spread them over the body");
  if (largest > kLargestDisplacement * mesh.diagonal())
    refuse("a displacement of ", shortly(largest), " m is ", shortly(largest / mesh.diagonal()),
           " times the size of the body: check the unit of length");
  if (largest < kLeastDisplacement * mesh.diagonal())
    refuse("the largest displacement, ", shortly(largest), " m, is ",
           shortly(largest / mesh.diagonal()),
           " times the size of the body, which nobody observes: check the unit of length");
}

ObservedResponse::ObservedResponse(const GreensFunctions& greens, const SurfaceMesh& mesh,
                                   const std::vector<LoadSite>& sites,
                                   const ObservedDisplacements& observed,
                                   const Progress& progress) {
  for (const LoadSite& site : sites) {
    if (nodes_.empty() || nodes_.back() != site.vertex) nodes_.push_back(site.vertex);
    placeOf_.push_back(static_cast<int>(nodes_.size()) - 1);
  }
  double area = 0;
  for (int node : greens.info().conditions.fixedNodes()) {
    centre_ += greens.vertexArea(node) * mesh.points().col(node);
    area += greens.vertexArea(node);
  }
  isHeld_ = area > 0 && mesh.bodyCount() == 1;
  if (isHeld_) centre_ /= area;
  wrenchOf_.setZero(6, 3 * nodes_.size());
  for (std::size_t j = 0; j < nodes_.size(); ++j)
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector3d arm = mesh.points().col(nodes_[j]) - centre_;
      wrenchOf_.col(3 * j + c) << Eigen::Vector3d::Unit(c), arm.cross(Eigen::Vector3d::Unit(c));
    }
  addRows(greens, mesh, observed, progress);
}

void ObservedResponse::addRows(const GreensFunctions& greens, const SurfaceMesh& mesh,
                               const ObservedDisplacements& observed, const Progress& progress) {
  const Eigen::Index width = 3 * nodes_.size(), modes = isHeld_ ? 6 : 0,
                     points = observed.displacements.cols();
  const bool isKnown = observed.deviations.cols() > 0;
  const double usual = kUsualNoise * largestOf(observed.displacements);
  const Eigen::Index all = width + modes + 1;
  all_.resize(std::min<Eigen::Index>(3 * points, 3 * all), all);
  Eigen::MatrixXd blocks(3, width), here(3, width);
  double squares = 0;
  for (Eigen::Index i = 0; i < points; ++i) {
    if (i % 64 == 0) progress.report(double(i) / double(points), "responses");
    here.setZero();
    for (int k = 0; k < 3; ++k) {
      const int node = mesh.triangles()(k, observed.points[i].triangle);
      const double weight = observed.points[i].barycentric[k];
      if (weight == 0 || greens.isFixed(node)) continue;
      greens.gather(nodeList({node}), nodeList(nodes_), blocks.data());
      here += weight * blocks;
    }
    const Eigen::Vector3d arm = placeOf(mesh, observed.points[i]) - centre_;
    for (int c = 0; c < 3; ++c) {
      const double u = observed.displacements(c, i);
      if (std::isnan(u)) continue;
      if (used_ == all_.rows()) condense();
      const double deviation = isKnown ? observed.deviations(c, i) : usual;
      all_.row(used_).head(width) = here.row(c) / deviation;
      for (Eigen::Index m = 0; m < modes; ++m)
        all_(used_, width + m) =
            (m < 3 ? double(m == c) : Eigen::Vector3d::Unit(m - 3).cross(arm)[c]) / deviation;
      all_(used_, all - 1) = u / deviation;
      squares += deviation * deviation;
      ++used_;
      ++valueCount_;
    }
  }
  unit_ = std::sqrt(squares / valueCount_);
  if (used_ > all) condense();
  for (std::size_t j = 0; j < nodes_.size(); ++j)
    all_.middleCols<3>(3 * j) /= greens.vertexArea(nodes_[j]);
  rows_ = all_.topLeftCorner(used_, width);
  modes_ = all_.block(0, width, used_, modes);
  data_ = all_.col(all - 1).head(used_);
  all_.resize(0, 0);
}

void ObservedResponse::condense() {
  const Eigen::Index all = all_.cols();
  Eigen::HouseholderQR<Eigen::MatrixXd> qr(all_.topRows(used_));
  all_.topRows(all) = qr.matrixQR().topRows(all).triangularView<Eigen::Upper>();
  used_ = all;
}

LoadResponses ObservedResponse::responsesTo(std::vector<LoadPatch> patches, double radius) const {
  LoadResponses result;
  result.radius = radius;
  result.firm.setZero(rows_.rows(), 3 * patches.size());
  result.wrenches.setZero(6, 3 * patches.size());
  for (std::size_t k = 0; k < patches.size(); ++k)
    for (std::size_t j = 0; j < patches[k].sites.size(); ++j) {
      const Eigen::Index from = 3 * placeOf_[patches[k].sites[j]];
      const double share = patches[k].shares[j];
      result.firm.middleCols<3>(3 * k) += share * rows_.middleCols<3>(from);
      result.wrenches.middleCols<3>(3 * k) += share * wrenchOf_.middleCols<3>(from);
    }
  result.patches = std::move(patches);
  return result;
}

Eigen::MatrixXd ObservedResponse::columns(const LoadResponses& responses,
                                          const std::vector<int>& sites,
                                          const SupportYield& yield) const {
  Eigen::MatrixXd columns(data_.size(), 3 * sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i)
    columns.middleCols<3>(3 * i) = responses.firm.middleCols<3>(3 * sites[i]);
  if (yield.isZero()) return columns;
  const Eigen::MatrixXd yielding = modes_ * yield.diagonal().asDiagonal();
  for (std::size_t i = 0; i < sites.size(); ++i)
    columns.middleCols<3>(3 * i).noalias() +=
        yielding * responses.wrenches.middleCols<3>(3 * sites[i]);
  return columns;
}

Eigen::MatrixXd ObservedResponse::yieldColumns(const Eigen::Matrix<double, 6, 1>& wrench) const {
  Eigen::MatrixXd columns(data_.size(), 2);
  columns.col(0) = modes_.leftCols<3>() * wrench.head<3>();
  columns.col(1) = modes_.rightCols<3>() * wrench.tail<3>();
  return columns;
}

Eigen::Vector3d ObservedResponse::rigidMotion(const SupportYield& yield,
                                              const Eigen::Matrix<double, 6, 1>& wrench,
                                              const Eigen::Vector3d& place) const {
  const Eigen::Vector3d force = wrench.head<3>(), torque = wrench.tail<3>();
  return yield.translation * force + yield.rotation * torque.cross(place - centre_);
}

}  // namespace palpate
