// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/servo_clock.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <cerrno>
#include <ctime>

namespace palpate {

static std::int64_t read(clockid_t clock) noexcept {
  timespec time;
  clock_gettime(clock, &time);
  return std::int64_t{1000000000} * time.tv_sec + time.tv_nsec;
}

std::int64_t nowNanoseconds() noexcept {
  return read(CLOCK_MONOTONIC);
}

std::int64_t threadNanoseconds() noexcept {
  return read(CLOCK_THREAD_CPUTIME_ID);
}

void sleepUntil(std::int64_t nanoseconds) noexcept {
  timespec time;
  time.tv_sec = static_cast<std::time_t>(nanoseconds / 1000000000);
  time.tv_nsec = static_cast<long>(nanoseconds % 1000000000);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR) continue;
}

/// Stack pages that a tick may touch are there before they are locked.
static void touchStack() noexcept {
  volatile unsigned char stack[64 * 1024];
  for (std::size_t i = 0; i < sizeof stack; i += 4096) stack[i] = 0;
}

bool preferRealTime(int processor) noexcept {
  touchStack();
  // Not MCL_FUTURE: under a limit on locked memory, other threads' later allocations would fail.
  mlockall(MCL_CURRENT);
  prctl(PR_SET_TIMERSLACK, 1UL);
  if (processor >= 0 && processor < CPU_SETSIZE) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(processor, &set);
    pthread_setaffinity_np(pthread_self(), sizeof set, &set);
  }
  sched_param priority{};
  priority.sched_priority = sched_get_priority_max(SCHED_FIFO) - 20;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority) == 0;
}

}  // namespace palpate
