// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>

#include "greens/probe_rows.h"

namespace palpate {

/// The same points and materials with other rows.
/// @param rows  13 #points by 3 #nodes, as of ProbeRows.
std::shared_ptr<const ProbeRows> withRows(const ProbeRows& probes, Eigen::MatrixXd rows);

}  // namespace palpate
