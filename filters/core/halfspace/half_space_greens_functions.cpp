// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "halfspace/half_space_greens_functions.h"

#include <cmath>
#include <Eigen/Eigenvalues>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "greens/computed_greens_functions.h"
#include "mesh/triangle_sides.h"
#include "stopwatch.h"

namespace palpate {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kMostPairs = 200000;  // of nodes, that the reciprocity defect is measured on

Eigen::Matrix2Xd projected(const SurfaceMesh& mesh, const Plane& plane) {
  Eigen::Matrix2Xd points(2, mesh.vertexCount());
  for (int v = 0; v < mesh.vertexCount(); ++v) points.col(v) = plane.of(mesh.points().col(v));
  return points;
}

GreensFunctionsInfo checked(GreensFunctionsInfo info) {
  if (info.domain != Domain::HalfSpace || !info.patchColumns.empty() ||
      !info.conditions.fixedNodes().empty())
    throw std::invalid_argument(
        "Green's functions of a half-space have neither fixed nodes nor patch columns");
  return info;
}

/// |S - S^T|_F / |S|_F of the force compliance, over some columns spread evenly and all rows.
double reciprocityDefect(const GreensFunctions& raw, const Progress& progress) {
  const std::vector<int>& nodes = raw.info().columnNodes;
  const std::size_t count = nodes.size();
  const std::size_t step = 1 + count * count / kMostPairs;
  double antisymmetric = 0, all = 0;
  for (std::size_t c = 0; c < count; c += step) {
    progress.report(double(c) / count, "check");
    for (int row : nodes) {
      const int column = nodes[c];
      Eigen::Matrix3d there, back;
      raw.gather(Eigen::Map<const Eigen::VectorXi>(&row, 1),
                 Eigen::Map<const Eigen::VectorXi>(&column, 1), there.data());
      raw.gather(Eigen::Map<const Eigen::VectorXi>(&column, 1),
                 Eigen::Map<const Eigen::VectorXi>(&row, 1), back.data());
      there /= raw.vertexArea(column);
      back /= raw.vertexArea(row);
      antisymmetric += (there - back.transpose()).squaredNorm();
      all += (there.squaredNorm() + back.squaredNorm()) / 2;
    }
  }
  return all > 0 ? std::sqrt(antisymmetric / all) : 0;
}

/// A sentence if a vertex and a neighbour, pressed together, would yield a negative energy.
std::vector<std::string> indefiniteWarnings(const GreensFunctions& greens,
                                            const SurfaceMesh& mesh) {
  double worst = 0;
  Eigen::Vector2i where(0, 0);
  forEachEdge(sortedSides(mesh.triangles()), [&](auto side, auto) {
    const Eigen::Vector2i nodes(side->low, side->high);
    if (!greens.hasColumn(nodes[0]) || !greens.hasColumn(nodes[1])) return;
    Eigen::Matrix<double, 6, 6> compliance;
    greens.gather(nodes, nodes, compliance.data());
    for (int i = 0; i < 2; ++i) compliance.middleCols<3>(3 * i) /= greens.vertexArea(nodes[i]);
    const Eigen::Matrix<double, 6, 1> scale = compliance.diagonal().cwiseSqrt().cwiseInverse();
    compliance = scale.asDiagonal() * compliance * scale.asDiagonal();
    const double least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>(
                             compliance, Eigen::EigenvaluesOnly)
                             .eigenvalues()[0];
    if (least >= worst) return;
    worst = least;
    where = nodes;
  });
  if (worst >= 0) return {};
  std::ostringstream text;
  text.precision(3);
  text << "the compliance of vertices " << where[0] << " and " << where[1]
       << " together is not positive (least eigenvalue " << worst
       << " of a diagonal of 1): they are too near each other for the triangles round them; remesh";
  return {text.str()};
}

}  // namespace

HalfSpaceGreensFunctions::HalfSpaceGreensFunctions(GreensFunctionsInfo info,
                                                   const SurfaceMesh& mesh)
    : HalfSpaceGreensFunctions(checked(std::move(info)), [&]() -> std::shared_ptr<const Surface> {
        const Plane plane = planeOf(mesh);
        return std::make_shared<const Surface>(
            Surface{plane, HatIntegrals(projected(mesh, plane), mesh.triangles())});
      }()) {
  if (mesh.vertexCount() != nodeCount())
    throw std::invalid_argument("there are " + std::to_string(nodeCount()) +
                                " boundary types for " + std::to_string(mesh.vertexCount()) +
                                " vertices");
}

HalfSpaceGreensFunctions::HalfSpaceGreensFunctions(GreensFunctionsInfo info,
                                                   std::shared_ptr<const Surface> surface)
    : GreensFunctions(std::move(info)), surface_(std::move(surface)) {
  const double nu = this->info().material.poissonRatio();
  const double compliance = (1 + nu) / (2 * kPi * this->info().material.youngsModulus());
  straight_ = 2 * (1 - nu) * compliance;
  along_ = 2 * nu * compliance;
  coupled_ = (1 - 2 * nu) * compliance;
}

double HalfSpaceGreensFunctions::epsilon() const {
  return std::numeric_limits<double>::epsilon();
}

/// The hat's, or the mean of both nodes' as force compliances. Turned round, d is -d.
HatMoments HalfSpaceGreensFunctions::moments(int row, int column) const noexcept {
  const HatMoments there = surface_->hats.at(row, column);
  if (!info().reciprocal) return there;
  const HatMoments back = surface_->hats.at(column, row);
  const double ratio = vertexArea(column) / vertexArea(row);
  const double sum = there.inverse + ratio * back.inverse;
  // The harmonic mean of 1/r, and the others in proportion.
  const double share = 2 * there.inverse * ratio * back.inverse / (sum * sum);
  return {share * sum, share * (there.xx + ratio * back.xx), share * (there.xy + ratio * back.xy),
          share * (there.x - ratio * back.x), share * (there.y - ratio * back.y)};
}

Eigen::Matrix3d HalfSpaceGreensFunctions::block(int row, int column) const noexcept {
  const HatMoments m = moments(row, column);
  const Plane& plane = surface_->plane;
  Eigen::Matrix3d turn, local;
  turn << plane.first, plane.second, plane.normal;
  const double diagonal = straight_ * m.inverse, across = along_ * m.xy, x = coupled_ * m.x,
               y = coupled_ * m.y;
  local << diagonal + along_ * m.xx, across, x,           //
      across, diagonal + along_ * (m.inverse - m.xx), y,  //
      -x, -y, diagonal;
  return turn * local * turn.transpose();
}

void HalfSpaceGreensFunctions::gather(NodeList rows, NodeList columns, double* out) const {
  const Eigen::Index stride = 3 * rows.size();
  for (Eigen::Index c = 0; c < columns.size(); ++c)
    for (Eigen::Index r = 0; r < rows.size(); ++r)
      Eigen::Map<Eigen::Matrix3d, 0, Eigen::OuterStride<>>(
          out + 3 * c * stride + 3 * r, Eigen::OuterStride<>(stride)) = block(rows[r], columns[c]);
}

void HalfSpaceGreensFunctions::accumulate(NodeList columns, Values weights,
                                          Eigen::Ref<Eigen::VectorXd> out) const {
  for (Eigen::Index c = 0; c < columns.size(); ++c)
    for (int row = 0; row < nodeCount(); ++row)
      out.segment<3>(3 * row) += block(row, columns[c]) * weights.segment<3>(3 * c);
}

void HalfSpaceGreensFunctions::accumulate(NodeList columns, Values weights, NodeList rows,
                                          Eigen::Ref<Eigen::VectorXd> out) const {
  for (Eigen::Index c = 0; c < columns.size(); ++c)
    for (Eigen::Index r = 0; r < rows.size(); ++r)
      out.segment<3>(3 * r) += block(rows[r], columns[c]) * weights.segment<3>(3 * c);
}

std::shared_ptr<const GreensFunctions> HalfSpaceGreensFunctions::withYoungsModulus(
    double youngsModulus) const {
  GreensFunctionsInfo scaled = info();
  scaled.material = Material(youngsModulus, info().material.poissonRatio());
  return std::shared_ptr<const HalfSpaceGreensFunctions>(
      new HalfSpaceGreensFunctions(std::move(scaled), surface_));
}

std::shared_ptr<const HalfSpaceGreensFunctions> computeHalfSpaceGreensFunctions(
    const ElasticModel& model, const HalfSpaceOptions& options, const ProgressCallback& progress) {
  if (model.domain() != Domain::HalfSpace)
    throw std::invalid_argument("the model's material does not fill a half-space");
  const Progress whole(progress);
  GreensFunctionsInfo info = infoOf(model, options.columns);
  info.source =
      std::string("half-space (Boussinesq and Cerruti, linear triangles), closed form, ") +
      (options.reciprocal ? "reciprocal" : "raw");

  whole.report(0, "integrate");
  Stopwatch watch;
  const HalfSpaceGreensFunctions raw(info, model.mesh());
  addSeconds(info.diagnostics, "integrate", watch.seconds());
  info.diagnostics.peakBytes = raw.bytes();
  info.diagnostics.reciprocityDefect = reciprocityDefect(raw, whole.part(0.1, 1));
  addSeconds(info.diagnostics, "check", watch.seconds());
  info.reciprocal = options.reciprocal;
  if (info.reciprocal)
    info.diagnostics.warnings =
        indefiniteWarnings(HalfSpaceGreensFunctions(info, raw.surface_), model.mesh());
  return std::shared_ptr<const HalfSpaceGreensFunctions>(
      new HalfSpaceGreensFunctions(std::move(info), raw.surface_));
}

}  // namespace palpate
