// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <map>

#include "accuracy/query.h"

namespace palpate::app {

/// What was seen of a setting.
struct Sample {
  Answer answer;
  std::vector<double> precomputeSeconds, querySeconds;  ///< a run each
  std::size_t peakBytes = 0, storedBytes = 0;
  int columns = 0;
  std::string failure;  ///< why there is no answer
};

struct SweepOptions {
  int repeats = 5, threads = 0;
  double budget = 60;  ///< s
  bool cpuClock = false;
};

/// Runs settings in turn, and all of them again in every round, so that a machine that slows down
/// biases none. The first two rounds are of all; later ones leave out what has taken its budget.
class Sweep {
 public:
  /// @throws Aborted.
  Sweep(const BodyLevels& body, const Query& query, const std::vector<Setting>& settings,
        const SweepOptions& options, const Progress& progress);

  const Sample& of(const Setting& setting) const { return samples_.at(setting.key()); }

 private:
  /// Settings that share their Green's functions.
  struct Group {
    std::vector<Setting> settings;
    double spent = 0, cost = 0;  ///< s, and a guess of it in any unit
    bool hasFailed = false;
  };
  void runGroup(Group& group, const Progress& progress);
  void ask(const Setting& setting, std::shared_ptr<const GreensFunctions> greens, std::size_t bytes,
           double seconds);
  double now() const;

  const BodyLevels& body_;
  const Query& query_;
  SweepOptions options_;
  std::map<decltype(Setting().precomputeKey()), Group> groups_;
  std::map<decltype(Setting().key()), Sample> samples_;
};

}  // namespace palpate::app
