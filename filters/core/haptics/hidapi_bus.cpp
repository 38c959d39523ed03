// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The only source that knows hidapi. Its library is loaded when a device is first asked for.

#include <dlfcn.h>
#include <hidapi.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <cwchar>
#include <fstream>
#include <iterator>
#include <mutex>
#include <stdexcept>

#include "haptics/hid_bus.h"

namespace palpate {
namespace {

constexpr const char* kLibrary = "libhidapi-hidraw.so.0";

/// hidapi's functions. It is never unloaded.
struct Hidapi {
  decltype(&::hid_init) init;
  decltype(&::hid_enumerate) enumerate;
  decltype(&::hid_free_enumeration) freeEnumeration;
  decltype(&::hid_open_path) openPath;
  decltype(&::hid_close) close;
  decltype(&::hid_read_timeout) readTimeout;
  decltype(&::hid_write) write;
  decltype(&::hid_send_feature_report) sendFeature;
  decltype(&::hid_get_feature_report) getFeature;
};

template <class Function>
void load(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (!function)
    throw std::runtime_error(std::string("this version of ") + kLibrary + " has no " + name);
}

Hidapi loadHidapi() {
  void* library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  if (!library)
    throw std::runtime_error(
        std::string("HID devices need the library hidapi (Debian: libhidapi-hidraw0): ") +
        dlerror());
  Hidapi api;
  load(library, "hid_init", api.init);
  load(library, "hid_enumerate", api.enumerate);
  load(library, "hid_free_enumeration", api.freeEnumeration);
  load(library, "hid_open_path", api.openPath);
  load(library, "hid_close", api.close);
  load(library, "hid_read_timeout", api.readTimeout);
  load(library, "hid_write", api.write);
  load(library, "hid_send_feature_report", api.sendFeature);
  load(library, "hid_get_feature_report", api.getFeature);
  if (api.init() != 0) throw std::runtime_error("hidapi does not start");
  return api;
}

const Hidapi& hidapi() {
  static const Hidapi api = loadHidapi();
  return api;
}

/// hidapi keeps an error message of its own for whatever is not done with an open device.
std::mutex& mutexOfHidapi() {
  static std::mutex mutex;
  return mutex;
}

class HidapiTransport final : public HidTransport {
 public:
  explicit HidapiTransport(hid_device* device) : device_(device) {}
  ~HidapiTransport() override {
    const std::lock_guard<std::mutex> lock(mutexOfHidapi());
    hidapi().close(device_);
  }

  int read(std::uint8_t* bytes, std::size_t room, int milliseconds) noexcept override {
    return hidapi().readTimeout(device_, bytes, room, milliseconds);
  }
  bool write(const std::uint8_t* bytes, std::size_t count) noexcept override {
    return hidapi().write(device_, bytes, count) >= 0;
  }
  bool setFeature(const std::uint8_t* bytes, std::size_t count) noexcept override {
    return hidapi().sendFeature(device_, bytes, count) >= 0;
  }
  int getFeature(std::uint8_t* bytes, std::size_t room) noexcept override {
    return hidapi().getFeature(device_, bytes, room);
  }

 private:
  hid_device* device_;
};

/// UTF-8 of a device's string, without control characters.
std::string textOf(const wchar_t* wide) {
  std::string text;
  for (; wide && *wide; ++wide) {
    const auto c = static_cast<std::uint32_t>(*wide);
    if (c < 0x20 || c == 0x7f) continue;
    if (c < 0x80) {
      text += static_cast<char>(c);
    } else if (c < 0x800) {
      text += static_cast<char>(0xc0 | (c >> 6));
      text += static_cast<char>(0x80 | (c & 0x3f));
    } else if (c < 0x10000) {
      text += static_cast<char>(0xe0 | (c >> 12));
      text += static_cast<char>(0x80 | ((c >> 6) & 0x3f));
      text += static_cast<char>(0x80 | (c & 0x3f));
    }
  }
  return text;
}

/// hidapi tells the descriptor from 0.14 on, and only of open devices; the system tells it anyone.
std::vector<std::uint8_t> descriptorOf(const std::string& path) {
  const std::string node = path.substr(path.rfind('/') + 1);
  std::ifstream file("/sys/class/hidraw/" + node + "/device/report_descriptor", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

HidRecord recordOf(const hid_device_info& info) {
  HidRecord record;
  record.path = info.path;
  record.manufacturer = textOf(info.manufacturer_string);
  record.name = textOf(info.product_string);
  record.serial = textOf(info.serial_number);
  record.vendor = info.vendor_id;
  record.product = info.product_id;
  record.interface = info.interface_number;
  record.descriptor = descriptorOf(record.path);
  return record;
}

}  // namespace

std::vector<HidRecord> listHidDevices() {
  const Hidapi& api = hidapi();
  const std::lock_guard<std::mutex> lock(mutexOfHidapi());
  const std::unique_ptr<hid_device_info, decltype(&::hid_free_enumeration)> first(
      api.enumerate(0, 0), api.freeEnumeration);
  std::vector<HidRecord> records;
  // hidapi lists a device once for each of its top-level collections.
  for (const hid_device_info* info = first.get(); info; info = info->next) {
    if (!info->path) continue;
    auto record = std::find_if(records.begin(), records.end(),
                               [&](const HidRecord& known) { return known.path == info->path; });
    if (record == records.end()) record = records.insert(record, recordOf(*info));
    record->usages.push_back(hidUsage(info->usage_page, info->usage));
  }
  return records;
}

std::unique_ptr<HidTransport> openHidTransport(const std::string& path) {
  const Hidapi& api = hidapi();
  const std::lock_guard<std::mutex> lock(mutexOfHidapi());
  errno = 0;
  hid_device* device = api.openPath(path.c_str());
  if (!device && errno == EACCES)
    throw std::runtime_error("'" + path +
                             "' may not be opened: a udev rule must give this user the right to");
  if (!device) throw std::runtime_error("'" + path + "' cannot be opened: " + std::strerror(errno));
  return std::make_unique<HidapiTransport>(device);
}

}  // namespace palpate
