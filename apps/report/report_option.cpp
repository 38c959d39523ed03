// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/report_option.h"

#include <algorithm>
#include <CLI/CLI.hpp>
#include <ostream>

#include "terminal.h"
#include "whole_file.h"

namespace palpate::app {

std::string RunDescription::operator[](const std::string& option) const {
  for (const auto& [name, value] : settings)
    if (name == option) return value;
  return {};
}

void ReportOption::addTo(CLI::App& command, const std::string& what) {
  command_ = &command;
  requireWritable(command.add_option("--report", path_, "A page of " + what + ", .html"), "reports",
                  ".html");
}

void ReportOption::write(const std::function<std::string(const RunDescription&)>& page) const {
  if (path_.empty()) return;
  const std::string text = page(described());
  writeWholeFile(path_, [&](std::ostream& file) { file << text; });
}

RunDescription ReportOption::described() const {
  RunDescription run;
  run.seconds = Stopwatch(sinceStart_).seconds();
  for (const CLI::Option* option : command_->get_options()) {
    const auto needed = option->get_needs();
    const bool isIdle = std::any_of(needed.begin(), needed.end(),
                                    [](const CLI::Option* other) { return other->count() == 0; });
    if (isIdle) continue;
    std::string value;
    for (const std::string& part : option->results()) value += (value.empty() ? "" : " ") + part;
    if (option->count() == 0) value = option->get_default_str();
    if (!value.empty()) run.settings.emplace_back(option->get_name(), value);
  }
  return run;
}

}  // namespace palpate::app
