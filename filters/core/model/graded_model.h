// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "model/elastic_model.h"

namespace palpate {

/// The model on a mesh with layers along the rim of its support (gradeTowardsSupport), whose first
/// vertices are the model's.
ElasticModel gradedModel(const ElasticModel& model, int layers);

}  // namespace palpate
