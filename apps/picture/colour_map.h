// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

namespace palpate::app {

/// Every 32nd entry, and the last, of Matplotlib's "viridis" (S. van der Walt and N. Smith, CC0): a
/// perceptually uniform map from dark blue to yellow. Red, green, blue.
constexpr double kViridis[9][3] = {
    {0.267004, 0.004874, 0.329415}, {0.278826, 0.175490, 0.483397}, {0.229739, 0.322361, 0.545706},
    {0.172719, 0.448791, 0.557885}, {0.127568, 0.566949, 0.550556}, {0.157851, 0.683765, 0.501686},
    {0.369214, 0.788888, 0.382914}, {0.678489, 0.863742, 0.189503}, {0.993248, 0.906157, 0.143936}};

}  // namespace palpate::app
