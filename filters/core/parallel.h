// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <functional>

namespace palpate {

/// Number of threads to use: `wanted` if positive, else the machine's number of cores.
int threadCount(int wanted);

/// Runs task(item, thread) for item = 0 .. count - 1 on `threads` threads, the caller being thread
/// 0.
/// @param whileRunning  called by the caller's thread after each of its items, with the number of
///                      items begun so far; what it throws stops all threads.
/// @throws the first exception that a task or `whileRunning` threw, after all threads have stopped.
void parallelFor(int count, int threads, const std::function<void(int item, int thread)>& task,
                 const std::function<void(int begun)>& whileRunning = {});

}  // namespace palpate
