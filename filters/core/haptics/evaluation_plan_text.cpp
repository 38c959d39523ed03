// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <cmath>
#include <iomanip>
#include <iterator>
#include <sstream>

#include "haptics/evaluation_plan.h"

namespace palpate {
namespace {

/// With three digits and a prefix.
std::string engineering(double value) {
  static constexpr const char* kPrefixes[] = {"", "k", "M", "G", "T", "P"};
  std::size_t prefix = 0;
  while (std::abs(value) >= 999.5 && prefix + 1 < std::size(kPrefixes)) {
    value /= 1000;
    ++prefix;
  }
  std::ostringstream text;
  text << std::setprecision(3) << value << (*kPrefixes[prefix] ? " " : "") << kPrefixes[prefix];
  return text.str();
}

constexpr int kNameWidth = 42, kNumberWidth = 10;

void writeTable(std::ostringstream& text, const std::string& title,
                const std::vector<PlannedWork>& list) {
  text << std::left << std::setw(kNameWidth) << title << std::right;
  for (const char* head : {"rows", "columns", "flops", "bytes"})
    text << std::setw(kNumberWidth) << head;
  text << '\n';
  const auto write = [&](const PlannedWork& work) {
    text << std::left << std::setw(kNameWidth) << "  " + work.what << std::right;
    for (const double number : {work.rows, work.columns, work.flops, work.bytes})
      text << std::setw(kNumberWidth) << (number > 0 ? engineering(number) : "-");
    text << '\n';
  };
  if (list.empty()) text << "  nothing\n";
  for (const PlannedWork& work : list) write(work);
  if (list.size() > 1) {
    PlannedWork sum = total(list);
    sum.rows = sum.columns = 0;
    write(sum);
  }
}

}  // namespace

std::string toText(const EvaluationPlan& plan) {
  std::ostringstream text;
  text << engineering(plan.loaded) << " nodes under forces";
  if (plan.watched > 0) text << ", " << engineering(plan.watched) << " watched";
  if (const RehearsedTouch& rehearsed = plan.rehearsed; rehearsed.strokes > 0)
    text << "; a tick's work as counted in " << rehearsed.strokes << " strokes over the model,\n"
         << RehearsalSettings::kStrokeTicks - RehearsalSettings::kSinkingTicks << " ticks each, at "
         << std::setprecision(3) << rehearsed.speed << " m/s and " << rehearsed.depth
         << " m deep: its mean to " << std::ceil(100 * rehearsed.error) << " % (standard error)";
  text << "\n\n";
  if (!plan.setup.empty()) {
    writeTable(text, "once", plan.setup);
    text << '\n';
  }
  writeTable(text, "a tick, " + engineering(plan.rate) + " a second", plan.tick);
  text << '\n';
  writeTable(text, "a frame", plan.frame);
  text << "\nmemory\n";
  for (const PlannedMemory& entry : plan.memory)
    text << std::left << std::setw(kNameWidth) << "  " + entry.what << std::right
         << std::setw(4 * kNumberWidth) << engineering(entry.bytes) + "B" << '\n';
  text << std::left << std::setw(kNameWidth) << "  together" << std::right
       << std::setw(4 * kNumberWidth) << engineering(totalBytes(plan.memory)) + "B" << '\n';
  return text.str();
}

}  // namespace palpate
