// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/replaced_rows.h"

#include <utility>

namespace palpate {

std::shared_ptr<const ProbeRows> withRows(const ProbeRows& probes, Eigen::MatrixXd rows) {
  std::vector<Matrix6d> stiffness;
  for (int point = 0; point < probes.count(); ++point) stiffness.push_back(probes.stiffness(point));
  return std::make_shared<const ProbeRows>(probes.points(), std::move(rows), std::move(stiffness));
}

}  // namespace palpate
