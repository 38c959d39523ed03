// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/rig_simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>

#include "identification/registration.h"
#include "identification/registration_changes.h"
#include "identification/robust_statistics.h"
#include "support/data_models.h"
#include "support/refusals.h"
#include "support/rigs.h"

namespace palpate::test {
namespace {

struct Sphere {
  ElasticModel model = makeModel(icosphere(2), cap, 1e4, 0.3);
  std::shared_ptr<const GreensFunctions> greens = computeGreens(model, {});
  Measurements measured(const RigSettings& rig) const {
    return measuredOn(greens, model.mesh(), rig);
  }
};

RigSettings exactRig() {
  RigSettings rig;
  rig.radius = 0.4;
  rig.noise = 0;
  return rig;
}

double largestOf(const Measurements& m) {
  double largest = 0;
  for (const MeasuredDisplacement& u : m.displacements)
    largest = std::max(largest, u.displacement.cwiseAbs().maxCoeff());
  return largest;
}

TEST(RigSimulation, NoiseIsAsLargeAsAskedFor) {
  const Sphere sphere;
  RigSettings rig = exactRig();
  rig.markers = 400;
  const Measurements exact = sphere.measured(rig);
  EXPECT_NEAR(largestOf(exact), 0.01 * sphere.model.mesh().diagonal(), 1e-12);
  rig.noise = 0.02;
  rig.withDeviations = true;
  const Measurements noisy = sphere.measured(rig);
  double square = 0;
  for (std::size_t i = 0; i < exact.displacements.size(); ++i)
    square +=
        (noisy.displacements[i].displacement - exact.displacements[i].displacement).squaredNorm();
  const double deviation = 0.02 * largestOf(exact);
  // 6000 numbers: their deviation is known to 1 %.
  EXPECT_NEAR(std::sqrt(square / (3.0 * exact.displacements.size())) / deviation, 1, 0.05);
  EXPECT_NEAR(noisy.displacements[0].deviation.x() / deviation, 1, 1e-12);
}

TEST(RigSimulation, OutliersAndMissingRowsAreAsManyAsAskedFor) {
  const Sphere sphere;
  RigSettings rig = exactRig();
  rig.markers = 400;
  const Measurements exact = sphere.measured(rig);
  rig.missing = 0.3;
  EXPECT_NEAR(sphere.measured(rig).displacements.size() / 2000.0, 0.7, 0.04);
  rig.missing = 0;
  rig.outliers = 0.1;
  const Measurements spoilt = sphere.measured(rig);
  int wrong = 0;
  for (std::size_t i = 0; i < exact.displacements.size(); ++i)
    wrong += (spoilt.displacements[i].displacement - exact.displacements[i].displacement).norm() >
             0.9 * largestOf(exact);
  EXPECT_NEAR(wrong / 2000.0, 0.1, 0.03);
}

TEST(RigSimulation, TheSameSeedGivesTheSameTable) {
  const Sphere sphere;
  RigSettings rig = exactRig();
  rig.noise = 0.01;
  const Measurements a = sphere.measured(rig), b = sphere.measured(rig);
  EXPECT_EQ(a.displacements[7].displacement, b.displacements[7].displacement);
  rig.seed = 2;
  EXPECT_NE(sphere.measured(rig).probes[0].force, a.probes[0].force);
}

TEST(RigSimulation, SettingsOutOfRangeAreRefused) {
  const Sphere sphere;
  const auto refused = [&](auto change, const std::string& sentence) {
    RigSettings rig = exactRig();
    change(rig);
    return isRefused([&] { sphere.measured(rig); }, sentence);
  };
  EXPECT_TRUE(refused([](RigSettings& r) { r.probes = 0; }, "1 to 1000 probes"));
  EXPECT_TRUE(refused([](RigSettings& r) { r.foundationLength = 0.1; }, "--support-columns"));
  EXPECT_TRUE(refused([](RigSettings& r) { r.noise = -1; }, "noise must be at least 0"));
  EXPECT_TRUE(refused([](RigSettings& r) { r.outliers = 1; }, "below 1, not 1 and 0"));
  EXPECT_TRUE(refused([](RigSettings& r) { r.tilt = 91; }, "0 to 90 degrees, not 91"));
  EXPECT_TRUE(refused([](RigSettings& r) { r.radius = -1; }, "must not be negative, not -1"));
  EXPECT_TRUE(refused([](RigSettings& r) { r.withDeviations = true; }, "Without noise") ||
              refused([](RigSettings& r) { r.withDeviations = true; }, "without noise"));
}

/// A body that no motion but rest brings onto itself.
struct Kidney {
  ElasticModel model = [] {
    const DataModel data = readDataModel("kidney");
    const auto mesh = data.shape.mesh();
    return ElasticModel(mesh, Material(1e4, 0.3), BoundaryConditions(data.boundaryTypes),
                        Eigen::VectorXi::Zero(mesh->triangleCount()));
  }();
  std::shared_ptr<const GreensFunctions> greens = computeGreens(model, {});
};

TEST(Registration, FindsTheFrameOfTheRig) {
  const Kidney kidney;
  const double size = kidney.model.mesh().diagonal();
  RigSettings rig = exactRig();
  rig.radius = 0.2 * size;
  rig.markers = 100;
  const Measurements exact = measuredOn(kidney.greens, kidney.model.mesh(), rig);
  rig.rotation = {3, -4, 2};
  rig.translation = Eigen::Vector3d(0.02, -0.01, 0.015) * size;
  const Measurements seen = measuredOn(kidney.greens, kidney.model.mesh(), rig);
  const Registration found = registerToSurface(kidney.model.mesh(), seen);
  EXPECT_LE(found.distance, 1e-6 * size);
  const Measurements back = registered(seen, found);
  for (std::size_t i = 0; i < exact.displacements.size(); ++i) {
    EXPECT_LE((back.displacements[i].marker.point - exact.displacements[i].marker.point).norm(),
              1e-5 * size);
    EXPECT_LE((back.displacements[i].displacement - exact.displacements[i].displacement).norm(),
              1e-5 * largestOf(exact));
  }
  EXPECT_LE((back.probes[1].force - exact.probes[1].force).norm(),
            1e-5 * exact.probes[1].force.norm());
}

TEST(Registration, FindsFramesHoweverFarAway) {
  const Kidney kidney;
  const double size = kidney.model.mesh().diagonal();
  RigSettings rig = exactRig();
  rig.radius = 0.2 * size;
  rig.markers = 100;
  const Measurements exact = measuredOn(kidney.greens, kidney.model.mesh(), rig);
  for (double away : {3., 100., 1e4})
    for (const Eigen::Vector3d& towards :
         {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(0.3, -0.5, 0.8), Eigen::Vector3d(-1, 2, 3)}) {
      rig.rotation = {3, -4, 2};
      rig.translation = away * size * towards.normalized();
      const Measurements seen = measuredOn(kidney.greens, kidney.model.mesh(), rig);
      const Registration found = registerToSurface(kidney.model.mesh(), seen);
      EXPECT_LE(found.distance, 1e-6 * size) << away << " " << towards.transpose();
      const Measurements back = registered(seen, found);
      EXPECT_LE((back.displacements[7].marker.point - exact.displacements[7].marker.point).norm(),
                1e-4 * size)
          << away << " " << towards.transpose();
    }
}

TEST(Registration, DeviationsGoWithTheNoiseOfPlaces) {
  const Kidney kidney;
  const double size = kidney.model.mesh().diagonal();
  RigSettings rig = exactRig();
  rig.radius = 0.2 * size;
  rig.markers = 200;
  rig.probes = 1;
  Measurements seen = measuredOn(kidney.greens, kidney.model.mesh(), rig);
  for (std::size_t i = 0; i < seen.displacements.size(); ++i)
    seen.displacements[i].marker.point +=
        1e-3 * size * Eigen::Vector3d(std::sin(7.0 * i), std::sin(11.0 * i), std::cos(5.0 * i));
  const Registration found = registerToSurface(kidney.model.mesh(), seen);
  const Eigen::Vector3d centre = kidney.model.mesh().points().rowwise().mean();
  const Eigen::Vector3d moved = found.rotation * centre + found.translation - centre;
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(found.translationDeviation[c], 1e-5 * size);
    EXPECT_LE(std::abs(moved[c]), 5 * found.translationDeviation[c]);
  }
}

TEST(Registration, AFurtherMotionTurnsAboutTheCentreOfThePlaces) {
  Registration known;
  known.rotation = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 2) / 3).toRotationMatrix();
  known.translation = {0.1, 0.2, 0.3};
  known.centre = {1, 0, 2};
  Eigen::Matrix<double, 6, 1> motion;
  motion << 0, 0, M_PI / 2, 0.5, 0, 0;
  const Registration further = moved(known, motion);
  const Eigen::Vector3d sensor = known.rotation.transpose() * (known.centre - known.translation),
                        aside = known.rotation.transpose() *
                                (known.centre + Eigen::Vector3d::UnitX() - known.translation);
  EXPECT_LE((further.rotation * sensor + further.translation - Eigen::Vector3d(1.5, 0, 2)).norm(),
            1e-14);
  EXPECT_LE((further.rotation * aside + further.translation - Eigen::Vector3d(1.5, 1, 2)).norm(),
            1e-14);
}

TEST(Registration, ChangesByWhatItLeavesOpenAreOfItsDeviations) {
  Measurements m;
  m.probes.resize(2);
  for (int i = 0; i < 6; ++i) {
    MeasuredDisplacement u;
    u.probe = i / 3;
    u.marker.point = Eigen::Vector3d(i % 3, 1, 0);  // seen under both probes
    m.displacements.push_back(u);
  }
  Registration known;
  known.placeDeviation = 0.02;
  known.spread.diagonal().setConstant(0.01);
  const Eigen::MatrixXd changes = changesByRegistration(m, known, [](const Measurements& here) {
    Eigen::VectorXd residuals(18);
    for (int i = 0; i < 6; ++i) {
      const MeasuredDisplacement& u = here.displacements[i];
      residuals.segment<3>(3 * i) = 5 * u.marker.point + 7 * here.probes[u.probe].contact.point;
    }
    return residuals;
  });
  ASSERT_EQ(changes.cols(), 6 + 3 * 2 + 3 * 3);
  EXPECT_NEAR(changes(3, 3), 12 * 0.01, 1e-12);  // all along x
  EXPECT_NEAR(changes(1, 2), 0, 1e-6);           // a turn about z of (0, 1, 0)
  EXPECT_NEAR(changes(0, 2), -5 * 0.01, 1e-6);
  EXPECT_NEAR(changes(0, 6), 7 * 0.02, 1e-12);         // the first contact along x
  EXPECT_NEAR(changes(9, 6), 0, 1e-12);                // not under the other probe
  const Eigen::VectorXd marker = changes.col(12 + 1);  // the second along x
  EXPECT_NEAR(marker[3], 5 * 0.02, 1e-12);
  EXPECT_NEAR(marker[12], 5 * 0.02, 1e-12);
  EXPECT_NEAR(marker.cwiseAbs().sum(), 2 * 5 * 0.02, 1e-12);
}

/// Turns off the truth over their deviations: their own deviation, 1 where these hold, by the
/// median, as a set now and then ends at another facet.
double offByDeviations(const Kidney& kidney, int probes) {
  const double size = kidney.model.mesh().diagonal();
  std::vector<double> all;
  constexpr int kSets = 20;
  for (unsigned seed = 1; seed <= kSets; ++seed) {
    RigSettings rig;
    rig.radius = 0.2 * size;
    rig.probes = probes;
    rig.markers = 80;
    rig.placeNoise = 1e-3 * size;
    rig.rotation = {8, -12, 20};
    rig.seed = seed;
    const Measurements m = measuredOn(kidney.greens, kidney.model.mesh(), rig);
    const Registration found = registerToSurface(kidney.model.mesh(), m);
    const double angle = rig.rotation.norm() * M_PI / 180;
    const Eigen::AngleAxisd off(
        Eigen::Matrix3d(found.rotation * Eigen::AngleAxisd(angle, rig.rotation.normalized())));
    for (double turn : (off.angle() * off.axis()).cwiseQuotient(found.rotationDeviation).eval())
      all.push_back(std::abs(turn));
  }
  return medianDeviation(std::move(all));
}

// A marker that nine probes saw tells no more of the frame than one that one did: counted nine
// times deviations would be a third.
TEST(Registration, DeviationsAreAsGoodHoweverManyProbesSawTheMarkers) {
  const Kidney kidney;
  const double one = offByDeviations(kidney, 1), nine = offByDeviations(kidney, 9);
  EXPECT_LT(nine, 1.6 * one);
  for (double off : {one, nine}) {
    EXPECT_GT(off, 0.6);
    EXPECT_LT(off, 1.6);
  }
}

TEST(Registration, WhatASurfaceCannotTellIsNamed) {
  const Sphere sphere;
  const Measurements m = sphere.measured(exactRig());
  EXPECT_TRUE(isRefused([&] { registerToSurface(sphere.model.mesh(), m); },
                        "do not tell the rotation about"));
  Measurements few = m;
  few.displacements.resize(2);
  few.probes.resize(1);
  EXPECT_TRUE(isRefused([&] { registerToSurface(sphere.model.mesh(), few); },
                        "at least 6 different places"));
  const Kidney kidney;
  RigSettings rig = exactRig();
  rig.probes = 1;
  rig.radius = 0.2 * kidney.model.mesh().diagonal();
  Measurements line = measuredOn(kidney.greens, kidney.model.mesh(), rig);
  for (std::size_t i = 0; i < line.displacements.size(); ++i)
    line.displacements[i].marker.point =
        line.probes[0].contact.point + 1e-4 * double(i) * Eigen::Vector3d::UnitX();
  EXPECT_TRUE(isRefused([&] { registerToSurface(kidney.model.mesh(), line); }, "do not tell"));
}

}  // namespace
}  // namespace palpate::test
