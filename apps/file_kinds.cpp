// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "file_kinds.h"

#include <CLI/StringTools.hpp>
#include <filesystem>

namespace palpate::app {

std::string endingOf(const std::string& path) {
  return CLI::detail::to_lower(std::filesystem::path(path).extension().string());
}

bool isVolumeFile(const std::string& path) {
  const std::string ending = endingOf(path);
  return ending == ".vtu" || ending == ".vtk";
}

bool isTableInArrays(const std::string& path) {
  const std::string ending = endingOf(path);
  return ending == ".vtp" || ending == ".vtu";
}

}  // namespace palpate::app
