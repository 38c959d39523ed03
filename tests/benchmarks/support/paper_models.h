// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>

#include "model/elastic_model.h"

namespace palpate::bench {

/// A model of data/ as one patch, its control mesh refined `steps` times.
/// @param name  of the file, without its suffix.
/// @throws std::runtime_error if it cannot be read.
ElasticModel paperModel(const std::string& name, int steps);

}  // namespace palpate::bench
