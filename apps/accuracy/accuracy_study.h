// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "accuracy/quartiles.h"
#include "accuracy/settings.h"

namespace palpate::app {

/// A trial and what came of it.
struct TrialResult {
  Trial trial;
  int vertices = 0, columns = 0, runs = 0;
  double error = 0;        ///< relative, against the reference
  double uncertainty = 0;  ///< of the reference
  double knobError = 0;  ///< against the knob at its most accurate; NaN where it has no such value
  Quartiles precompute, query;  ///< s
  Quartiles peakBytes;
  std::size_t storedBytes = 0;
  bool isOnFront = false;
  std::string failure;  ///< why there is no answer; empty otherwise

  bool isBelowCertainty() const { return error < uncertainty; }
  /// The time that the knob changes.
  const Quartiles& time() const { return trial.isPrecompute ? precompute : query; }
};

/// Error against time, of every knob of one query on one body.
struct AccuracyStudy {
  std::string body, method, reference, error;  ///< in words
  QueryKind query = QueryKind::Compliance;
  bool isIdentification = false;  ///< what is timed, in place of a precomputation and its query
  std::vector<std::array<double, 3>> points;  ///< on the finest level, m; none of a point source
  double radius = 0, ballRadius = 0, depth = 0;
  double uncertainty = 0;  ///< of the reference at the base's radius
  int baseLevel = 1;
  std::string clock;
  std::vector<TrialResult> results;
};

/// Marks what nothing beats of the trials whose time is that of one stage.
void markFront(std::vector<TrialResult>& results, bool isPrecompute);

/// @throws std::invalid_argument or std::runtime_error with a sentence.
AccuracyStudy studyAccuracy(const AccuracyOptions& options);

/// Its table, a line a trial.
std::string accuracyCsv(const AccuracyStudy& study);
/// Its plot, as a file's whole text or an element of a page.
std::string accuracySvg(const AccuracyStudy& study, bool isFile);
/// The same as a picture.
void drawAccuracy(const AccuracyStudy& study, const std::string& path);
/// All of it, as one page.
std::string accuracyPage(const AccuracyStudy& study);

}  // namespace palpate::app
