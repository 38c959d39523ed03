// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/interior_probes.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>

#include "bem/probe_kernels.h"
#include "bem/triangle_quadrature.h"
#include "greens/rigid_motions.h"
#include "greens/support_tractions.h"
#include "mesh/surface_locator.h"
#include "parallel.h"
#include "sentence.h"

namespace palpate {
namespace {

/// 2 G e of a strain e.
Matrix6d shearStiffness(double shearModulus) {
  Eigen::Matrix<double, 6, 1> diagonal;
  diagonal << 2, 2, 2, 1, 1, 1;
  return (shearModulus * diagonal).asDiagonal();
}

using Corners = Eigen::Matrix3d;  // columns

double longestEdge(const Corners& x) {
  return std::sqrt(
      std::max({(x.col(0) - x.col(1)).squaredNorm(), (x.col(1) - x.col(2)).squaredNorm(),
                (x.col(2) - x.col(0)).squaredNorm()}));
}

constexpr double kNearest = 1e-4;  // edges: subdivision goes on until pieces are as small

class ProbePlaces {
 public:
  explicit ProbePlaces(const ElasticModel& model) : model_(model), locator_(model.sharedMesh()) {
    if (model.domain() != Domain::Interior && model.domain() != Domain::Exterior &&
        model.domain() != Domain::Unsupported)
      refuse("points inside are probed in bodies and around cavities, in no other domain");
  }
  /// From the surface, in mean edges.
  double distance(const Eigen::Vector3d& point) const {
    return (placeOf(model_.mesh(), locator_.nearest(point)) - point).norm() /
           model_.mesh().meanEdgeLength();
  }
  bool isInside(const Eigen::Vector3d& point) const {
    return locator_.isInside(point) == (model_.domain() != Domain::Exterior);
  }

 private:
  const ElasticModel& model_;
  SurfaceLocator locator_;
};

}  // namespace

std::vector<int> probesInside(const ElasticModel& model, const Eigen::Matrix3Xd& points) {
  const ProbePlaces places(model);
  std::vector<int> inside;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (const Eigen::Vector3d point = points.col(i);
        point.allFinite() && places.isInside(point) && places.distance(point) >= kNearest)
      inside.push_back(static_cast<int>(i));
  return inside;
}

/// Integrals over the surface for one point after the other.
struct InteriorProbes::Integration {
  explicit Integration(const ElasticModel& m)
      : model(m),
        mesh(m.mesh()),
        shares(supportShares(m.mesh(), m.conditions(), m.smoothPatches())),
        side(m.domain() == Domain::Exterior ? -1 : 1) {}

  /// Adds a triangle, cut in four as long as it is near for its size.
  /// @param barycentric  of the piece's corners in the triangle, columns.
  void add(const Eigen::Vector3d& point, int triangle, const Corners& barycentric, Rows& ofTraction,
           Rows& ofDisplacement) const {
    // Sixteen points integrate r^-3 to 1e-7 from 2 1/2 diameters on, seven from 8.
    constexpr double splitBelow = 2.5, fewFrom = 8;
    const Corners x = corners(triangle) * barycentric;
    const double distance = (x.rowwise().mean() - point).norm() / longestEdge(x);
    if (distance >= splitBelow) {
      integrate(point, triangle, barycentric, x, distance < fewFrom ? fine : coarse, ofTraction,
                ofDisplacement);
      return;
    }
    const Corners middles = (barycentric * (Corners() << 0, 1, 1, 1, 0, 1, 1, 1, 0).finished()) / 2;
    for (int k = 0; k < 3; ++k) {
      Corners piece = middles;
      piece.col(k) = barycentric.col(k);
      add(point, triangle, piece, ofTraction, ofDisplacement);
    }
    add(point, triangle, middles, ofTraction, ofDisplacement);
  }

  void integrate(const Eigen::Vector3d& point, int triangle, const Corners& barycentric,
                 const Corners& x, const bem::TriangleRule& rule, Rows& ofTraction,
                 Rows& ofDisplacement) const {
    const Material& material = model.material();
    const Eigen::Vector3d normal = side * mesh.triangleNormals().col(triangle);
    const double area = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).norm() / 2;
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector3d inPiece = rule.barycentric.col(q);
      const bem::ProbeKernels kernels = bem::probeKernels(
          x * inPiece - point, normal, material.shearModulus(), material.poissonRatio());
      const Eigen::Vector3d hats = area * rule.weights[q] * (barycentric * inPiece);
      for (int k = 0; k < 3; ++k) {
        const int column = 3 * mesh.triangles()(k, triangle);
        ofTraction.middleCols<3>(column) += hats[k] * shares(k, triangle) * kernels.ofTraction;
        ofDisplacement.middleCols<3>(column) += hats[k] * kernels.ofDisplacement;
      }
    }
  }

  Corners corners(int triangle) const {
    return mesh.points()(Eigen::all, mesh.triangles().col(triangle));
  }

  const ElasticModel& model;
  const SurfaceMesh& mesh;
  Eigen::Matrix3Xd shares;
  double side;  // of the normals that points out of the material
  bem::TriangleRule fine = bem::triangleRule(16), coarse = bem::triangleRule(7);
};

InteriorProbes::InteriorProbes(const ElasticModel& model, const Eigen::Matrix3Xd& points,
                               const ProgressCallback& callback, int threads)
    : vertexCount_(model.mesh().vertexCount()),
      shearModulus_(model.material().shearModulus()),
      distances_(points.cols()) {
  const ProbePlaces places(model);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d point = points.col(i);
    if (!point.allFinite()) refuse("probe ", i, " is not at a finite place");
    distances_[i] = places.distance(point);
    if (distances_[i] < kNearest || !places.isInside(point))
      refuse("probe ", i, " at (", point.x(), ", ", point.y(), ", ", point.z(),
             distances_[i] < kNearest ? ") lies on the surface" : ") is not inside the material");
  }
  const Integration integration(model);
  const int count = static_cast<int>(points.cols());
  ofTraction_.assign(count, Rows::Zero(13, 3 * vertexCount_));
  ofDisplacement_ = ofTraction_;
  const Progress progress(callback);
  parallelFor(
      count, threadCount(threads),
      [&](int i, int) {
        for (int f = 0; f < model.mesh().triangleCount(); ++f)
          integration.add(points.col(i), f, Corners::Identity(), ofTraction_[i],
                          ofDisplacement_[i]);
      },
      [&](int begun) { progress.report(double(begun) / count, "probe"); });
  for (std::vector<Rows>* all : {&ofTraction_, &ofDisplacement_})
    for (Rows& rows : *all)  // from the mean stress to what of it 2 G e does not tell
      rows.row(12) -= 2 * shearModulus_ / 3 * (rows.row(3) + rows.row(7) + rows.row(11));
}

std::vector<ProbedField> InteriorProbes::evaluate(const Eigen::Matrix3Xd& displacement,
                                                  const Eigen::Matrix3Xd& traction) const {
  if (displacement.cols() != vertexCount_ || traction.cols() != vertexCount_)
    refuse("displacement and traction must be given at ", vertexCount_, " vertices, not at ",
           displacement.cols(), " and ", traction.cols());
  std::vector<ProbedField> fields;
  for (std::size_t i = 0; i < ofTraction_.size(); ++i)
    fields.push_back(
        fieldOf(ofTraction_[i] * traction.reshaped() + ofDisplacement_[i] * displacement.reshaped(),
                shearStiffness(shearModulus_)));
  return fields;
}

Eigen::MatrixXd InteriorProbes::values(const Eigen::MatrixXd& displacement,
                                       const Eigen::MatrixXd& traction) const {
  Eigen::MatrixXd result(13 * ofTraction_.size(), displacement.cols());
  for (std::size_t i = 0; i < ofTraction_.size(); ++i) {
    auto rows = result.middleRows<13>(static_cast<Eigen::Index>(13 * i));
    rows.noalias() = ofTraction_[i] * traction;
    rows.noalias() += ofDisplacement_[i] * displacement;
  }
  return result;
}

ProbeRows probeRows(const GreensFunctions& greens, const ElasticModel& model,
                    const Eigen::Matrix3Xd& points, const ProgressCallback& callback, int threads) {
  constexpr int atOnce = 32;  // nodes
  if (!greens.info().homogeneous)
    refuse("probes are in bodies of one isotropic material, which this is not");
  const Progress progress(callback);
  const InteriorProbes probes(model, points, progress.part(0, 0.5).callback(), threads);
  const int count = greens.nodeCount();
  Eigen::VectorXi all = Eigen::VectorXi::LinSpaced(count, 0, count - 1);
  std::vector<int> given;  // on which a force can act, or whose displacement can be given
  for (int node = 0; node < count; ++node)
    if (greens.hasColumn(node)) given.push_back(node);
  // Loads of what nothing holds are balanced: see removeRigidMotions.
  Eigen::MatrixXd motions, balance;
  if (model.domain() == Domain::Unsupported) {
    motions = rigidMotionsOfBodies(model.mesh());
    balance = meanRigidMotion(greens.info().vertexAreas, motions);
  }
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(13 * points.cols(), 3 * count);
  for (std::size_t first = 0; first < given.size(); first += atOnce) {
    progress.report(0.5 + 0.5 * double(first) / given.size(), "probe");
    const auto now = static_cast<int>(std::min<std::size_t>(atOnce, given.size() - first));
    Eigen::MatrixXd displacement(3 * count, 3 * now), traction = displacement;
    greens.gather(all, Eigen::Map<const Eigen::VectorXi>(&given[first], now), displacement.data());
    traction.setZero();
    for (int node = 0; node < count; ++node)
      if (greens.isFixed(node)) {
        traction.middleRows<3>(3 * node) = displacement.middleRows<3>(3 * node);
        displacement.middleRows<3>(3 * node).setZero();
      }
    for (int i = 0; i < now; ++i)
      (greens.isFixed(given[first + i]) ? displacement : traction)
          .block<3, 3>(3 * given[first + i], 3 * i)
          .setIdentity();
    if (motions.cols() > 0) traction -= motions * (balance * traction).eval();
    const Eigen::MatrixXd values = probes.values(displacement, traction);
    for (int i = 0; i < now; ++i)
      rows.middleCols<3>(3 * given[first + i]) = values.middleCols<3>(3 * i);
  }
  return {points, std::move(rows),
          std::vector<Matrix6d>(points.cols(), shearStiffness(model.material().shearModulus()))};
}

}  // namespace palpate
