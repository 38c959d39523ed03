// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/hid_descriptor.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

// Far beyond any device: what has more is not a descriptor.
constexpr std::size_t kMostBytes = 16384, kMostFields = 4096, kMostDepth = 64, kMostUsages = 1024;
constexpr int kMostReportBits = 8 * 4096;

std::int64_t signedValue(std::uint32_t value, int bytes) noexcept {
  if (bytes == 1) return static_cast<std::int8_t>(value);
  if (bytes == 2) return static_cast<std::int16_t>(value);
  return static_cast<std::int32_t>(value);
}

}  // namespace

bool HidField::hasUsage(std::uint32_t usage) const noexcept {
  return std::find(usages.begin(), usages.end(), usage) != usages.end();
}

bool HidField::isIn(std::uint32_t collection) const noexcept {
  return std::find(collections.begin(), collections.end(), collection) != collections.end();
}

/// Reads the items of a descriptor in turn.
class HidDescriptorParser {
 public:
  HidDescriptorParser(const std::vector<std::uint8_t>& bytes, HidDescriptor& result)
      : bytes_(bytes), result_(result) {}

  void run() {
    if (bytes_.size() > kMostBytes) refuse("it is too long");
    while (at_ < bytes_.size()) takeItem();
    if (!collections_.empty()) refuse("a collection does not end");
    if (stack_.size() > 0) refuse("a push has no pop");
  }

 private:
  struct Globals {
    std::uint16_t page = 0;
    std::int64_t least = 0;
    std::uint32_t most = 0;
    int mostBytes = 0;
    std::uint32_t size = 0, count = 0;
    std::uint8_t report = 0;
  };

  [[noreturn]] void refuse(const std::string& what) const {
    throw std::invalid_argument("the report descriptor is wrong before byte " +
                                std::to_string(at_) + ": " + what);
  }

  void takeItem() {
    const std::uint8_t prefix = bytes_[at_++];
    if (prefix == 0xfe) {  // a long item; none is defined
      const std::size_t size = at_ < bytes_.size() ? bytes_[at_] + std::size_t{2} : 0;
      if (size == 0 || bytes_.size() - at_ < size) refuse("a long item is cut short");
      at_ += size;
      return;
    }
    const int size = (prefix & 3) == 3 ? 4 : prefix & 3;
    if (bytes_.size() - at_ < static_cast<std::size_t>(size)) refuse("an item is cut short");
    std::uint32_t value = 0;
    for (int i = 0; i < size; ++i) value |= std::uint32_t{bytes_[at_++]} << (8 * i);
    switch (prefix & 0x0c) {
      case 0x00:
        takeMain(prefix & 0xf0, value);
        break;
      case 0x04:
        takeGlobal(prefix & 0xf0, value, size);
        break;
      case 0x08:
        takeLocal(prefix & 0xf0, value, size);
        break;
      default:
        refuse("an item has a reserved type");
    }
  }

  void takeMain(int tag, std::uint32_t value) {
    if (tag == 0x80) addFields(HidReportKind::Input, value);
    if (tag == 0x90) addFields(HidReportKind::Output, value);
    if (tag == 0xb0) addFields(HidReportKind::Feature, value);
    if (tag == 0xa0) {
      if (collections_.size() == kMostDepth) refuse("collections lie too deep in each other");
      collections_.push_back(usages_.empty() ? 0 : withPage(usages_.front()));
    }
    if (tag == 0xc0) {
      if (collections_.empty()) refuse("a collection ends that did not begin");
      collections_.pop_back();
    }
    usages_.clear();
    first_.reset();
  }

  void takeGlobal(int tag, std::uint32_t value, int size) {
    if (tag == 0x00) globals_.page = static_cast<std::uint16_t>(value);
    if (tag == 0x10) globals_.least = signedValue(value, size);
    if (tag == 0x20) {
      globals_.most = value;
      globals_.mostBytes = size;
    }
    if (tag == 0x70) globals_.size = value;
    if (tag == 0x90) globals_.count = value;
    if (tag == 0x80) {
      if (value == 0 || value > 255) refuse("a report's number must be 1..255");
      globals_.report = static_cast<std::uint8_t>(value);
      result_.numbersReports_ = true;
    }
    if (tag == 0xa0) {
      if (stack_.size() == kMostDepth) refuse("too much is pushed");
      stack_.push_back(globals_);
    }
    if (tag == 0xb0) {
      if (stack_.empty()) refuse("a pop has no push");
      globals_ = stack_.back();
      stack_.pop_back();
    }
  }

  void takeLocal(int tag, std::uint32_t value, int size) {
    const Usage usage{value, size == 4};
    if (tag == 0x00) addUsage(usage);
    if (tag == 0x10) first_ = usage;
    if (tag == 0x20 && first_) {
      if (value < first_->value || value - first_->value >= kMostUsages)
        refuse("a range of usages is backwards or too wide");
      for (std::uint32_t u = first_->value;; ++u) {
        addUsage({u, first_->hasPage});
        if (u == value) break;
      }
      first_.reset();
    }
  }

  struct Usage {
    std::uint32_t value;
    bool hasPage;
  };

  void addUsage(const Usage& usage) {
    if (usages_.size() == kMostUsages) refuse("there are too many usages");
    usages_.push_back(usage);
  }

  std::uint32_t withPage(const Usage& usage) const {
    return usage.hasPage ? usage.value
                         : hidUsage(globals_.page, static_cast<std::uint16_t>(usage.value));
  }

  HidDescriptor::Report& report(HidReportKind kind) {
    for (HidDescriptor::Report& known : result_.reports_)
      if (known.kind == kind && known.number == globals_.report) return known;
    return result_.reports_.emplace_back(HidDescriptor::Report{kind, globals_.report, 0});
  }

  /// A maximum like 0xff in one byte is meant as 255 where no value is negative.
  std::int64_t most() const {
    const std::int64_t value = signedValue(globals_.most, globals_.mostBytes);
    return globals_.least >= 0 && value < 0 ? globals_.most : value;
  }

  void addFields(HidReportKind kind, std::uint32_t flags) {
    HidDescriptor::Report& into = report(kind);
    if (globals_.size > kMostReportBits || globals_.count > kMostReportBits ||
        std::uint64_t{globals_.size} * globals_.count > std::uint64_t(kMostReportBits - into.bits))
      refuse("a report is too long");
    const bool isPadding = flags & 1, isVariable = flags & 2;
    const int size = static_cast<int>(globals_.size), count = static_cast<int>(globals_.count);
    const bool isListed = !isPadding && size >= 1 && size <= 32;
    for (int i = 0; isListed && i < count; ++i) {
      if (result_.fields_.size() == kMostFields) refuse("there are too many fields");
      HidField field{kind,           globals_.report, into.bits + i * size, size,
                     globals_.least, most(),          !isVariable,          {},
                     collections_};
      for (std::size_t u = 0; u < usages_.size(); ++u)
        if (!isVariable || u == std::min<std::size_t>(i, usages_.size() - 1))
          field.usages.push_back(withPage(usages_[u]));
      result_.fields_.push_back(std::move(field));
    }
    into.bits += size * count;
  }

  const std::vector<std::uint8_t>& bytes_;
  HidDescriptor& result_;
  std::size_t at_ = 0;
  Globals globals_;
  std::vector<Globals> stack_;
  std::vector<Usage> usages_;
  std::optional<Usage> first_;
  std::vector<std::uint32_t> collections_;
};

HidDescriptor::HidDescriptor(const std::vector<std::uint8_t>& bytes) {
  HidDescriptorParser(bytes, *this).run();
}

int HidDescriptor::reportBytes(HidReportKind kind, std::uint8_t report) const noexcept {
  for (const Report& known : reports_)
    if (known.kind == kind && known.number == report) return (known.bits + 7) / 8;
  return 0;
}

const HidField* HidDescriptor::find(HidReportKind kind, std::uint32_t collection,
                                    std::uint32_t usage) const noexcept {
  for (const HidField& field : fields_)
    if (field.kind == kind && field.hasUsage(usage) && (collection == 0 || field.isIn(collection)))
      return &field;
  return nullptr;
}

std::int64_t readHidField(const HidField& field, const std::uint8_t* bytes,
                          std::size_t count) noexcept {
  if (field.bit < 0 || static_cast<std::size_t>(field.bit + field.bits) > 8 * count) return 0;
  std::uint64_t value = 0;
  for (int i = 0; i < field.bits; ++i) {
    const int bit = field.bit + i;
    value |= std::uint64_t{(bytes[bit / 8] >> (bit % 8)) & 1u} << i;
  }
  const std::uint64_t sign = std::uint64_t{1} << (field.bits - 1);
  if (field.least < 0 && (value & sign))
    return static_cast<std::int64_t>(value) - 2 * static_cast<std::int64_t>(sign);
  return static_cast<std::int64_t>(value);
}

void writeHidField(const HidField& field, std::int64_t value, std::uint8_t* bytes,
                   std::size_t count) noexcept {
  if (field.bit < 0 || static_cast<std::size_t>(field.bit + field.bits) > 8 * count) return;
  for (int i = 0; i < field.bits; ++i) {
    const int bit = field.bit + i;
    const std::uint8_t mask = static_cast<std::uint8_t>(1u << (bit % 8));
    if ((static_cast<std::uint64_t>(value) >> i) & 1)
      bytes[bit / 8] |= mask;
    else
      bytes[bit / 8] &= static_cast<std::uint8_t>(~mask);
  }
}

}  // namespace palpate
