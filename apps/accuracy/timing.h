// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <chrono>
#include <ctime>
#include <new>
#include <stdexcept>
#include <string>

#include "progress.h"

namespace palpate::app {

inline double wallSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// By the wall clock, or of the processor, of all threads.
inline double secondsBy(bool isProcessor) {
  if (!isProcessor) return wallSeconds();
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// What is wrong with a setting that this body is too hard for.
template <class Work>
std::string failureOf(const Work& work) {
  try {
    work();
  } catch (const Aborted&) {
    throw;
  } catch (const std::bad_alloc&) {
    return "there is not enough memory";
  } catch (const std::runtime_error& failure) {
    return failure.what();
  }
  return {};
}

}  // namespace palpate::app
