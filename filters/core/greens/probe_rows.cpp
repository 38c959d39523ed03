// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/probe_rows.h"

#include <utility>

#include "sentence.h"

namespace palpate {

ProbedField fieldOf(const ProbeValues& values, double shearModulus) {
  ProbedField field;
  field.displacement = values.head<3>();
  field.gradient = values.segment<9>(3).reshaped<Eigen::RowMajor>(3, 3);
  const Eigen::Matrix3d strain = field.strain();
  field.stress = 2 * shearModulus * strain;
  field.stress.diagonal().array() += values[12] - 2 * shearModulus * strain.trace() / 3;
  return field;
}

ProbeRows::ProbeRows(Eigen::MatrixXd rows, double shearModulus)
    : rows_(std::move(rows)), shearModulus_(shearModulus) {
  if (rows_.rows() % 13 != 0 || rows_.cols() % 3 != 0)
    refuse("rows of probes are 13 a point and 3 a node, not ", rows_.rows(), " by ", rows_.cols());
}

}  // namespace palpate
