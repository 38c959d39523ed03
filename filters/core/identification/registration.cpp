// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/registration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <memory>
#include <set>
#include <vector>

#include "identification/least_squares.h"
#include "identification/robust_statistics.h"
#include "mesh/surface_locator.h"
#include "sentence.h"

namespace palpate {
namespace {

constexpr int kLeastPlaces = 6;
constexpr double kDetermined = 3e-2;  // of singular values, rotations times the places' extent
constexpr double kRobustScale = 2.5;
constexpr int kScalings = 8, kPlain = 3;  // fits in a row, the first of all places alike

/// A rotation by a vector: its direction and angle.
Eigen::Matrix3d turnBy(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix()
                   : Eigen::Matrix3d::Identity().eval();
}

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

/// Each once: a marker that several probes saw is one place.
Eigen::Matrix3Xd placesOf(const Measurements& measurements) {
  std::vector<Eigen::Vector3d> places;
  std::set<std::array<double, 3>> known;
  const auto add = [&](const RestPlace& place) {
    const Eigen::Vector3d& p = place.point;
    if (place.vertex < 0 && known.insert({p.x(), p.y(), p.z()}).second) places.push_back(p);
  };
  for (const Probe& probe : measurements.probes) add(probe.contact);
  for (const MeasuredDisplacement& measured : measurements.displacements) add(measured.marker);
  Eigen::Matrix3Xd matrix(3, places.size());
  for (std::size_t i = 0; i < places.size(); ++i) matrix.col(i) = places[i];
  return matrix;
}

/// By area.
Eigen::Vector3d middleOf(const SurfaceMesh& mesh) {
  return mesh.points() * mesh.vertexAreas() / mesh.vertexAreas().sum();
}

/// Distances from the surface under motions of places whose centre was brought to its middle: a
/// turn about it, times the places' extent, and a shift. However far away the places were, motions
/// are about as large as the surface.
class Alignment {
 public:
  Alignment(const SurfaceMesh& mesh, const Eigen::Matrix3Xd& places)
      : mesh_(mesh),
        locator_(std::make_shared<SurfaceMesh>(mesh.points(), mesh.triangles(), mesh.rims())),
        middle_(middleOf(mesh)),
        centre_(places.rowwise().mean()),
        offsets_(places.colwise() - centre_),
        extent_(std::sqrt(offsets_.colwise().squaredNorm().mean())) {}

  double extent() const { return extent_; }

  /// Of places that are left where they were.
  Eigen::VectorXd stay() const {
    Eigen::VectorXd motion = Eigen::VectorXd::Zero(6);
    motion.tail<3>() = centre_ - middle_;
    return motion;
  }

  Eigen::Matrix3d rotation(const Eigen::VectorXd& motion) const {
    return turnBy(motion.head<3>() / extent_);
  }

  Eigen::Vector3d translation(const Eigen::VectorXd& motion) const {
    return middle_ + motion.tail<3>() - rotation(motion) * centre_;
  }

  Eigen::Vector3d centre(const Eigen::VectorXd& motion) const { return middle_ + motion.tail<3>(); }

  /// Of distances by further turns about the centre, times the places' extent, and by shifts; a row
  /// a place.
  Eigen::MatrixXd distancesByMotion(const Eigen::VectorXd& motion) const {
    Eigen::VectorXd residuals;
    Eigen::MatrixXd all;
    evaluate(motion, 1, residuals, &all);
    Eigen::MatrixXd rows(offsets_.cols(), 6);
    for (Eigen::Index i = 0; i < offsets_.cols(); ++i) {
      const Eigen::Vector3d arm = rotation(motion) * offsets_.col(i),
                            normal = all.block<1, 3>(3 * i, 3).transpose();
      rows.row(i) << (arm.cross(normal) / extent_).transpose(), normal.transpose();
    }
    return rows;
  }

  /// How far motions take the places off the surface, were it smooth: of facets alone, the sides
  /// of a ball would tell how it is turned. A row a place.
  Eigen::MatrixXd sensitivity(const Eigen::VectorXd& motion) const {
    Eigen::MatrixXd rows(offsets_.cols(), 6);
    for (Eigen::Index i = 0; i < offsets_.cols(); ++i) {
      const Eigen::Vector3d arm = rotation(motion) * offsets_.col(i);
      const SurfacePoint nearest = locator_.nearest(middle_ + arm + motion.tail<3>());
      const Eigen::Vector3d normal =
          (mesh_.vertexNormals()(Eigen::all, mesh_.triangles().col(nearest.triangle)) *
           nearest.barycentric)
              .normalized();
      rows.row(i) << (arm.cross(normal) / extent_).transpose(), normal.transpose();
    }
    return rows;
  }

  /// Distance along the normal and its derivatives by turns times extent, and by shifts; a group a
  /// place. All distances are over `scale`.
  void evaluate(const Eigen::VectorXd& motion, double scale, Eigen::VectorXd& residuals,
                Eigen::MatrixXd* jacobian) const {
    const Eigen::Index count = offsets_.cols();
    residuals.setZero(3 * count);
    if (jacobian) jacobian->setZero(3 * count, 6);
    const Eigen::Vector3d turn = motion.head<3>() / extent_;
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Vector3d arm = turnBy(turn) * offsets_.col(i),
                            place = middle_ + arm + motion.tail<3>();
      const SurfacePoint nearest = locator_.nearest(place);
      const Eigen::Vector3d gap = place - placeOf(mesh_, nearest);
      Eigen::Vector3d normal = mesh_.triangleNormals().col(nearest.triangle);
      if (gap.norm() > 1e-9 * extent_) normal = gap.normalized() * (gap.dot(normal) < 0 ? -1 : 1);
      residuals[3 * i] = gap.dot(normal) / scale;
      if (!jacobian) continue;
      jacobian->block<1, 3>(3 * i, 0) =
          -normal.transpose() * crossMatrix(arm) * leftJacobian(turn) / (extent_ * scale);
      jacobian->block<1, 3>(3 * i, 3) = normal.transpose() / scale;
    }
  }

 private:
  /// Of the rotation by a vector: the turn that a change of the vector adds, to third order.
  static Eigen::Matrix3d leftJacobian(const Eigen::Vector3d& turn) {
    const Eigen::Matrix3d cross = crossMatrix(turn);
    const double angle = turn.norm();
    const double first = angle > 1e-4 ? (1 - std::cos(angle)) / (angle * angle) : 0.5,
                 second = angle > 1e-4 ? (angle - std::sin(angle)) / std::pow(angle, 3) : 1.0 / 6;
    return Eigen::Matrix3d::Identity() + first * cross + second * cross * cross;
  }

  const SurfaceMesh& mesh_;
  SurfaceLocator locator_;
  Eigen::Vector3d middle_, centre_;
  Eigen::Matrix3Xd offsets_;
  double extent_;
};

double medianScale(const Eigen::VectorXd& residuals, double least) {
  std::vector<double> sizes;
  for (Eigen::Index i = 0; i < residuals.size(); i += 3) sizes.push_back(std::abs(residuals[i]));
  return std::max(medianDeviation(std::move(sizes)), least);
}

void requireDetermined(const Eigen::MatrixXd& sensitivity) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> parts(sensitivity, Eigen::ComputeThinV);
  const Eigen::VectorXd values = parts.singularValues();
  if (values.size() == 6 && values[5] >= kDetermined * values[0]) return;
  const Eigen::VectorXd free = parts.matrixV().col(5);
  const bool isTurn = free.head<3>().norm() > free.tail<3>().norm();
  const Eigen::Vector3d along = (isTurn ? free.head<3>() : free.tail<3>()).normalized();
  refuse("the places of markers and contacts do not tell the ",
         isTurn ? "rotation about" : "translation along", " (", shortly(along.x()), ", ",
         shortly(along.y()), ", ", shortly(along.z()),
         "): on this surface that moves none off it; spread the markers over other parts, or give "
         "the measurements in the surface's frame");
}

struct Fit {
  Eigen::VectorXd motion;
  Eigen::VectorXd residuals;  ///< m
};

/// Robustly, from a motion on, each time with the scale that the fit before left.
Fit fitFrom(const Eigen::VectorXd& start, const Alignment& alignment, const SurfaceMesh& mesh,
            const std::function<bool()>& goOn) try {
  const double rounding = 1e-9 * mesh.diagonal();
  Fit fit{start, {}};
  alignment.evaluate(fit.motion, 1, fit.residuals, nullptr);
  LeastSquaresProblem problem;
  problem.lower.setConstant(6, -INFINITY);
  problem.upper = -problem.lower;
  problem.groups = static_cast<int>(fit.residuals.size() / 3);
  problem.goOn = goOn;
  problem.scale = kRobustScale;
  for (int i = 0; i < kScalings; ++i) {
    const double scale = medianScale(fit.residuals, rounding);
    problem.start = fit.motion;
    problem.loss = i < kPlain ? RobustLoss::None : RobustLoss::Cauchy;
    problem.evaluate = [&](const Eigen::VectorXd& motion, Eigen::VectorXd& r, Eigen::MatrixXd* j) {
      alignment.evaluate(motion, scale, r, j);
    };
    fit.motion = solveLeastSquares(problem).parameters;
    alignment.evaluate(fit.motion, 1, fit.residuals, nullptr);
    if (fit.residuals.cwiseAbs().maxCoeff() < rounding) break;
  }
  return fit;
} catch (const NotConverged& ended) {
  requireDetermined(alignment.sensitivity(ended.parameters));
  throw;
}

/// By how far places are off. Of as many as there are numbers of a motion none would be.
double deviationOf(const Fit& fit, const SurfaceMesh& mesh) {
  const double count = fit.residuals.size() / 3;
  return medianScale(fit.residuals, 1e-9 * mesh.diagonal()) *
         std::sqrt(count / std::max(1.0, count - 6));
}

/// Registration::spread, of places of this deviation.
Eigen::MatrixXd spreadOf(const Fit& fit, const Alignment& alignment, double deviation) {
  const Eigen::MatrixXd rows = alignment.distancesByMotion(fit.motion);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(rows.transpose() * rows);
  Eigen::MatrixXd spread = deviation * parts.eigenvectors() *
                           parts.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal();
  spread.topRows(3) /= alignment.extent();
  return spread;
}

}  // namespace

Registration registerToSurface(const SurfaceMesh& mesh, const Measurements& measurements,
                               const std::function<bool()>& goOn) {
  const Eigen::Matrix3Xd places = placesOf(measurements);
  if (places.cols() < kLeastPlaces)
    refuse("a registration needs at least ", kLeastPlaces,
           " different places that are given by their coordinates, not ", places.cols());
  const Alignment alignment(mesh, places);
  if (!(alignment.extent() > 0)) refuse("all markers and contacts are at one place");
  Fit best = fitFrom(Eigen::VectorXd::Zero(6), alignment, mesh, goOn);
  if (alignment.stay().norm() < mesh.diagonal()) {  // places that may be where they belong
    Fit near = fitFrom(alignment.stay(), alignment, mesh, goOn);
    if (near.residuals.norm() < best.residuals.norm()) best = std::move(near);
  }
  requireDetermined(alignment.sensitivity(best.motion));
  Registration result;
  result.rotation = alignment.rotation(best.motion);
  result.translation = alignment.translation(best.motion);
  result.placeDeviation = deviationOf(best, mesh);
  result.centre = alignment.centre(best.motion);
  result.spread = spreadOf(best, alignment, result.placeDeviation);
  const Eigen::VectorXd deviations = result.spread.rowwise().norm();
  result.rotationDeviation = deviations.head<3>();
  result.translationDeviation = deviations.tail<3>();
  result.distance = best.residuals.norm() / std::sqrt(double(places.cols()));
  return result;
}

Measurements registered(const Measurements& measurements, const Registration& registration) {
  Measurements result = measurements;
  const auto move = [&](RestPlace& place) {
    if (place.vertex < 0)
      place.point = registration.rotation * place.point + registration.translation;
  };
  for (Probe& probe : result.probes) {
    move(probe.contact);
    probe.force = registration.rotation * probe.force;
  }
  for (MeasuredDisplacement& measured : result.displacements) {
    move(measured.marker);
    if (measured.displacement.array().isNaN().any())
      refuse(measurements.nameOf(measured),
             ": a displacement of which components are missing cannot be turned into the surface's "
             "frame: leave the row out");
    measured.displacement = registration.rotation * measured.displacement;
    if (measured.deviation.maxCoeff() > measured.deviation.minCoeff())
      measured.deviation.setConstant(std::sqrt(measured.deviation.squaredNorm() / 3));
  }
  return result;
}

}  // namespace palpate
