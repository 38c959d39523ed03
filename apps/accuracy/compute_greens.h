// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <memory>

#include "accuracy/query.h"
#include "greens/computed_greens_functions.h"

namespace palpate::app {

/// Green's functions as a setting wants them, ready to be asked, and what they took.
struct MadeGreens {
  std::shared_ptr<const GreensFunctions> greens, asFloat;  ///< the latter null unless asked for
  std::size_t peakBytes = 0, bytes = 0, floatBytes = 0;
};

/// Keeps the time of nothing but the method itself: `made` is called between that and copies.
/// @param wantsFloat  a copy in floats, too; of those that have a matrix.
/// @param progress    of the computation alone.
/// @param made        called when the method is done.
/// @throws as the method.
MadeGreens computeGreens(const BodyLevels& body, const Query& query, const Setting& setting,
                         int threads, bool wantsFloat, const ProgressCallback& progress,
                         const std::function<void()>& made = {});

}  // namespace palpate::app
