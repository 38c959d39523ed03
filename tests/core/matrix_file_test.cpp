// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "imported/matrix_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <random>

#include "imported/harwell_boeing.h"
#include "imported/imported_greens_functions.h"
#include "support/given_bodies.h"
#include "support/refusals.h"
#include "support/temporary_path.h"
#include "text_lines.h"
#include "units.h"

namespace palpate::test {
namespace {

Eigen::Matrix3d expected() {
  Eigen::Matrix3d m;
  m << 4, -1.5, 0, -1.5, 3, 2.5e-3, 0, 2.5e-3, 1e10;
  return m;
}

Eigen::MatrixXd valuesOf(const GivenMatrix& matrix) {
  std::vector<int> all(matrix.size());
  for (int i = 0; i < matrix.size(); ++i) all[i] = i;
  return matrix.block(all, all);
}

template <class Scalar>
std::string bytesOf(const std::vector<Scalar>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Scalar)};
}

/// A .npy file with this header and these bytes.
std::string npy(int version, std::string header, const std::string& data) {
  std::string text = "\x93NUMPY";
  text += static_cast<char>(version);
  text += '\0';
  header += "\n";
  text += static_cast<char>(header.size());
  text.append(version == 1 ? 1 : 3, '\0');
  return text + header + data;
}

std::string npyMatrix() {
  const Eigen::Matrix3d m = expected();
  return npy(1, "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 3), }",
             bytesOf(std::vector<double>(m.data(), m.data() + 9)));
}

const char* const kMarket =
    "%%MatrixMarket matrix coordinate real symmetric\n% a comment\n3 3 5\n"
    "1 1 4\n2 1 -1.5\n2 2 3\n3 2 2.5D-3\n3 3 1e10\n";

// The first and last column in small fields, the second in large ones, the third of a vertex.
const char* const kDmig =
    "SOL 101\nBEGIN BULK\n$ a comment\n"
    "DMIG    KAAX           0       6       2       0\n"
    "DMIG    KAAX           7       1               7       1      4.\n"
    "               7       2    -1.5\n"
    "DMIG*   KAAX                           7               2\n"
    "*                      7               2              3.\n"
    "*                      9               1          2.5D-3\n"
    "dmig,KAAX,9,1,,9,1,1.+10\n"
    "DMIG    MAAX           0       6       1       0\n"
    "DMIG    MAAX           7       1               7       1      1.\n"
    "GRID           7             1.0     2.0    -3.0\n"
    "GRID,9,,4.,,6.-1\n"
    "GRID          12       5     0.0     0.0     0.0\n"
    "ENDDATA\n";

const char* const kHarwell =
    "stiffness                                                               KEY\n"
    "             8             1             1             2             0\n"
    "RSA                        3             3             5             0\n"
    "(4I4)           (5I4)           (3D16.8)            \n"
    "   1   3   5   6\n"
    "   1   2   2   3   3\n"
    "  4.00000000D+00 -1.50000000D+00  3.00000000D+00\n"
    "  2.50000000D-03  1.00000000D+10\n";

const char* const kMapping =
    "      Matrix Eqn        Node   DOF\n"
    "               1           7   UX\n               3           9   ROTZ\n"
    "               2           7   UY\n";

std::vector<std::pair<const char*, std::string>> allFormats() {
  return {{"text", "# a comment\na;b;c\n4;-1.5;0\n-1.5;3;2.5e-3\n\n0;2.5d-3;1E10\r\n"},
          {"text", "4,-1.5, 0\n-1.5,3,2.5e-3\n0,2.5e-3,+1e10"},
          {"text", "\xEF\xBB\xBF 4 -1.5\t0\n-1.5 3 2.5e-3\n  0 2.5e-3 1e10\n"},
          {"NumPy", npyMatrix()},
          {"Matrix Market", kMarket},
          {"Matrix Market",
           "%%MatrixMarket MATRIX array real general\n3 "
           "3\n4\n-1.5\n0\n-1.5\n3\n2.5e-3\n0\n2.5e-3\n1e10\n"},
          {"Matrix Market",
           "%%MatrixMarket matrix array real symmetric\n3 3\n4\n-1.5\n0\n3\n2.5e-3\n1e10\n"},
          {"NASTRAN DMIG KAAX", kDmig},
          {"Harwell-Boeing", kHarwell}};
}

TEST(MatrixFile, EveryFormatHoldsTheSameMatrix) {
  for (const auto& [format, text] : allFormats()) {
    const TemporaryPath file(text);
    const GivenMatrix matrix = readMatrixFile(file.path());
    EXPECT_EQ(matrix.format(), format);
    EXPECT_EQ(valuesOf(matrix), Eigen::MatrixXd(expected())) << format;
    EXPECT_EQ(matrix.asymmetry(), 0) << format;
  }
}

TEST(MatrixFile, RowsAndColumnsStayWhatTheyAre) {
  Eigen::Matrix2d m;
  m << 1, 2, 3, 4;
  const std::vector<float> byRows = {1, 2, 3, 4}, byColumns = {1, 3, 2, 4};
  const std::string texts[] = {
      "1 2\n3 4\n", "%%MatrixMarket matrix array integer general\n2 2\n1\n3\n2\n4\n",
      "%%MatrixMarket matrix coordinate real general\n2 2 4\n2 1 3\n1 2 2\n1 1 1\n2 2 4\n",
      npy(2, "{'shape': (2, 2), 'descr': '<f4', 'fortran_order': False}", bytesOf(byRows)),
      npy(3, "{'descr': '<f4', 'fortran_order': True, 'shape': (2, 2,)}", bytesOf(byColumns))};
  for (const std::string& text : texts)
    EXPECT_EQ(valuesOf(readMatrixFile(TemporaryPath(text).path())), Eigen::MatrixXd(m)) << text;
  EXPECT_NEAR(readMatrixFile(TemporaryPath(texts[2]).path()).asymmetry(), std::sqrt(2. / 30),
              1e-15);
}

TEST(MatrixFile, DmigTellsItsNodesAndComponents) {
  const TemporaryPath file(kDmig);
  const GivenMatrix matrix = readMatrixFile(file.path());
  EXPECT_EQ(matrix.dofs, (std::vector<MatrixDof>{{7, 0}, {7, 1}, {9, 0}}));
  EXPECT_EQ(matrix.nodes.numbers, (std::vector<std::int64_t>{7, 9}));
  EXPECT_EQ(matrix.nodes.points.col(1), Eigen::Vector3d(4, 0, 0.6));
  EXPECT_EQ(valuesOf(readMatrixFile(file.path(), {"MAAX", ""})), Eigen::MatrixXd::Ones(1, 1));
  EXPECT_TRUE(isRefused(
      [&] {
        readMatrixFile(file.path(), {"K2", ""});
      },
      "there is no matrix 'K2' but KAAX, MAAX"));
}

TEST(MatrixFile, AMappingTellsWhatRowsAre) {
  const TemporaryPath file(kHarwell);
  const auto matrix = imported::readMapping(kMapping, 3, "k.mapping");
  EXPECT_EQ(matrix, (std::vector<MatrixDof>{{7, 0}, {7, 1}, {9, 5}}));
  const auto refused = [](const std::string& text, const std::string& words) {
    EXPECT_TRUE(isRefused([&] { imported::readMapping(text, 3, "k.mapping"); }, words));
  };
  refused("Eqn Node DOF\n1 7 UX\n1 7 UY\n", "k.mapping, line 3: equation 1 is given twice");
  refused("1 7 UX\n2 7 UY\n", "says nothing of row 3 of the matrix, which has 3 rows");
  refused("1 7 UX\n4 7 UY\n", "line 2: '4' is not a whole number from 1 to 3");
  refused("1 7 TEMP\n", "the degree of freedom 'TEMP' is no displacement or rotation");
  refused("1 7 UX 3\n", "must give equation, node and degree of freedom");
}

TEST(MatrixFile, FortransNumbersMayTouch) {
  const std::string whole = kHarwell;
  std::string touching = whole;
  const auto replace = [&](const std::string& old, const std::string& by) {
    const std::size_t at = touching.find(old);
    ASSERT_NE(at, std::string::npos) << old;
    touching.replace(at, old.size(), by);
  };
  replace("(5I4) ", "(5I1) ");
  replace("   1   2   2   3   3\n", "12233\n");
  replace("(3D16.8)", "(3D15.8)");
  replace("  4.00000000D+00 -1.50000000D+00  3.00000000D+00\n",
          " 4.00000000D+00-1.50000000D+00 3.00000000D+00\n");
  replace("  2.50000000D-03  1.00000000D+10\n", " 2.50000000D-03 1.00000000D+10\n");
  EXPECT_EQ(valuesOf(readMatrixFile(TemporaryPath(touching).path())), Eigen::MatrixXd(expected()));
}

TEST(MatrixFile, NodesWithAndWithoutNumbers) {
  const Eigen::Vector3d second(4, 5.5, -6);
  for (const char* text : {"x,y,z\n1,2,3\n4,5.5,-6\n", "# nodes\n1 2 3\n4 5.5 -6\n"}) {
    const NodeTable nodes = readNodeFile(TemporaryPath(text).path());
    EXPECT_TRUE(nodes.numbers.empty());
    EXPECT_EQ(nodes.points.col(1), second);
  }
  const NodeTable numbered = readNodeFile(TemporaryPath("n;x;y;z\n12;1;2;3\n7;4;5.5;-6\n").path());
  EXPECT_EQ(numbered.numbers, (std::vector<std::int64_t>{12, 7}));
  EXPECT_EQ(numbered.points.col(1), second);
  const NodeTable grid =
      readNodeFile(TemporaryPath("GRID,7,,4.,5.5,-6.\nGRID,12,,1.,2.,3.\n").path());
  EXPECT_EQ(grid.numbers, (std::vector<std::int64_t>{7, 12}));
  EXPECT_EQ(grid.points.col(0), second);
}

TEST(MatrixFile, WhatIsWronglySaidIsNamedWithItsLine) {
  const auto refused = [](const std::string& text, const std::string& words) {
    const TemporaryPath file(text);
    EXPECT_TRUE(isRefused([&] { readMatrixFile(file.path()); }, words));
  };
  refused("1 2\n3 x4\n", ", line 2: 'x4' is not a number");
  refused("1 2\n3\n", ", line 2: there are 1 numbers, not 2 as in the first row");
  refused("1 nan\n2 3\n", ", line 1: 'nan' is not a finite number");
  refused("1 2 3\n4 5 6\n", "the matrix is 2 by 3, but compliances and stiffnesses are square");
  refused("a b\nc d\n", ", line 2: 'c' is not a number");
  refused("#\n", "there are no numbers in this file");
  refused("1 1e200\n1e200 1\n", "no number of any unit");
  const std::string market = "%%MatrixMarket matrix coordinate ";
  refused(market + "complex general\n", "the field of this Matrix Market file is 'complex'");
  refused(market + "real hermitian\n", "is 'hermitian', not symmetric or general");
  refused(market + "real general\n2 2 4000000000\n", "too short for 4000000000 entries");
  refused(market + "real general\n200000000 200000000 3\n1 1 1\n1 1 1\n1 1 1\n",
          "has rows without");
  refused(market + "real general\n2 2 2\n1 1 1\n1 1 2\n", "row 1 and column 1 is given twice");
  refused(market + "real general\n2 2 2\n1 1 1\n", "the file ends before its an entry");
  refused(market + "real general\n1 1 1\n1 1 1\n1 1 1\n", "there is more than the entries");
  refused(market + "real general\n1 1 1\n1 2 1\n",
          ", line 3: '2' is not a whole number from 1 to 1");
  const std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (";
  refused(npy(1, header + "2, 2)}", std::string(31, 'x')), "2 by 2 numbers, but has 31 bytes");
  refused(npy(1, header + "4611686018427387904, 4)}", ""), "but has 0 bytes");
  refused(npy(1, header + "99999999999999999999999, 4)}", ""), "not as NumPy writes it");
  refused(npy(1, header + "2,)}", std::string(16, '\0')), "an array of 1 dimensions");
  refused(npy(4, header + "2,)}", ""), "version 4");
  refused(npy(1, "{'descr': '>f8', 'fortran_order': False, 'shape': (1, 1)}", "12345678"),
          "the type '>f8'");
}

TEST(MatrixFile, BulkDataThatCannotBeMeantAreRefused) {
  const auto refused = [](const std::string& text, const std::string& words) {
    const TemporaryPath file(text);
    EXPECT_TRUE(isRefused([&] { readMatrixFile(file.path()); }, words));
  };
  const std::string header = "DMIG,K,0,6,2,0\n", entry = "DMIG,K,7,1,,7,1,4.\n";
  refused("DMIG,K,0,6,4,0\n" + entry, "is complex");
  refused(entry, "no DMIG card is the header");
  refused(header + entry + header, ", line 3: the matrix 'K' has two headers");
  refused(header + "DMIG,K,7,1,,7,x,4.\n", "line 2: 'x' is not a number");
  refused(header + "DMIG,K,7,7,,7,1,4.\n", "from 0 to 6");
  refused(header + "DMIG,K,7,1,,7,1,\n", "line 2: the field '' is not a number");
  refused(header + "DMIG,K,7,1,,7,1,1.,2.\n", "has an imaginary entry");
  refused(header + entry + entry, "is given twice");
  refused(header + "DMIG,K,7,1,,7,1,4.,,8,1,2.,,9\n", "more than 8 fields between commas");
  refused("DMIG,P,0,9,1,0\nDMIG,P,1,0,,7,1,4.\n", "has other columns than rows");
  refused("DMIG,M,0,6,2,0\nDMIG,B,0,6,2,0\n", "there are several matrices, B, M");
  refused(header + entry + "GRID,7,3,0.,0.,0.\n", "grid point 7 is in a frame of their own");
  refused(header + entry + "GRID,7,,0.,0.,0.,2\n", "(CD 2)");
  refused(header + entry + "GRID,7,,0.\nGRID,7,,1.\n", "grid point 7 is given twice");
}

TEST(MatrixFile, BinaryFilesOfOtherProgramsAreRefusedWithWhatToWriteInstead) {
  // A record of Fortran's: its length, whole numbers, its length.
  const TemporaryPath file(bytesOf(std::vector<std::int32_t>{12, 8, 100, 1, 12}));
  EXPECT_TRUE(isRefused([&] { readMatrixFile(file.path()); }, "HBMAT with its mapping file"));
  EXPECT_TRUE(isRefused([&] { readNodeFile(file.path()); }, "this is a binary file"));
}

TEST(MatrixFile, PathsThatAreNoFilesAreRefused) {
  const auto refused = [](const std::string& path, const std::string& words) {
    EXPECT_TRUE(isRefused<std::runtime_error>([&] { readMatrixFile(path); }, words));
  };
  refused("no such file.npy", "no such file.npy: there is no such file");
  refused("/dev/zero", "is not an ordinary file");
  refused(std::filesystem::temp_directory_path().string(), "is not an ordinary file");
  const TemporaryPath empty("");
  refused(empty.path(), "is empty");
}

/// Whether a text is read, or refused in a sentence. Anything else ends the test's process.
template <class Read>
bool isReadBy(const Read& read, const std::string& text) {
  const TemporaryPath file(text);
  try {
    read(file.path());
    return true;
  } catch (const std::invalid_argument& refusal) {
    EXPECT_TRUE(std::strlen(refusal.what()) > 10 && !std::strchr(refusal.what(), '\n'));
  } catch (const std::runtime_error& refusal) {
    EXPECT_TRUE(contains(refusal.what(), "is empty"));
  }
  return false;
}

bool isRead(const std::string& text) {
  return isReadBy([](const std::string& path) { readMatrixFile(path); }, text);
}

/// One to four bytes made others, every second time such as mean something.
std::string changed(const std::string& text, int trial, std::mt19937& random) {
  const std::string telling =
      "0123456789 ,;.*+-$%\n\0\xff"
      "eE'()";
  std::string result = text;
  for (int count = 1 + trial % 4; count > 0; --count)
    result[random() % result.size()] =
        trial % 2 ? telling[random() % telling.size()] : static_cast<char>(random());
  return result;
}

TEST(MatrixFile, FilesThatEndAnywhereAreReadOrRefused) {
  for (const auto& [format, text] : allFormats())
    for (std::size_t size = 0; size < text.size(); ++size) {
      const bool read = isRead(text.substr(0, size));
      // Text may lose the end of its last number, bulk data whole cards, but no other format.
      const bool mayBeRead = std::string(format) != "NumPy" &&
                             (std::string(format) != "Matrix Market" || size + 6 >= text.size());
      EXPECT_TRUE(mayBeRead || !read) << format << " of " << size << " bytes";
    }
}

TEST(MatrixFile, ChangedBytesAreReadOrRefused) {
  std::mt19937 random(5);
  for (const auto& [format, text] : allFormats())
    for (int trial = 0; trial < 3000; ++trial) isRead(changed(text, trial, random));
  const auto nodes = [](const std::string& path) { readNodeFile(path); };
  const auto mapping = [](const std::string& path) {
    imported::readMapping(readBytes(path), 3, path);
  };
  for (int trial = 0; trial < 3000; ++trial) {
    isReadBy(mapping, changed(kMapping, trial, random));
    for (const std::string& text :
         {std::string("12 1 2 3\n7 4 5.5 -6\n"), std::string(kDmig), npyMatrix()})
      isReadBy(nodes, changed(text, trial, random));
  }
}

TEST(MatrixFile, NumbersInAnyNotationAndLocale) {
  EXPECT_EQ(numberOf("+1.5"), 1.5);
  EXPECT_EQ(numberOf("-1.5D+02"), -150);
  EXPECT_EQ(numberOf("1e-400"), 0);
  for (const char* word : {"", "+", "++1", "1.5x", "1e400", "0x10", "1,5", " 1"})
    EXPECT_FALSE(numberOf(word)) << word;
}

TEST(MatrixFile, UnitsHaveNames) {
  EXPECT_EQ(lengthUnitNamed("mm"), 1e-3);
  EXPECT_EQ(forceUnitNamed("kN"), 1e3);
  EXPECT_TRUE(isRefused([] { lengthUnitNamed("mile"); },
                        "there is no unit of length 'mile': choose one of m, cm, mm, um, in, ft"));
}

TEST(MatrixFile, AStructureOfDmigAnswersAsByHand) {
  // Three vertices on springs k in all directions to an inner point 20, which stands on springs g,
  // and can turn; a coordinate of a mode, 30, bears nothing.
  const double k = 2e3, g = 5e2;
  std::string text = "DMIG,KX,0,6,2,0\n";
  const auto entry = [&](int a, int i, int b, int j, double value) {
    text += sentence("DMIG,KX,", a, ",", i, ",,", b, ",", j, ",", std::fixed, value, "\n");
  };
  for (int c = 1; c <= 3; ++c) {
    for (int node : {11, 12, 13}) {
      entry(node, c, node, c, k);
      entry(node, c, 20, c, -k);
    }
    entry(20, c, 20, c, 3 * k + g);
    entry(20, c + 3, 20, c + 3, 7);
  }
  entry(30, 0, 30, 0, 1e5);
  text += "GRID,11,,0.,0.,0.\nGRID,12,,1.,0.,0.\nGRID,13,,0.,1.,0.\nGRID,20,,.3,.3,-.5\n";
  const TemporaryPath file(text);
  const ElasticModel model = givenModel(fromLists({{0, 1, 0}, {0, 0, 0}, {1, 0, 0}}, {{1, 2, 0}}));
  const auto greens =
      importGreensFunctions(model, MatrixKind::Stiffness, readMatrixFile(file.path()), {})
          .greens.take();
  const Eigen::MatrixXd compliance = forceCompliance(*greens, {0, 1, 2});
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j)
      EXPECT_NEAR(compliance(i, j), i % 3 != j % 3 ? 0 : i == j ? 1 / k + 1 / g : 1 / g, 1e-15);
}

}  // namespace
}  // namespace palpate::test
