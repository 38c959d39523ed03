// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/observability.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "sentence.h"

namespace palpate {
namespace {

constexpr double kWeakLogarithm = 0.1, kUnseenLogarithm = 1;  // of standard deviations of ln E
constexpr double kWeakPoisson = 0.05;
constexpr double kTangential = 0.17;  // sine of the angle up to which a force counts as normal

/// Standard deviations by an information matrix; very large ones where it is singular.
Eigen::VectorXd deviationsBy(const Eigen::MatrixXd& information) {
  const Eigen::VectorXd sizes = information.diagonal().cwiseSqrt().cwiseMax(1e-300);
  const Eigen::MatrixXd scaled =
      sizes.cwiseInverse().asDiagonal() * information * sizes.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(scaled);
  const Eigen::VectorXd values = parts.eigenvalues().cwiseMax(1e-18);
  const Eigen::MatrixXd inverse =
      parts.eigenvectors() * values.cwiseInverse().asDiagonal() * parts.eigenvectors().transpose();
  return inverse.diagonal().cwiseSqrt().cwiseQuotient(sizes);
}

/// What one may do about an unknown.
class Advice {
 public:
  explicit Advice(const FittedMaterial& fit)
      : fit_(fit), forces_(forcesOf(fit.measurements)), information_(informationOf(forces_, -1)) {
    for (Eigen::Index p = 0; p < forces_.cols(); ++p) mean_ += forces_.col(p).norm();
    mean_ /= forces_.cols();
  }

  Eigen::VectorXd deviations() const { return deviationsBy(information_); }

  /// "; a force of ... at probe 2's contact would bring it to ..." or what else there is to do.
  std::string about(int unknown) const;
  bool areNormal() const;

 private:
  /// @param probe  -1 for all.
  Eigen::MatrixXd informationOf(const Eigen::Matrix3Xd& forces, int probe) const;

  const FittedMaterial& fit_;
  Eigen::Matrix3Xd forces_;
  Eigen::MatrixXd information_;
  double mean_ = 0;
};

Eigen::MatrixXd Advice::informationOf(const Eigen::Matrix3Xd& forces, int probe) const {
  Eigen::MatrixXd jacobian;
  fit_.model.displacements(fit_.unknowns, forces, &jacobian);
  jacobian = fit_.weights.asDiagonal() * jacobian;
  const std::vector<int>& probeOf = fit_.model.probeOf();
  for (std::size_t i = 0; i < probeOf.size() && probe >= 0; ++i)
    if (probeOf[i] != probe) jacobian.middleRows<3>(3 * i).setZero();
  return jacobian.transpose() * jacobian;
}

bool Advice::areNormal() const {
  for (Eigen::Index p = 0; p < forces_.cols(); ++p)
    if (forces_.col(p).cross(fit_.normals[p]).norm() > kTangential * forces_.col(p).norm())
      return false;
  return true;
}

std::string Advice::about(int unknown) const {
  const double before = deviations()[unknown];
  double best = before;
  std::string text;
  for (int kind = 0; kind < 3; ++kind) {
    Eigen::Matrix3Xd candidates(3, forces_.cols());
    for (Eigen::Index p = 0; p < forces_.cols(); ++p) {
      const Eigen::Vector3d normal = fit_.normals[p], across = normal.unitOrthogonal();
      candidates.col(p) = mean_ * (kind == 0   ? -normal
                                   : kind == 1 ? across
                                               : Eigen::Vector3d(normal.cross(across)));
    }
    for (Eigen::Index p = 0; p < forces_.cols(); ++p) {
      const double after =
          deviationsBy(information_ + informationOf(candidates, static_cast<int>(p)))[unknown];
      if (!(after < 0.8 * best)) continue;
      best = after;
      const Eigen::Vector3d f = candidates.col(p) / mean_;
      text = sentence("; a ", kind == 0 ? "normal" : "tangential", " force of ", shortly(mean_),
                      " N along (", shortly(f.x()), ", ", shortly(f.y()), ", ", shortly(f.z()),
                      ") at the contact of probe ", fit_.measurements.probes[p].name,
                      " would bring that to ", shortly(after));
    }
  }
  return text.empty() ? "; probe at other places, or hold it at what is known" : text;
}

/// The unknown that another is most easily mistaken for, or -1.
int mistakenFor(int unknown, const Eigen::MatrixXd& covariance, const Eigen::VectorXd& weakest) {
  int other = -1;
  double most = 0.5;
  for (int j = 0; j < weakest.size(); ++j) {
    if (j == unknown) continue;
    const double size =
        covariance.size() > 0 ? std::sqrt(covariance(j, j) * covariance(unknown, unknown)) : 1;
    const double share = covariance.size() == 0 ? std::abs(weakest[j])
                         : size > 0             ? std::abs(covariance(j, unknown)) / size
                                                : 0;
    if (share > most) {
      most = share;
      other = j;
    }
  }
  return other;
}

}  // namespace

Eigen::Matrix3Xd forcesOf(const Measurements& measurements) {
  Eigen::Matrix3Xd forces(3, measurements.probes.size());
  for (std::size_t p = 0; p < measurements.probes.size(); ++p)
    forces.col(p) = measurements.probes[p].force;
  return forces;
}

Observability observability(const FittedMaterial& fit, const Eigen::MatrixXd& covariance,
                            const Eigen::VectorXd& weakest) {
  const MaterialModel& model = fit.model;
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(model.count(), model.count());
  const std::vector<IdentifiedParameter> named = model.parameters(fit.unknowns, none);
  const Advice advice(fit);
  const Eigen::VectorXd deviations = advice.deviations();
  Observability result;
  for (int i = 0; i < model.count(); ++i) {
    if (named[i].isAtBound) continue;
    const bool isLogarithm = model.regionOf(i) >= 0;
    const double range =
        isLogarithm ? std::sqrt(12.0) * kUnseenLogarithm : model.upper()[i] - model.lower()[i];
    const double weak = isLogarithm            ? kWeakLogarithm
                        : i == model.poisson() ? kWeakPoisson
                                               : range / 20;
    if (!(deviations[i] > weak)) continue;
    const bool isUnseen = !(deviations[i] <= range / std::sqrt(12.0));
    std::string text = sentence("the data ", isUnseen ? "cannot" : "hardly", " tell ",
                                named[i].name, " (standard deviation ", shortly(deviations[i]),
                                isLogarithm ? " of its logarithm" : "");
    const int other = mistakenFor(i, covariance, weakest);
    if (other >= 0) text += " together with " + named[other].name;
    text += ")";
    if (advice.areNormal()) text += ": all probes push along the normal";
    (isUnseen ? result.unseen : result.weak).push_back(text + advice.about(i));
  }
  return result;
}

}  // namespace palpate
