// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpate {

enum class HidReportKind { Input, Output, Feature };

/// Usages with their page, as HID writes them in 32 bits.
constexpr std::uint32_t hidUsage(std::uint16_t page, std::uint16_t usage) noexcept {
  return (std::uint32_t{page} << 16) | usage;
}

/// One number in a report.
struct HidField {
  HidReportKind kind;
  std::uint8_t report;       ///< number of the report, 0 if the device does not number them
  int bit;                   ///< where it begins, counted after the report's number
  int bits;                  ///< 1..32
  std::int64_t least, most;  ///< logical range
  bool isSelector;           ///< its value chooses one of `usages`, from `least` on
  std::vector<std::uint32_t> usages;       ///< of a selector all, else the one that it has, if any
  std::vector<std::uint32_t> collections;  ///< that it lies in, outermost first

  bool hasUsage(std::uint32_t usage) const noexcept;
  bool isIn(std::uint32_t collection) const noexcept;
};

/// What a device's reports consist of, by its report descriptor (USB HID 1.11, section 6.2.2).
/// Padding and fields wider than 32 bits have their place but are not listed.
class HidDescriptor {
 public:
  HidDescriptor() = default;

  /// @throws std::invalid_argument with the place of the first item that cannot be.
  explicit HidDescriptor(const std::vector<std::uint8_t>& bytes);

  const std::vector<HidField>& fields() const noexcept { return fields_; }
  bool numbersReports() const noexcept { return numbersReports_; }
  /// Bytes of a report after its number; 0 if there is none.
  int reportBytes(HidReportKind kind, std::uint8_t report) const noexcept;

  /// The first field of a kind with a usage within a collection; null if there is none.
  /// @param collection  0 for any.
  const HidField* find(HidReportKind kind, std::uint32_t collection,
                       std::uint32_t usage) const noexcept;

 private:
  friend class HidDescriptorParser;
  struct Report {
    HidReportKind kind;
    std::uint8_t number;
    int bits;
  };

  std::vector<HidField> fields_;
  std::vector<Report> reports_;
  bool numbersReports_ = false;
};

/// A field's value in a report; 0 if the report is too short for it.
/// @param bytes  of the report after its number.
std::int64_t readHidField(const HidField& field, const std::uint8_t* bytes,
                          std::size_t count) noexcept;
/// Does nothing if the report is too short.
void writeHidField(const HidField& field, std::int64_t value, std::uint8_t* bytes,
                   std::size_t count) noexcept;

}  // namespace palpate
