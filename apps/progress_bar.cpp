// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "progress_bar.h"

#include <unistd.h>

#include <cmath>
#include <iomanip>
#include <iostream>
#include <string>

namespace palpate::app {
namespace {

bool barUnderWay = false;

}  // namespace

bool drawProgress(double fraction, const char* stage) {
  if (!isatty(STDERR_FILENO)) return true;
  constexpr int width = 40;
  const int done = static_cast<int>(std::lround(width * fraction));
  std::cerr << "\r" << std::left << std::setw(10) << (stage ? stage : "") << " ["
            << std::string(done, '#') << std::string(width - done, '.') << "] " << std::right
            << std::setw(3) << std::lround(100 * fraction) << " %" << std::flush;
  barUnderWay = true;
  return true;
}

void endProgressBar() {
  if (barUnderWay) std::cerr << std::endl;
  barUnderWay = false;
}

}  // namespace palpate::app
