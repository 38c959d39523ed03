// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/polygon_file.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "support/refusals.h"

namespace palpate::test {
namespace {

/// A file that is gone when the test ends.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text)
      : path_(::testing::TempDir() + "palpate_" +
              ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".off") {
    std::ofstream(path_) << text;
  }
  ~TemporaryFile() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

PolygonSoup read(const std::string& text) {
  return readOffFile(TemporaryFile(text).path());
}

const char* const kPyramid =
    "OFF\n"
    "# a pyramid on a square\n"
    "5 5 0\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
    "0.5 0.5 0.1234567890123456789e1\n"
    "\n"
    "4 3 2 1 0\n"
    "3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";

TEST(OffFile, PolygonsComeAsTheyStandInTheFile) {
  const PolygonSoup soup = read(kPyramid);
  ASSERT_EQ(soup.points.cols(), 5);
  EXPECT_EQ(soup.points.col(2), Eigen::Vector3d(1, 1, 0));
  EXPECT_EQ(soup.polygons, (std::vector<std::vector<int>>{
                               {3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}));
}

TEST(OffFile, CoordinatesKeepAllTheirDigits) {
  EXPECT_EQ(read(kPyramid).points(2, 4), 1.2345678901234567890);
}

TEST(OffFile, AMissingFileIsNamedAsSuch) {
  EXPECT_EQ(refusal<std::runtime_error>([] { readOffFile(::testing::TempDir() + "no/such.off"); }),
            "the file cannot be opened");
}

TEST(OffFile, WhatIsNoOffFileIsRefused) {
  for (const char* text : {"", "solid cube\n", "OFF\n", "OFF\nthree\n", "ply\nformat ascii 1.0\n"})
    EXPECT_EQ(refusal<std::runtime_error>([&] { read(text); }),
              "the file is not a readable OFF file")
        << text;
}

TEST(OffFile, ACutOffFileIsRefused) {
  const std::string whole = kPyramid;
  for (const char* last : {"1 1 0\n", "3 1 2 4\n", "3 2 3 "})
    EXPECT_EQ(refusal<std::runtime_error>(
                  [&] { read(whole.substr(0, whole.find(last) + std::string(last).size())); }),
              "the file is not a readable OFF file")
        << "cut after " << last;
}

TEST(OffFile, ACoordinateThatIsANumberInPartIsRefused) {
  std::string text = kPyramid;
  text.replace(text.find("e1\n"), 2, "w1");
  EXPECT_EQ(refusal<std::runtime_error>([&] { read(text); }),
            "the file is not a readable OFF file");
}

TEST(OffFile, CountsBeyondTheFileAreRefusedNotAllocated) {
  for (const char* counts : {"4000000000000 1 0", "3 4000000000000 0", "2000000000 1 0",
                             "3 2000000000 0", "-5 1 0", "3 -1 0"})
    EXPECT_EQ(refusal<std::runtime_error>([&] {
                read(std::string("OFF\n") + counts + "\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
              }),
              "the file is not a readable OFF file")
        << counts;
}

TEST(OffFile, APolygonOfImpossiblyManyCornersIsRefusedNotAllocated) {
  EXPECT_EQ(refusal<std::runtime_error>(
                [] { read("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2000000000 0 1 2\n"); }),
            "the file is not a readable OFF file");
}

TEST(OffFile, AnIndexOutOfRangeIsRefused) {
  for (const char* polygon : {"3 0 1 3", "3 0 1 -1", "3 0 1 4294967296"})
    EXPECT_EQ(refusal<std::runtime_error>(
                  [&] { read(std::string("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n") + polygon + "\n"); }),
              "the file is not a readable OFF file")
        << polygon;
}

const std::string kTetrahedronPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

TEST(PlyFile, GivesPointsAndPolygonsAsTheyStand) {
  const PolygonSoup soup = readPlyFile(TemporaryFile(kTetrahedronPly).path());
  EXPECT_EQ(soup.points.cols(), 4);
  EXPECT_EQ(soup.points.col(3), Eigen::Vector3d::UnitZ());
  ASSERT_EQ(soup.polygons.size(), 4u);
  EXPECT_EQ(soup.polygons[2], (std::vector<int>{1, 2, 3}));
}

TEST(PlyFile, CutShortAnywhereBeforeItsLastNumberIsRefused) {
  for (std::size_t length = 0; length < kTetrahedronPly.size() - 3; ++length)
    EXPECT_EQ(refusal<std::runtime_error>(
                  [&] { readPlyFile(TemporaryFile(kTetrahedronPly.substr(0, length)).path()); }),
              "the file is not a readable PLY file")
        << length;
}

}  // namespace
}  // namespace palpate::test
