// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "accuracy/accuracy_study.h"

namespace palpate::app {

/// Error against time of identifications of one surface, from what a rig would measure of a model
/// that is known: how wrong displacements under other probes are.
/// @throws std::invalid_argument or std::runtime_error with a sentence.
AccuracyStudy studyIdentification(const AccuracyOptions& options);

}  // namespace palpate::app
