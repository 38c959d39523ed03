// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/compliance_kernel.h"

#include <cmath>
#include <utility>

namespace palpate {
namespace {

constexpr int kMostSteps = 500;
constexpr double kOwnFactors = 10;  // variance of a mode's own factor over that of two modes' entry

}  // namespace

MarkerRows::MarkerRows(const MeasuredSetup& setup, const std::vector<int>& free, int vertices)
    : setup_(setup), number_(vertices, -1), freeCount_(free.size()) {
  for (std::size_t i = 0; i < free.size(); ++i) number_[free[i]] = static_cast<int>(i);
}

template <class Act>
void MarkerRows::forCorners(const Act& act) const {
  for (int i = 0; i < setup_.markerCount(); ++i)
    for (int k = 0; k < 3; ++k)
      if (const int corner = number_[setup_.nodes[i][k]]; corner >= 0)
        act(i, corner, setup_.weights[i][k]);
}

Eigen::VectorXd MarkerRows::seen(const Eigen::MatrixXd& displacements) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(3 * setup_.markerCount());
  forCorners([&](int i, int corner, double weight) {
    result.segment<3>(3 * i) +=
        weight * displacements.col(setup_.probeOf[i]).segment<3>(3 * corner);
  });
  return result;
}

Eigen::MatrixXd MarkerRows::spread(const Eigen::VectorXd& values) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * freeCount_, setup_.probeCount());
  forCorners([&](int i, int corner, double weight) {
    result.col(setup_.probeOf[i]).segment<3>(3 * corner) += weight * values.segment<3>(3 * i);
  });
  return result;
}

ComplianceKernel::ComplianceKernel(Eigen::MatrixXd modes, const Eigen::MatrixXd& loads,
                                   const MarkerRows& markers, const Progress& progress)
    : modes_(std::move(modes)),
      markers_(markers),
      progress_(progress),
      loaded_(modes_.transpose() * loads),
      work_(loaded_.transpose() * loaded_),
      unit_(modes_.rowwise().squaredNorm().mean() * work_.diagonal().mean() / 2) {}

Eigen::VectorXd ComplianceKernel::seen(const Eigen::VectorXd& pulls) const {
  const Eigen::MatrixXd pulled = modes_.transpose() * markers_.spread(pulls);
  const Eigen::VectorXd own = kOwnFactors * pulled.cwiseProduct(loaded_).rowwise().sum();
  return markers_.seen(modes_ * ((pulled * work_ + loaded_ * (pulled.transpose() * loaded_)) / 2 +
                                 own.asDiagonal() * loaded_));
}

Eigen::VectorXd ComplianceKernel::pulls(const Eigen::VectorXd& residuals,
                                        const Eigen::VectorXd& weights, double smoothing,
                                        double tolerance) const {
  const auto times = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return weights.cwiseProduct(seen(weights.cwiseProduct(x))) + smoothing * unit_ * x;
  };
  Eigen::VectorXd x = Eigen::VectorXd::Zero(residuals.size()),
                  left = weights.cwiseProduct(residuals), along = left;
  const double enough = tolerance * left.norm();
  for (int step = 0; left.norm() > enough; ++step) {
    if (step == kMostSteps) throw TooLittleSmoothing();
    progress_.report(0.5, "correct");
    const Eigen::VectorXd image = times(along);
    const double before = left.squaredNorm(), length = before / along.dot(image);
    x += length * along;
    left -= length * image;
    along = left + left.squaredNorm() / before * along;
  }
  return weights.cwiseProduct(x);
}

Eigen::MatrixXd ComplianceKernel::matrix(const Eigen::VectorXd& pulls) const {
  const Eigen::MatrixXd pulled = modes_.transpose() * markers_.spread(pulls),
                        half = pulled * loaded_.transpose() / 2;
  Eigen::MatrixXd entries = half + half.transpose();
  entries.diagonal() *= 1 + kOwnFactors;
  return modes_ * entries * modes_.transpose();
}

}  // namespace palpate
