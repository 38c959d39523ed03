// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/lock_count.h"

#include <dlfcn.h>
#include <pthread.h>
#include <cstddef>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define PALPATE_COUNT_LOCKS
#endif

namespace {
thread_local long locks = 0, exceptions = 0;
}  // namespace

#if defined(PALPATE_COUNT_LOCKS)
namespace {
template <class Function>
Function* next(Function*, const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}
}  // namespace

// Stands before the C library's function of that name, counts, and calls it.
#define PALPATE_COUNTED(name, parameters, arguments) \
  extern "C" int name parameters {                   \
    static const auto original = next(&name, #name); \
    ++locks;                                         \
    return original arguments;                       \
  }
PALPATE_COUNTED(pthread_mutex_lock, (pthread_mutex_t * mutex) noexcept, (mutex))
PALPATE_COUNTED(pthread_rwlock_rdlock, (pthread_rwlock_t * lock) noexcept, (lock))
PALPATE_COUNTED(pthread_rwlock_wrlock, (pthread_rwlock_t * lock) noexcept, (lock))
PALPATE_COUNTED(pthread_spin_lock, (pthread_spinlock_t * lock) noexcept, (lock))
PALPATE_COUNTED(pthread_cond_wait, (pthread_cond_t * condition, pthread_mutex_t* mutex),
                (condition, mutex))

extern "C" void* __cxa_allocate_exception(std::size_t size) noexcept {
  static const auto original = next(&__cxa_allocate_exception, "__cxa_allocate_exception");
  ++exceptions;
  return original(size);
}
#endif

namespace palpate::test {

long lockCount() {
  return locks;
}

long exceptionCount() {
  return exceptions;
}

bool locksAreCounted() {
#if defined(PALPATE_COUNT_LOCKS)
  return true;
#else
  return false;
#endif
}

}  // namespace palpate::test
