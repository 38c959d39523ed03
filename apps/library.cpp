// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "library.h"

#include <dlfcn.h>
#include <unistd.h>

#include <climits>
#include <stdexcept>

namespace palpate::app {
namespace {

/// Folder of the running program, with a slash at its end.
std::string programFolder() {
  char path[PATH_MAX];
  const ssize_t length = readlink("/proc/self/exe", path, sizeof path);
  const std::string whole(path, length > 0 ? static_cast<std::size_t>(length) : 0);
  return whole.substr(0, whole.rfind('/') + 1);
}

}  // namespace

void* loadFunction(const std::string& library, const char* function, const std::string& purpose) {
  void* handle = nullptr;
  for (const std::string& folder : {programFolder() + "../lib/", std::string()}) {
    handle = dlopen((folder + library).c_str(), RTLD_NOW);
    if (handle) break;
  }
  void* found = handle ? dlsym(handle, function) : nullptr;
  if (!found) throw std::runtime_error(purpose + ": " + dlerror());
  return found;
}

}  // namespace palpate::app
