// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "process_memory.h"

#include <malloc.h>

#include <fstream>
#include <string>

namespace palpate {
namespace {

/// A line of /proc/self/status, in kibibytes there.
std::size_t statusBytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  std::string word;
  std::size_t value = 0;
  while (status >> word)
    if (word == name && status >> value) return 1024 * value;
  return 0;
}

}  // namespace

std::size_t startPeakMemory() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;
  return statusBytes("VmRSS:");
}

std::size_t peakMemory() {
  return statusBytes("VmHWM:");
}

}  // namespace palpate
