// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/measurement_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/refusals.h"
#include "support/rigs.h"
#include "support/temporary_path.h"

namespace palpate::test {
namespace {

const std::string kTable =
    "# a rig\n"
    "probe,contact_vertex,radius,force_x,force_y,force_z,x,y,z,u_x,u_y,u_z,sd\n"
    "a,0,0.2,0,0,-2,0,0,1,1e-3,0,-2e-3,1e-5\n"
    "a,,,,,,1,0,0,,2e-3,0,1e-5\n"
    "b,3,0,1,0,0,0,1,0,3e-3,0,0,1e-5\n";

Measurements read(const std::string& text, const MeasurementUnits& units = {}) {
  return readMeasurementFile(TemporaryPath(text).path(), units);
}

/// The table with one part for another.
std::string with(const std::string& part, const std::string& other) {
  std::string text = kTable;
  const std::size_t at = text.find(part);
  EXPECT_NE(at, text.npos) << part;
  return text.replace(at, part.size(), other);
}

TEST(MeasurementFile, RowsAreDisplacementsUnderProbes) {
  const Measurements m = read(kTable);
  ASSERT_EQ(m.probes.size(), 2u);
  ASSERT_EQ(m.displacements.size(), 3u);
  EXPECT_EQ(m.probes[0].name, "a");
  EXPECT_EQ(m.probes[0].contact.vertex, 0);
  EXPECT_EQ(m.probes[0].radius, 0.2);
  EXPECT_EQ(m.probes[0].force, Eigen::Vector3d(0, 0, -2));
  EXPECT_EQ(m.displacements[1].probe, 0);
  EXPECT_TRUE(std::isnan(m.displacements[1].displacement.x()));
  EXPECT_EQ(m.displacements[1].displacement.y(), 2e-3);
  EXPECT_EQ(m.displacements[2].row, 5);
  EXPECT_EQ(m.displacements[2].deviation, Eigen::Vector3d::Constant(1e-5));
  EXPECT_EQ(m.valueCount(), 8);
}

TEST(MeasurementFile, UnitsAreThoseAskedFor) {
  const Measurements m = read(kTable, {1e-3, 1e3});
  EXPECT_DOUBLE_EQ(m.probes[0].radius, 0.2e-3);
  EXPECT_DOUBLE_EQ(m.probes[0].force.z(), -2e3);
  EXPECT_DOUBLE_EQ(m.displacements[0].displacement.z(), -2e-6);
  EXPECT_DOUBLE_EQ(m.displacements[0].deviation.z(), 1e-8);
  EXPECT_DOUBLE_EQ(m.displacements[0].marker.point.z(), 1e-3);
  EXPECT_TRUE(isRefused([] { read(kTable, {0, 1}); }, "units must be positive"));
}

TEST(MeasurementFile, SemicolonsAndBlanksDoAsWell) {
  std::string text = kTable;
  std::replace(text.begin(), text.end(), ',', ';');
  EXPECT_EQ(read(text).displacements.size(), 3u);
  EXPECT_EQ(read("probe contact_vertex force_x force_y force_z vertex u_x u_y u_z\n"
                 "1 0 0 0 1 2 0 0 1e-3\n")
                .displacements.size(),
            1u);
}

// As R and spreadsheets write words.
TEST(MeasurementFile, WordsMayBeQuoted) {
  std::string text = with("probe,contact_vertex", "\"probe\",\"contact_vertex\"");
  text.replace(text.find("\na,"), 3, "\n\"a\",");
  const Measurements m = read(text);
  ASSERT_EQ(m.probes.size(), 2u);
  EXPECT_EQ(m.probes[0].name, "a");
  EXPECT_EQ(m.displacements[1].probe, 0);
}

TEST(MeasurementFile, NamesMayBeInCapitals) {
  const Measurements m =
      read(with("probe,contact_vertex,radius,force_x,force_y,force_z,x,y,z,u_x",
                "Probe,CONTACT_VERTEX,Radius,Force_X,force_y,force_z,X,Y,Z,U_x"));
  ASSERT_EQ(m.probes.size(), 2u);
  EXPECT_EQ(m.probes[0].force.z(), -2);
  EXPECT_EQ(m.displacements[0].displacement.x(), 1e-3);
}

// As spreadsheets save tables; several tabs in a row only align.
TEST(MeasurementFile, GapsAreEmptyBetweenTabs) {
  const Measurements gaps = read(
      "probe\tcontact_vertex\tforce_x\tforce_y\tforce_z\tvertex\tu_x\tu_y\tu_z\n"
      "1\t0\t0\t0\t1\t2\t1e-3\t\t\n");
  ASSERT_EQ(gaps.valueCount(), 1);
  EXPECT_EQ(gaps.displacements[0].displacement.x(), 1e-3);
  EXPECT_EQ(read("probe\t\tcontact_vertex\tforce_x\tforce_y\tforce_z\tvertex\tu_x\tu_y\tu_z\n"
                 "1\t0\t\t0\t0\t1\t2\t1e-3\t0\t0\n")
                .valueCount(),
            3);
}

// Between blanks nothing can be empty.
TEST(MeasurementFile, GapsAreEmptyBetweenCommas) {
  EXPECT_TRUE(isRefused(
      [] {
        read(
            "probe contact_vertex force_x force_y force_z vertex u_x u_y u_z\n"
            "1 0 0 0 1 2 NA 0 1e-3\n");
      },
      "line 2: 'NA' is not a number: where u_x was not measured, separate columns by commas and "
      "leave it empty"));
}

TEST(MeasurementFile, WhatIsWrongIsNamedByLine) {
  const std::pair<std::string, std::string> cases[] = {
      {with("u_z", "uz"), "line 2: there is no column 'uz'"},
      {with("u_z", "uz"), "the first line names those of probe, contact_vertex, contact_x .. _z"},
      {with("u_z", "U_Y"), "line 2: the column u_y is there twice"},
      {with("u_z", "u_y"), "line 2: the column u_y is there twice"},
      {with("probe", "radius"), "is there twice"},
      {with("force_z", "vertex"), "line 2: forces are missing"},
      {with("-2e-3", "nan"),
       "line 3: 'nan' is not a finite number: where u_z was not measured, leave it empty"},
      {with("-2e-3", "ten"),
       "line 3: 'ten' is not a number: where u_z was not measured, leave it empty"},
      {with("-2e-3,1e-5", "-2e-3"), "line 3: there are 12 words, but 13 columns"},
      {with("a,,,", "a,1,,"), "line 4: the contact of probe 'a' differs from that in its first"},
      {with("b,3,0,1,0,0", "b,3,0,0,0,0"), "probe b has no force"},
      {with("b,3,", "b,-3,"), "line 5: '-3' is not a whole number from 0"},
      {with("b,3,0,", "b,3,-1,"), "probe b: the radius must not be negative"},
      {with("3e-3,0,0", ",,"), "line 5: no component of the displacement was measured"},
      {with("0,0,1e-5", "0,0,0"), "line 5: a standard deviation must be positive"},
      {with("a,,,,,,1,0,0,,2e-3,0", "a,,,,,,0,0,1,1e-3,0,-2e-3"), "line 4 repeats line 3"},
      {with("a,,,,,,1,0,0,", "a,,,,,,0,0,1,"),
       "line 4 and line 3 give different displacements of one marker under probe a"},
      {"# nothing\n", "there is no line of names"},
      {kTable.substr(0, kTable.find("a,0")), "there is no measured displacement"},
  };
  for (const auto& [text, sentence] : cases)
    EXPECT_TRUE(isRefused([&, &text = text] { read(text); }, sentence));
}

TEST(MeasurementFile, ReadsBackBitByBit) {
  for (bool withDeviations : {false, true}) {
    const ElasticModel model = makeModel(icosphere(1), cap, 1e4, 0.3);
    RigSettings rig;
    rig.withDeviations = withDeviations;
    rig.radius = 0.4;
    const Measurements m = measuredOn(computeGreens(model, {}), model.mesh(), rig);
    const TemporaryPath file;
    writeMeasurementFile(file.path(), m);
    const Measurements again = readMeasurementFile(file.path());
    ASSERT_EQ(again.probes.size(), m.probes.size());
    ASSERT_EQ(again.displacements.size(), m.displacements.size());
    for (std::size_t p = 0; p < m.probes.size(); ++p) {
      EXPECT_EQ(again.probes[p].force, m.probes[p].force);
      EXPECT_EQ(again.probes[p].contact.point, m.probes[p].contact.point);
      EXPECT_EQ(again.probes[p].radius, m.probes[p].radius);
    }
    for (std::size_t i = 0; i < m.displacements.size(); ++i) {
      EXPECT_EQ(again.displacements[i].displacement, m.displacements[i].displacement);
      EXPECT_EQ(again.displacements[i].marker.point, m.displacements[i].marker.point);
      EXPECT_EQ(again.displacements[i].deviation, m.displacements[i].deviation);
      EXPECT_EQ(again.displacements[i].row, m.displacements[i].row);
    }
  }
}

TEST(MeasurementFile, ChangedBytesAreReadOrRefused) {
  std::mt19937 random(7);
  int readCount = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string text = kTable;
    text[random() % text.size()] = static_cast<char>(random() % 256);
    if (trial % 3 == 0) text.resize(random() % text.size());
    try {
      requireSound(read(text));
      ++readCount;
    } catch (const std::invalid_argument&) {
    } catch (const std::runtime_error&) {
    }
  }
  EXPECT_GT(readCount, 50);
}

/// Measurements of a unit sphere, by hand.
Measurements oneRow() {
  Measurements m;
  m.source = "rig";
  m.probes.push_back({"1", {-1, {0, 0, 1}}, 0.3, {0, 0, -1}});
  m.displacements.push_back({0, {-1, {1, 0, 0}}, {0, 0, 1e-3}, {0, 0, 0}, 2});
  return m;
}

TEST(MeasurementFile, AMissingDeviationIsSaid) {
  EXPECT_TRUE(isRefused(
      [] {
        read(
            "probe,contact_vertex,force_x,force_y,force_z,vertex,u_x,u_y,u_z,sd\n"
            "1,0,0,0,1,2,0,0,1e-3,\n");
      },
      "line 2: the standard deviation is missing: give all"));
}

TEST(Measurements, PlacesOffTheSurfaceTellTheirUnit) {
  const ElasticModel model = makeModel(icosphere(2), cap, 1e4, 0.3);
  const auto place = [&](const Measurements& m) {
    placesOn(model.mesh(), model.conditions(), m, 0.05);
  };
  place(oneRow());
  Measurements m = oneRow();
  m.displacements[0].marker.point *= 1000;
  EXPECT_TRUE(isRefused([&] { place(m); }, "rig, line 2: the place (1e+03, 0, 0) is 999 m off"));
  EXPECT_TRUE(isRefused([&] { place(m); }, "times 0.001 it would be on it"));
  m = oneRow();
  m.probes[0].contact.point.z() = 1.4;
  EXPECT_TRUE(isRefused([&] { place(m); }, "register the measurements"));
  m = oneRow();
  m.displacements[0].displacement.x() = 4;
  EXPECT_TRUE(isRefused([&] { place(m); }, "1.16 times the size of the body"));
  m = oneRow();
  m.probes[0].radius = 300;
  EXPECT_TRUE(
      isRefused([&] { place(m); }, "probe 1: a tip of radius 300 m is larger than the body"));
  m = oneRow();
  m.displacements[0].marker.vertex = 162;
  EXPECT_TRUE(isRefused([&] { place(m); }, "there is no vertex 162, the surface has 162"));
  m = oneRow();
  m.probes[0].contact.point.z() = -1;
  EXPECT_TRUE(isRefused([&] { place(m); }, "probe 1 presses on the support"));
}

TEST(Measurements, PlacesAreTheNearestOnTheSurface) {
  const ElasticModel model = makeModel(icosphere(2), cap, 1e4, 0.3);
  Measurements m = oneRow();
  m.displacements[0].marker = {17, Eigen::Vector3d::Zero()};
  const MeasuredPlaces places = placesOn(model.mesh(), model.conditions(), m, 0.05);
  EXPECT_EQ(placeOf(model.mesh(), places.markers[0]), model.mesh().points().col(17));
  EXPECT_NEAR((placeOf(model.mesh(), places.contacts[0]) - Eigen::Vector3d(0, 0, 1)).norm(), 0,
              1e-12);
}

}  // namespace
}  // namespace palpate::test
