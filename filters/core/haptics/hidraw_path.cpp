// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/hidraw_path.h"

#include <dirent.h>

#include <cstdio>
#include <fstream>
#include <vector>

namespace palpate {
namespace {

const std::string kNodes = "/sys/class/hidraw";

std::vector<std::string> nodes() {
  std::vector<std::string> names;
  DIR* folder = opendir(kNodes.c_str());
  if (!folder) return names;
  while (const dirent* entry = readdir(folder))
    if (entry->d_name[0] != '.') names.emplace_back(entry->d_name);
  closedir(folder);
  return names;
}

/// What a node's uevent and interface say, which may be nothing: it may be leaving.
HidRecord identityOf(const std::string& node) {
  HidRecord record;
  record.path = "/dev/" + node;
  const std::string device = kNodes + "/" + node + "/device";
  std::ifstream uevent(device + "/uevent");
  for (std::string line; std::getline(uevent, line);) {
    unsigned vendor, product;
    if (std::sscanf(line.c_str(), "HID_ID=%*x:%x:%x", &vendor, &product) == 2) {
      record.vendor = static_cast<std::uint16_t>(vendor);
      record.product = static_cast<std::uint16_t>(product);
    } else if (line.rfind("HID_UNIQ=", 0) == 0) {
      record.serial = line.substr(9);
    }
  }
  std::ifstream interface(device + "/../bInterfaceNumber");
  interface >> std::hex >> record.interface;
  if (!interface) record.interface = -1;
  return record;
}

}  // namespace

std::string hidrawPathOf(const HidRecord& record) {
  std::string path;
  for (const std::string& node : nodes()) {
    const HidRecord found = identityOf(node);
    if (found.vendor != record.vendor || found.product != record.product ||
        found.serial != record.serial || found.interface != record.interface)
      continue;
    if (path.empty() || found.path == record.path) path = found.path;
  }
  return path;
}

}  // namespace palpate
