// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/identification_knobs.h"

#include <cmath>

#include "accuracy/knobs.h"
#include "accuracy/tetrahedra.h"
#include "terminal.h"

namespace palpate::app {
namespace {

const char* const kLosses[] = {"none", "huber", "cauchy", "tukey"};
constexpr int kFieldModes[] = {5, 10, 20, 40, 80}, kCorrectionModes[] = {10, 20, 40, 80, 0};
constexpr int kFinestTolerance = 6;  ///< negative power of ten

std::vector<std::string> knownKnobs(bool hasBothMethods) {
  std::vector<std::string> knobs{"level", "loss", "interpolation"};
  if (canUseTetrahedra() && hasBothMethods) knobs.push_back("elements");
  if (canUseTetrahedra()) knobs.push_back("field");
  knobs.push_back("correction");
  return knobs;
}

void addKnob(const std::string& knob, const IdentificationSetting& base,
             const std::vector<int>& levels, std::vector<IdentificationTrial>& trials) {
  const auto add = [&](const std::string& value, const IdentificationSetting& setting,
                       const std::string& series) {
    trials.push_back({knob, value, series, setting});
  };
  IdentificationSetting setting = base;
  if (knob == "level")
    for (int level : levels) {
      setting.level = level;
      add(std::to_string(level), setting, "level, all else as by default");
    }
  if (knob == "loss")
    for (RobustLoss loss :
         {RobustLoss::None, RobustLoss::Huber, RobustLoss::Cauchy, RobustLoss::Tukey}) {
      setting.loss = loss;
      add(kLosses[static_cast<int>(loss)], setting, knob);
    }
  if (knob == "interpolation")
    for (int power = 1; power <= kFinestTolerance; ++power) {
      setting.tolerance = std::pow(10.0, -power);
      add(number(setting.tolerance), setting, knob);
    }
  if (knob == "elements")
    for (int level : levels) {
      setting.level = level;
      setting.isFinite = !base.isFinite;
      const std::string name = setting.isFinite ? "finite elements" : "boundary elements";
      add(name, setting, knob + ": " + name);
    }
  if (knob == "field")
    for (int modes : kFieldModes) {
      setting.isFinite = true;
      setting.fieldModes = modes;
      add(std::to_string(modes), setting, "modes of a field");
    }
  if (knob == "correction")
    for (int modes : kCorrectionModes) {
      setting.correctionModes = modes;
      add(modes == 0 ? "all" : std::to_string(modes), setting, "modes of a correction");
    }
}

}  // namespace

std::vector<IdentificationTrial> identificationTrials(const std::vector<std::string>& chosen,
                                                      const IdentificationSetting& base,
                                                      const std::vector<int>& levels,
                                                      bool hasBothMethods) {
  const std::vector<std::string> known = knownKnobs(hasBothMethods);
  requireKnown(chosen, known, "the query identification");
  std::vector<IdentificationTrial> trials;
  for (const std::string& knob : chosen.empty() ? known : chosen)
    addKnob(knob, base, levels, trials);
  return trials;
}

}  // namespace palpate::app
