// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace palpate {

/// Uninitialised memory for a large matrix, aligned for vector units and on huge pages where the
/// system offers them. `release()` hands it to an owner that calls std::free.
template <class Scalar>
class AlignedBuffer {
 public:
  AlignedBuffer() = default;
  explicit AlignedBuffer(std::size_t count) : size_(count) {
    if (count > std::numeric_limits<std::ptrdiff_t>::max() / sizeof(Scalar)) throw std::bad_alloc();
    const std::size_t bytes = count * sizeof(Scalar);
    constexpr std::size_t hugePage = std::size_t(1) << 21, line = 64;
    const std::size_t alignment = bytes >= hugePage ? hugePage : line;
    const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
    data_.reset(static_cast<Scalar*>(std::aligned_alloc(alignment, rounded ? rounded : line)));
    if (!data_) throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
    if (alignment == hugePage) madvise(data_.get(), rounded, MADV_HUGEPAGE);
#endif
  }

  Scalar* data() const {
    return data_.get();
  }
  std::size_t size() const {
    return size_;
  }
  std::size_t bytes() const {
    return size_ * sizeof(Scalar);
  }
  /// Counts fewer numbers from now on; the memory stays.
  void truncate(std::size_t count) {
    size_ = count < size_ ? count : size_;
  }
  Scalar* release() {
    size_ = 0;
    return data_.release();
  }

 private:
  struct Free {
    void operator()(Scalar* memory) const { std::free(memory); }
  };
  std::unique_ptr<Scalar, Free> data_;
  std::size_t size_ = 0;
};

}  // namespace palpate
