// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "identification/least_squares.h"

namespace palpate::app {

/// One way from measurements to a model.
struct IdentificationSetting {
  int level = 1;
  bool isFinite = false;  ///< by finite elements, else by boundary elements
  RobustLoss loss = RobustLoss::Cauchy;
  double tolerance = 1e-4;   ///< of interpolated responses
  int fieldModes = 0;        ///< of a stiffness that varies inside; 0 for one material
  int correctionModes = -1;  ///< of a correction of the model; 0 for all, -1 for none

  auto key() const {
    return std::tuple(level, isFinite, loss, tolerance, fieldModes, correctionModes);
  }
};

/// A value of a knob that is tried.
struct IdentificationTrial {
  std::string knob, value, series;
  IdentificationSetting setting;
};

/// @param chosen          empty for all that there are.
/// @param hasBothMethods  whether boundary elements and finite elements can be compared.
/// @throws std::invalid_argument for a knob that there is not.
std::vector<IdentificationTrial> identificationTrials(const std::vector<std::string>& chosen,
                                                      const IdentificationSetting& base,
                                                      const std::vector<int>& levels,
                                                      bool hasBothMethods);

}  // namespace palpate::app
