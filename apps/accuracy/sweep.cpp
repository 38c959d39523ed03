// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/sweep.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "accuracy/compute_greens.h"
#include "accuracy/timing.h"

namespace palpate::app {
namespace {

constexpr double kLeastTimed = 0.01;  ///< s: shorter queries are timed many at a time
constexpr int kLeastRuns = 2;

}  // namespace

Sweep::Sweep(const BodyLevels& body, const Query& query, const std::vector<Setting>& settings,
             const SweepOptions& options, const Progress& progress)
    : body_(body), query_(query), options_(options) {
  double cost = 0;
  for (const Setting& setting : settings) {
    if (!samples_.try_emplace(setting.key()).second) continue;
    Group& group = groups_[setting.precomputeKey()];
    group.settings.push_back(setting);
    group.cost = std::pow(body.mesh(setting.level).vertexCount(), 2.5);
  }
  for (const auto& group : groups_) cost += options.repeats * group.second.cost;
  double done = 0;
  for (int round = 0; round < options.repeats; ++round)
    for (auto& [key, group] : groups_) {
      const double share = group.cost / cost;
      const bool isWithinBudget = group.spent * (round + 1) <= options.budget * round;
      if (!group.hasFailed && (round < kLeastRuns || isWithinBudget))
        runGroup(group, progress.part(done, done + share));
      done += share;
    }
}

double Sweep::now() const {
  return secondsBy(options_.cpuClock);
}

void Sweep::runGroup(Group& group, const Progress& progress) {
  const Setting& first = group.settings.front();
  const double wall = wallSeconds(), begun = now();
  const std::string failure = failureOf([&] {
    const bool wantsFloat =
        std::any_of(group.settings.begin(), group.settings.end(),
                    [](const Setting& setting) { return setting.floatStorage; });
    double seconds = 0;
    const MadeGreens made = computeGreens(body_, query_, first, options_.threads, wantsFloat,
                                          progress.callback(), [&] { seconds = now() - begun; });
    for (const Setting& setting : group.settings) {
      Sample& sample = samples_.at(setting.key());
      sample.peakBytes = made.peakBytes;
      if (sample.failure.empty())
        sample.failure = failureOf([&] {
          ask(setting, setting.floatStorage ? made.asFloat : made.greens,
              setting.floatStorage ? made.floatBytes : made.bytes, seconds);
        });
    }
  });
  group.hasFailed = !failure.empty();
  for (const Setting& setting : group.settings)
    if (group.hasFailed) samples_.at(setting.key()).failure = failure;
  group.spent += wallSeconds() - wall;
}

void Sweep::ask(const Setting& setting, std::shared_ptr<const GreensFunctions> greens,
                std::size_t bytes, double seconds) {
  Sample& sample = samples_.at(setting.key());
  const auto query = query_.prepare(greens, setting);
  double begun = now();
  query->evaluate();
  const double once = now() - begun;
  const int runs = static_cast<int>(std::clamp(kLeastTimed / std::max(once, 1e-9), 1.0, 1e5));
  begun = now();
  for (int run = 0; run < runs; ++run) query->evaluate();
  sample.querySeconds.push_back((now() - begun) / runs);
  sample.precomputeSeconds.push_back(seconds);
  sample.answer = query->answer();
  if (!sample.answer.values.allFinite()) throw std::runtime_error("the answer is not finite");
  sample.storedBytes = bytes;
  sample.columns = greens->columnCount();
}

}  // namespace palpate::app
