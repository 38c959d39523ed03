// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/pid_reports.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

constexpr std::uint16_t kPid = 0x0f, kGenericDesktop = 0x01;

// Reports and the collections in them.
constexpr std::uint16_t kSetEffect = 0x21, kSetConstantForce = 0x73, kEffectOperation = 0x77;
constexpr std::uint16_t kDeviceGainReport = 0x7d, kBlockLoad = 0x89, kCreateEffect = 0xab;
constexpr std::uint16_t kAxesEnable = 0x55;
// Fields and their values.
constexpr std::uint16_t kBlockIndex = 0x22, kConstantForce = 0x26, kMagnitude = 0x70;
constexpr std::uint16_t kDuration = 0x50, kGain = 0x52, kTriggerButton = 0x53;
constexpr std::uint16_t kDeviceGain = 0x7e, kStart = 0x79, kLoadSuccess = 0x8c;
constexpr std::uint16_t kEnableActuators = 0x97, kStopAll = 0x99, kReset = 0x9a;

constexpr std::uint32_t pid(std::uint16_t usage) {
  return hidUsage(kPid, usage);
}

/// Sets a field that chooses a usage, or the bit that stands for it.
void choose(const HidField& field, std::uint32_t usage, std::vector<std::uint8_t>& report) {
  std::int64_t value = 1;
  if (field.isSelector) {
    const auto chosen = std::find(field.usages.begin(), field.usages.end(), usage);
    value = field.least + (chosen - field.usages.begin());
  }
  writeHidField(field, value, report.data() + 1, report.size() - 1);
}

}  // namespace

bool PidOutput::isComplete(const HidDescriptor& descriptor) noexcept {
  try {
    PidOutput output(descriptor);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

const HidField& PidOutput::need(HidReportKind kind, std::uint16_t collection, std::uint32_t usage,
                                const char* what) const {
  const HidField* field = descriptor_.find(kind, collection == 0 ? 0 : pid(collection), usage);
  if (!field)
    throw std::invalid_argument(std::string("the device's force feedback describes no ") + what);
  return *field;
}

PidOutput::PidOutput(const HidDescriptor& descriptor)
    : descriptor_(descriptor),
      forceBlock_(need(HidReportKind::Output, kSetConstantForce, pid(kBlockIndex),
                       "block of a constant force")),
      forceMagnitude_(need(HidReportKind::Output, kSetConstantForce, pid(kMagnitude),
                           "magnitude of a constant force")) {
  if (forceMagnitude_.least >= 0 || forceMagnitude_.most <= 0)
    throw std::invalid_argument("the device's force feedback pulls only one way");
  forceBytes_ = empty(forceMagnitude_).size();
  for (int axis = 0; axis < 3; ++axis)
    if (descriptor_.find(HidReportKind::Output, pid(kAxesEnable),
                         hidUsage(kGenericDesktop, static_cast<std::uint16_t>(0x30 + axis))))
      axes_.push_back(axis);
  if (axes_.empty()) throw std::invalid_argument("the device's force feedback describes no axis");
  // What later reports need is missed here rather than there.
  createEffect();
  blockLoad();
  setEffect(1, axes_.front());
  startEffect(1);
  stopEffects();
  enableActuators();
  resetDevice();
}

PidOutput::Report PidOutput::empty(const HidField& field) const {
  Report report(1 + static_cast<std::size_t>(descriptor_.reportBytes(field.kind, field.report)));
  report[0] = field.report;
  return report;
}

PidOutput::Report PidOutput::createEffect() const {
  const HidField& type = need(HidReportKind::Feature, kCreateEffect, pid(kConstantForce),
                              "way to create a constant force");
  Report report = empty(type);
  choose(type, pid(kConstantForce), report);
  return report;
}

PidOutput::Report PidOutput::blockLoad() const {
  return empty(need(HidReportKind::Feature, kBlockLoad, pid(kBlockIndex), "block of a new effect"));
}

std::optional<int> PidOutput::loadedBlock(const std::uint8_t* bytes,
                                          std::size_t count) const noexcept {
  const HidField* block =
      descriptor_.find(HidReportKind::Feature, pid(kBlockLoad), pid(kBlockIndex));
  const HidField* status =
      descriptor_.find(HidReportKind::Feature, pid(kBlockLoad), pid(kLoadSuccess));
  if (!block || count == 0 || bytes[0] != block->report ||
      count != 1 + static_cast<std::size_t>(descriptor_.reportBytes(block->kind, block->report)))
    return {};
  const std::int64_t index = readHidField(*block, bytes + 1, count - 1);
  if (status && status->report == block->report) {
    const auto success = std::find(status->usages.begin(), status->usages.end(), pid(kLoadSuccess));
    const std::int64_t expected =
        status->isSelector ? status->least + (success - status->usages.begin()) : 1;
    if (readHidField(*status, bytes + 1, count - 1) != expected) return {};
  }
  if (index < 1 || index > 255) return {};
  return static_cast<int>(index);
}

PidOutput::Report PidOutput::setEffect(int block, int axis) const {
  const HidField& index =
      need(HidReportKind::Output, kSetEffect, pid(kBlockIndex), "effect to set");
  Report report = empty(index);
  for (const HidField& field : descriptor_.fields()) {
    if (field.kind != HidReportKind::Output || field.report != index.report) continue;
    const auto set = [&](std::int64_t value) {
      writeHidField(field, value, report.data() + 1, report.size() - 1);
    };
    if (field.hasUsage(pid(kBlockIndex))) set(block);
    if (field.hasUsage(pid(kConstantForce))) choose(field, pid(kConstantForce), report);
    if (field.hasUsage(pid(kDuration))) set(-1);       // all bits: without end
    if (field.hasUsage(pid(kTriggerButton))) set(-1);  // none
    if (field.hasUsage(pid(kGain))) set(field.most);
    if (field.isIn(pid(kAxesEnable)) &&
        field.hasUsage(hidUsage(kGenericDesktop, static_cast<std::uint16_t>(0x30 + axis))))
      set(1);
  }
  return report;
}

PidOutput::Report PidOutput::operation(int block, std::uint16_t usage) const {
  const HidField& index =
      need(HidReportKind::Output, kEffectOperation, pid(kBlockIndex), "effect to start");
  const HidField& what =
      need(HidReportKind::Output, kEffectOperation, pid(usage), "way to start an effect");
  Report report = empty(index);
  writeHidField(index, block, report.data() + 1, report.size() - 1);
  choose(what, pid(usage), report);
  return report;
}

PidOutput::Report PidOutput::startEffect(int block) const {
  return operation(block, kStart);
}

PidOutput::Report PidOutput::control(std::uint16_t usage) const {
  const HidField& field = need(HidReportKind::Output, 0, pid(usage), "control of its actuators");
  Report report = empty(field);
  choose(field, pid(usage), report);
  return report;
}

PidOutput::Report PidOutput::resetDevice() const {
  return control(kReset);
}

PidOutput::Report PidOutput::enableActuators() const {
  return control(kEnableActuators);
}

PidOutput::Report PidOutput::stopEffects() const {
  return control(kStopAll);
}

PidOutput::Report PidOutput::largestGain() const {
  const HidField* gain =
      descriptor_.find(HidReportKind::Output, pid(kDeviceGainReport), pid(kDeviceGain));
  if (!gain) return {};
  Report report = empty(*gain);
  writeHidField(*gain, gain->most, report.data() + 1, report.size() - 1);
  return report;
}

void PidOutput::constantForce(int block, double fraction, std::uint8_t* report) const noexcept {
  const double largest =
      static_cast<double>(std::min(-forceMagnitude_.least, forceMagnitude_.most));
  const double magnitude = std::isnan(fraction) ? 0 : std::clamp(fraction, -1.0, 1.0) * largest;
  std::fill(report, report + forceBytes_, std::uint8_t{0});
  report[0] = forceMagnitude_.report;
  writeHidField(forceBlock_, block, report + 1, forceBytes_ - 1);
  writeHidField(forceMagnitude_, std::llround(magnitude), report + 1, forceBytes_ - 1);
}

}  // namespace palpate
