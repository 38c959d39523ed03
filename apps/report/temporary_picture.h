// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <stdlib.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace palpate::app {

/// A place for a picture in a folder of its own, gone when this is.
class TemporaryPicture {
 public:
  TemporaryPicture() {
    std::string pattern = (std::filesystem::temp_directory_path() / "palpate.XXXXXX").string();
    if (!mkdtemp(pattern.data()))
      throw std::runtime_error("there is no temporary folder that can be written to");
    folder_ = pattern;
  }
  ~TemporaryPicture() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  TemporaryPicture(const TemporaryPicture&) = delete;
  TemporaryPicture& operator=(const TemporaryPicture&) = delete;

  std::string path() const { return (folder_ / "picture.png").string(); }

 private:
  std::filesystem::path folder_;
};

}  // namespace palpate::app
