// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <cmath>

#include "accuracy/accuracy_study.h"
#include "report/csv.h"

namespace palpate::app {

using csv::field;
using csv::quoted;

namespace {

std::string stageOf(const AccuracyStudy& study, const TrialResult& result) {
  return study.isIdentification ? "identify" : result.trial.isPrecompute ? "precompute" : "query";
}

std::string whole(double bytes) {
  return std::to_string(std::llround(bytes));
}

}  // namespace

std::string accuracyCsv(const AccuracyStudy& study) {
  std::string text =
      "knob,value,level,vertices,columns,stage,error,below_certainty,reference_uncertainty,"
      "knob_error,pareto_front,precompute_s,precompute_s_lower_quartile,"
      "precompute_s_upper_quartile,query_s,query_s_lower_quartile,query_s_upper_quartile,runs,"
      "peak_bytes,peak_bytes_lower_quartile,peak_bytes_upper_quartile,stored_bytes,clock,reference,"
      "failure\n";
  for (const TrialResult& result : study.results) {
    const bool isDone = result.failure.empty();
    const auto ifDone = [&](double value) { return field(isDone ? value : std::nan("")); };
    text += quoted(result.trial.knob) + "," + quoted(result.trial.value) + "," +
            std::to_string(result.trial.setting.level) + "," + std::to_string(result.vertices) +
            "," + std::to_string(result.columns) + "," + stageOf(study, result) +
            field(result.error) + "," + (isDone && result.isBelowCertainty() ? "1" : "0") +
            ifDone(result.uncertainty) + field(result.knobError) + "," +
            (result.isOnFront ? "1" : "0");
    for (const Quartiles& time : {result.precompute, result.query})
      for (double seconds : {time.median, time.lower, time.upper}) text += ifDone(seconds);
    text += "," + std::to_string(result.runs);
    const Quartiles& peak = result.peakBytes;
    for (double bytes : {peak.median, peak.lower, peak.upper}) text += "," + whole(bytes);
    text += "," + std::to_string(result.storedBytes) + "," + study.clock + "," +
            quoted(study.reference) + "," + quoted(result.failure) + "\n";
  }
  return text;
}

}  // namespace palpate::app
