// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/probe_rows.h"

#include <utility>

#include "sentence.h"

namespace palpate {

ProbedField fieldOf(const ProbeValues& values, const Matrix6d& stiffness) {
  ProbedField field;
  field.displacement = values.head<3>();
  field.gradient = values.segment<9>(3).reshaped<Eigen::RowMajor>(3, 3);
  const Eigen::Matrix3d& g = field.gradient;
  Eigen::Matrix<double, 6, 1> strain;
  strain << g(0, 0), g(1, 1), g(2, 2), g(1, 2) + g(2, 1), g(0, 2) + g(2, 0), g(0, 1) + g(1, 0);
  const Eigen::Matrix<double, 6, 1> s = stiffness * strain;
  field.stress << s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2];
  field.stress.diagonal().array() += values[12];
  return field;
}

ProbeRows::ProbeRows(Eigen::Matrix3Xd points, Eigen::MatrixXd rows, std::vector<Matrix6d> stiffness)
    : points_(std::move(points)), rows_(std::move(rows)), stiffness_(std::move(stiffness)) {
  if (rows_.rows() != 13 * points_.cols() || rows_.cols() % 3 != 0 ||
      stiffness_.size() != static_cast<std::size_t>(points_.cols()))
    refuse("rows of ", points_.cols(),
           " probes are 13 a point and 3 a node, and a stiffness each, not ", rows_.rows(), " by ",
           rows_.cols(), " and ", stiffness_.size());
}

ProbeRows ProbeRows::stiffer(double factor) const {
  ProbeRows result = *this;
  for (int point = 0; point < count(); ++point) {
    result.rows_.middleRows<12>(13 * point) /= factor;  // stresses per pascal stay
    result.stiffness_[point] *= factor;
  }
  return result;
}

ProbeRows ProbeRows::at(const Eigen::Matrix3Xd& places, double tolerance) const {
  Eigen::MatrixXd rows(13 * places.cols(), rows_.cols());
  std::vector<Matrix6d> stiffness;
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    Eigen::Index nearest = 0;
    const double away =
        points_.cols() > 0 ? (points_.colwise() - places.col(i)).colwise().norm().minCoeff(&nearest)
                           : tolerance;
    if (!(away < tolerance))
      refuse("the model has no probe at (", places(0, i), ", ", places(1, i), ", ", places(2, i),
             "): one of several materials knows of those alone that were asked for when it was "
             "computed");
    rows.middleRows<13>(13 * i) = rows_.middleRows<13>(13 * nearest);
    stiffness.push_back(stiffness_[nearest]);
  }
  return {places, std::move(rows), std::move(stiffness)};
}

}  // namespace palpate
