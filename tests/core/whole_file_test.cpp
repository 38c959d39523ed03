// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "whole_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "support/refusals.h"

namespace palpate::test {
namespace {

class WholeFile : public ::testing::Test {
 protected:
  WholeFile() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directory(folder_);
    writeWholeFile(path_, [](std::ostream& file) { file << "before"; });
  }
  ~WholeFile() override { std::filesystem::remove_all(folder_); }

  static std::string read(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }
  long count() const { return std::distance(std::filesystem::directory_iterator(folder_), {}); }

  const std::string folder_ =
      ::testing::TempDir() + "palpate_whole_file_" + std::to_string(getpid()) + "/";
  const std::string path_ = folder_ + "a.txt";
};

TEST_F(WholeFile, ReplacesAnOlderOne) {
  writeWholeFile(path_, [](std::ostream& file) { file << "after"; });
  EXPECT_EQ(read(path_), "after");
  EXPECT_EQ(count(), 1);
}

TEST_F(WholeFile, StaysAsItWasIfWhatWritesFails) {
  EXPECT_THROW(writeWholeFile(path_,
                              [](std::ostream& file) {
                                file << "half";
                                throw std::logic_error("no more");
                              }),
               std::logic_error);
  EXPECT_EQ(read(path_), "before");
  EXPECT_EQ(count(), 1);
}

TEST_F(WholeFile, StaysAsItWasIfTheStreamFails) {
  EXPECT_TRUE(isRefused<std::runtime_error>(
      [&] { writeWholeFile(path_, [](std::ostream& file) { file.setstate(std::ios::badbit); }); },
      path_ + " cannot be written"));
  EXPECT_EQ(read(path_), "before");
  EXPECT_EQ(count(), 1);
}

TEST_F(WholeFile, IsWrittenWhereALinkLeads) {
  const std::string link = folder_ + "link";
  std::filesystem::create_symlink("a.txt", link);
  writeWholeFile(link, [](std::ostream& file) { file << "after"; });
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(read(path_), "after");
}

TEST_F(WholeFile, SaysWhyItCannotBeThere) {
  const auto nothing = [](std::ostream&) {};
  EXPECT_TRUE(isRefused<std::runtime_error>([&] { writeWholeFile(folder_ + "no/a", nothing); },
                                            "cannot be written: No such file or directory"));
  EXPECT_TRUE(isRefused<std::runtime_error>([&] { writeWholeFile(folder_, nothing); },
                                            "cannot be written: "));
  EXPECT_EQ(count(), 1);
}

}  // namespace
}  // namespace palpate::test
