// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "whole_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>

namespace palpate {
namespace {

/// Where a path leads, through links that lead somewhere.
std::string placeOf(const std::string& path) {
  std::error_code failed;
  const std::filesystem::path place = std::filesystem::canonical(path, failed);
  return failed ? path : place.string();
}

[[noreturn]] void refuse(const std::string& path) {
  throw std::runtime_error(path + " cannot be written: " + std::strerror(errno));
}

}  // namespace

void replaceFile(const std::string& path, const std::function<void(const std::string&)>& write) {
  const std::string place = placeOf(path);
  const std::string partial = place + "." + std::to_string(std::random_device()()) + ".part";
  try {
    write(partial);
    if (std::rename(partial.c_str(), place.c_str()) != 0) refuse(path);
  } catch (...) {
    std::remove(partial.c_str());
    throw;
  }
}

void writeWholeFile(const std::string& path, const std::function<void(std::ostream&)>& write) {
  replaceFile(path, [&](const std::string& partial) {
    errno = 0;
    std::ofstream file(partial, std::ios::binary);
    if (file) write(file);
    file.close();
    if (!file) refuse(path);
  });
}

}  // namespace palpate
