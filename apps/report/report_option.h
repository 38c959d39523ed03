// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "stopwatch.h"

namespace CLI {
class App;
}

namespace palpate::app {

/// What was asked for, for a page to say.
struct RunDescription {
  std::vector<std::pair<std::string, std::string>> settings;  ///< options and their values
  double seconds = 0;                                         ///< since the program began

  /// Of an option by its name; empty where it has none.
  std::string operator[](const std::string& option) const;
};

/// The option --report of a subcommand, and its page.
class ReportOption {
 public:
  /// @param what  is on the page.
  void addTo(CLI::App& command, const std::string& what);

  /// Writes the page, if it is asked for, whole or not at all.
  /// @throws what `page` throws; std::runtime_error if it cannot be written.
  void write(const std::function<std::string(const RunDescription&)>& page) const;

 private:
  RunDescription described() const;

  const CLI::App* command_ = nullptr;
  std::string path_;
  Stopwatch sinceStart_;
};

}  // namespace palpate::app
