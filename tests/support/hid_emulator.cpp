// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/hid_emulator.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <umockdev.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <stdexcept>

namespace palpate::test {
namespace {

struct Node {
  EmulatedModel model;
  int openError = 0, timesOpened = 0;
  int ours = -1, theirs = -1;  ///< ends of the socket; theirs is closed by whoever opened it
};

std::mutex mutex;
std::map<int, Node> nodes;

void cutOff(Node& node) {
  if (node.ours >= 0) close(node.ours);
  node.ours = node.theirs = -1;
}

/// The next report that was written to a node; empty if there is none.
HidEmulator::Bytes receive(const Node& node) {
  HidEmulator::Bytes report(4096);
  const ssize_t count = recv(node.ours, report.data(), report.size(), MSG_DONTWAIT);
  report.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  return report;
}

void drainOutputs(const Node& node) {
  if (!node.model.onOutput) return;
  for (HidEmulator::Bytes report = receive(node); !report.empty(); report = receive(node))
    node.model.onOutput(report);
}

int openNode(int number) {
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = nodes.find(number);
  if (found == nodes.end() || found->second.openError) {
    errno = found == nodes.end() ? ENOENT : found->second.openError;
    return -1;
  }
  Node& node = found->second;
  cutOff(node);
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) return -1;
  ++node.timesOpened;
  node.ours = ends[0];
  node.theirs = ends[1];
  return ends[1];
}

/// Answers hidraw's requests for a node that is open.
/// @return nothing if the file is no such node.
bool answer(int file, unsigned long request, void* argument, int& result) {
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = std::find_if(nodes.begin(), nodes.end(),
                                  [file](const auto& node) { return node.second.theirs == file; });
  if (found == nodes.end()) return false;
  drainOutputs(found->second);
  const EmulatedModel& model = found->second.model;
  auto* const bytes = static_cast<std::uint8_t*>(argument);
  const std::size_t size = _IOC_SIZE(request);
  result = 0;
  if (request == HIDIOCGRDESCSIZE) {
    *static_cast<int*>(argument) = static_cast<int>(model.descriptor.size());
  } else if (request == HIDIOCGRDESC) {
    auto* const descriptor = static_cast<hidraw_report_descriptor*>(argument);
    std::copy(model.descriptor.begin(), model.descriptor.end(), descriptor->value);
    descriptor->size = static_cast<std::uint32_t>(model.descriptor.size());
  } else if (_IOC_TYPE(request) == 'H' && _IOC_NR(request) == 6) {  // HIDIOCSFEATURE
    const bool isTaken = model.onSetFeature && model.onSetFeature({bytes, bytes + size});
    result = isTaken ? static_cast<int>(size) : -1;
  } else if (_IOC_TYPE(request) == 'H' && _IOC_NR(request) == 7) {  // HIDIOCGFEATURE
    const auto report = model.onGetFeature ? model.onGetFeature(bytes[0]) : HidEmulator::Bytes();
    result = report.empty() ? -1 : static_cast<int>(std::min(size, report.size()));
    std::copy_n(report.begin(), std::max(result, 0), bytes);
  } else {
    result = -1;
  }
  if (result < 0) errno = EPIPE;
  return true;
}

}  // namespace

struct HidEmulator::Testbed {
  UMockdevTestbed* mock = umockdev_testbed_new();
  int next = 0;
  std::map<int, std::string> roots;  ///< sysfs path of each device

  ~Testbed() { g_object_unref(mock); }
};

HidEmulator::HidEmulator() {
  const char* preloaded = std::getenv("LD_PRELOAD");
  if (!preloaded || !std::strstr(preloaded, "umockdev-preload"))
    throw std::runtime_error("run this program under umockdev-wrapper");
  testbed_ = std::make_unique<Testbed>();
}

HidEmulator::~HidEmulator() {
  const std::lock_guard<std::mutex> lock(mutex);
  for (auto& [number, node] : nodes) cutOff(node);
  nodes.clear();
}

int HidEmulator::plug(const EmulatedModel& model) {
  const int number = testbed_->next++;
  char ids[64];
  std::snprintf(ids, sizeof ids, "0003:%08X:%08X", model.vendor, model.product);
  char vendor[8], product[8];
  std::snprintf(vendor, sizeof vendor, "%04x", model.vendor);
  std::snprintf(product, sizeof product, "%04x", model.product);
  std::string descriptor;
  char digits[4];
  for (std::uint8_t byte : model.descriptor) {
    std::snprintf(digits, sizeof digits, "%02X", byte);
    descriptor += digits;
  }
  const std::string root = "/devices/" + std::to_string(number + 1) + "-1";
  const std::string interface = root + "/" + std::to_string(number + 1) + "-1:1.0";
  const std::string hid = interface + "/" + ids + "." + std::to_string(number);
  const std::string node = "hidraw" + std::to_string(number);
  const std::string records =
      "P: " + root + "\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nA: idVendor=" + vendor +
      "\nA: idProduct=" + product + "\nA: manufacturer=Emulated\nA: product=" + model.name +
      "\nA: serial=" + model.serial + "\nA: bcdDevice=0100\n\nP: " + interface +
      "\nE: DEVTYPE=usb_interface\nE: SUBSYSTEM=usb\nA: bInterfaceNumber=00\n\nP: " + hid +
      "\nE: SUBSYSTEM=hid\nE: HID_ID=" + ids + "\nE: HID_NAME=" + model.name +
      "\nE: HID_UNIQ=" + model.serial + "\nH: report_descriptor=" + descriptor + "\n\nP: " + hid +
      "/hidraw/" + node + "\nN: " + node + "\nE: DEVNAME=/dev/" + node +
      "\nE: SUBSYSTEM=hidraw\nL: device=../../../" + hid.substr(hid.rfind('/') + 1) + "\n\n";
  GError* error = nullptr;
  if (!umockdev_testbed_add_from_string(testbed_->mock, records.c_str(), &error))
    throw std::runtime_error(error->message);
  testbed_->roots[number] = "/sys" + root;
  const std::lock_guard<std::mutex> lock(mutex);
  nodes[number].model = model;
  return number;
}

void HidEmulator::unplug(int number) {
  {
    const std::lock_guard<std::mutex> lock(mutex);
    cutOff(nodes.at(number));
    nodes.erase(number);
  }
  umockdev_testbed_remove_device(testbed_->mock, testbed_->roots.at(number).c_str());
  testbed_->roots.erase(number);
}

void HidEmulator::reset(int number) {
  const std::lock_guard<std::mutex> lock(mutex);
  cutOff(nodes.at(number));
}

void HidEmulator::failToOpen(int number, int error) {
  const std::lock_guard<std::mutex> lock(mutex);
  nodes.at(number).openError = error;
}

bool HidEmulator::send(int number, const Bytes& report) {
  int file;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    file = nodes.at(number).ours;
  }
  return file >= 0 && ::send(file, report.data(), report.size(), MSG_NOSIGNAL | MSG_DONTWAIT) >= 0;
}

void HidEmulator::takeOutputs(int number) {
  const std::lock_guard<std::mutex> lock(mutex);
  drainOutputs(nodes.at(number));
}

HidEmulator::Bytes HidEmulator::nextOutput(int number) {
  const std::lock_guard<std::mutex> lock(mutex);
  return receive(nodes.at(number));
}

int HidEmulator::timesOpened(int number) const {
  const std::lock_guard<std::mutex> lock(mutex);
  return nodes.at(number).timesOpened;
}

}  // namespace palpate::test

// Found before the C library's by every library of the program, hidapi among them.
extern "C" {

int open(const char* path, int flags, ...) {
  using Open = int (*)(const char*, int, ...);
  static const Open next = reinterpret_cast<Open>(dlsym(RTLD_NEXT, "open"));
  int number = 0, end = 0;
  if (std::sscanf(path, "/dev/hidraw%d%n", &number, &end) == 1 && path[end] == '\0')
    return palpate::test::openNode(number);
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return next(path, flags, mode);
}

int ioctl(int file, unsigned long request, ...) {
  using Ioctl = int (*)(int, unsigned long, ...);
  static const Ioctl next = reinterpret_cast<Ioctl>(dlsym(RTLD_NEXT, "ioctl"));
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  int result;
  if (palpate::test::answer(file, request, argument, result)) return result;
  return next(file, request, argument);
}
}
