// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace palpate {

int threadCount(int wanted) {
  return wanted > 0 ? wanted : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void parallelFor(int count, int threads, const std::function<void(int, int)>& task,
                 const std::function<void(int)>& whileRunning) {
  std::atomic<int> next{0};
  std::atomic<bool> stopped{false};
  std::exception_ptr failure;
  std::mutex failureLock;
  const auto work = [&](int thread) {
    try {
      for (int item; !stopped && (item = next++) < count;) {
        task(item, thread);
        if (thread == 0 && whileRunning) whileRunning(std::min(next.load(), count));
      }
    } catch (...) {
      const std::lock_guard<std::mutex> guard(failureLock);
      if (!failure) failure = std::current_exception();
      stopped = true;
    }
  };
  std::vector<std::thread> others;
  try {
    for (int thread = 1; thread < std::min(threads, count); ++thread)
      others.emplace_back(work, thread);
  } catch (const std::system_error&) {
    // The system grants no more threads: those there are do all the work.
  }
  work(0);
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace palpate
