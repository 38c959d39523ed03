// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "halfspace/half_space_greens_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "support/allocation_count.h"
#include "support/half_space.h"
#include "support/refusals.h"
#include "support/synthetic_greens.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRatios[] = {-0.9, -0.5, 0, 0.3, 0.45, 0.5};

/// Boussinesq's and Cerruti's displacement at d from a force, as the textbooks have it: components
/// one by one, z into the material (Landau & Lifshitz, "Theory of elasticity", section 8).
Eigen::Vector3d textbook(const Eigen::Vector2d& d, const Eigen::Vector3d& force, double e,
                         double nu) {
  const double x = d.x(), y = d.y(), r = d.norm(), fx = force.x(), fy = force.y(), fz = -force.z();
  const double factor = (1 + nu) / (2 * kPi * e * r), along = (x * fx + y * fy) / r;
  return factor *
         Eigen::Vector3d(-(1 - 2 * nu) * x / r * fz + 2 * (1 - nu) * fx + 2 * nu * x / r * along,
                         -(1 - 2 * nu) * y / r * fz + 2 * (1 - nu) * fy + 2 * nu * y / r * along,
                         -(2 * (1 - nu) * fz + (1 - 2 * nu) * along));
}

/// Nodal tractions p(r) along a direction within a disc about the origin.
template <class Pressure>
Eigen::Matrix3Xd spread(const SurfaceMesh& mesh, const Pressure& p,
                        const Eigen::Vector3d& direction) {
  Eigen::Matrix3Xd tractions(3, mesh.vertexCount());
  for (int v = 0; v < mesh.vertexCount(); ++v)
    tractions.col(v) = p(mesh.points().col(v).norm()) * direction;
  return tractions;
}

/// The displacement at a vertex along the direction of the tractions.
double displacement(const HalfSpace& body, const Eigen::Matrix3Xd& tractions, int vertex,
                    const Eigen::Vector3d& direction) {
  Eigen::VectorXi all =
      Eigen::VectorXi::LinSpaced(body.mesh->vertexCount(), 0, body.mesh->vertexCount() - 1);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(3);
  body.greens->accumulate(all, tractions.reshaped(), Eigen::VectorXi::Constant(1, vertex), out);
  return direction.dot(Eigen::Vector3d(out));
}

TEST(HalfSpaceGreensFunctions, FarAwayAreBoussinesqsAndCerrutis) {
  for (double nu : kRatios) {
    // A hat of six equal triangles and radius 0.1, ten and a hundred radii away: what a hat's
    // second moment adds to a force is a tenth of (radius / distance)^2.
    const Shape hat = disc(0.1, 1);
    for (double distance : {1., 10.}) {
      const HalfSpace body =
          halfSpace(hat.with(hat.moved({0.8 * distance, -0.6 * distance, 0})), nu, true, 2.5);
      const Eigen::Matrix3d block = blockOf(*body.greens, 7, 0) / body.greens->vertexArea(0);
      for (int j = 0; j < 3; ++j) {
        const Eigen::Vector3d exact =
            textbook({0.8 * distance, -0.6 * distance}, Eigen::Vector3d::Unit(j), 2.5, nu);
        EXPECT_LE((block.col(j) - exact).norm() / exact.norm(), 0.3 * std::pow(0.1 / distance, 2))
            << "nu " << nu << ", distance " << distance;
      }
    }
  }
}

/// A12: u_z = C (1 - nu^2) F / (E a) in the middle of a loaded disc. The mesh ends at the disc's
/// rim.
template <class Pressure>
double centreError(int rings, double exact, const Pressure& pressure) {
  const HalfSpace body = halfSpace(disc(1, rings), 0.3, false);
  const Eigen::Matrix3Xd tractions = spread(*body.mesh, pressure, Eigen::Vector3d::UnitZ());
  const double force = kPi;  // all three pressures are scaled to a mean of 1
  return displacement(body, tractions, 0, Eigen::Vector3d::UnitZ()) / (exact * (1 - 0.09) * force) -
         1;
}

TEST(HalfSpaceGreensFunctions, LoadedDiscsSinkAsTheirClosedForms) {
  struct Case {
    double (*pressure)(double r);
    double exact, error, order;  // with 16 rings
  };
  const Case cases[] = {
      // A polygon lacks area like h^2; so does a cone, which is straight between its vertices;
      // Hertz's
      // root at the rim is missed by h^1.5.
      {[](double) { return 1.; }, 2 / kPi, 5e-4, 2},
      {[](double r) { return std::max(0., 3 * (1 - r)); }, 3 / kPi, 3e-3, 1.7},
      {[](double r) { return 1.5 * std::sqrt(std::max(0., 1 - r * r)); }, 0.75, 8e-3, 1.55}};
  for (const Case& c : cases) {
    const double coarse = centreError(8, c.exact, c.pressure),
                 fine = centreError(16, c.exact, c.pressure);
    EXPECT_LE(std::abs(fine), c.error);
    EXPECT_NEAR(std::log2(coarse / fine), c.order, 0.15) << "C = " << c.exact;
  }
}

TEST(HalfSpaceGreensFunctions, AReciprocalCompliancesErrorFallsWithTheMesh) {
  // It is the mean under one hat of what forces at the other vertices do, which is of first order.
  const auto error = [](int rings) {
    const HalfSpace body = halfSpace(disc(1, rings), 0.3, true);
    const auto uniform = [](double) { return 1.; };
    return displacement(body, spread(*body.mesh, uniform, Eigen::Vector3d::UnitZ()), 0,
                        Eigen::Vector3d::UnitZ()) /
               (2 * (1 - 0.09)) -
           1;
  };
  EXPECT_LE(std::abs(error(8)), 3e-3);
  EXPECT_LE(std::abs(error(24)), 1e-3);
}

TEST(HalfSpaceGreensFunctions, AConesProfileIsThatOfTheTable) {
  const double radii[] = {0, .25, .5, .75, 1, 1.5, 2, 3, 5};  // A13
  const double table[] = {.954930, .872368, .709673, .521640, .355050,
                          .220320, .162362, .107015, .063855};
  const HalfSpace body = halfSpace(disc(5, 40), 0.3, false);
  Eigen::Matrix3Xd tractions = spread(
      *body.mesh, [](double r) { return r < 1 ? 3 * (1 - r) / kPi : 0; }, Eigen::Vector3d::UnitZ());
  tractions /= (tractions * body.greens->info().vertexAreas).z();  // F = 1: rings are polygons
  for (int i = 0; i < 9; ++i) {
    Eigen::Index vertex;
    (body.mesh->points().colwise() - Eigen::Vector3d(radii[i], 0, 0))
        .colwise()
        .norm()
        .minCoeff(&vertex);
    // Eight rings to the cone: half a percent of the force is nearer or farther than it should be.
    EXPECT_NEAR(displacement(body, tractions, int(vertex), Eigen::Vector3d::UnitZ()) / (1 - 0.09) /
                    table[i],
                1, 7e-3)
        << "r / a = " << radii[i];
  }
}

TEST(HalfSpaceGreensFunctions, AcrossAreSofterOrStifferThanDownByPoissonsRatioAlone) {
  // A14, exact for any load and mesh that is the same under turns by a third.
  for (double nu : kRatios) {
    const HalfSpace body = halfSpace(disc(1, 6), nu, true);
    const auto load = [](double r) { return 1 - r * r / 2; };
    const double down = displacement(body, spread(*body.mesh, load, Eigen::Vector3d::UnitZ()), 0,
                                     Eigen::Vector3d::UnitZ());
    for (const Eigen::Vector3d& way : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.6, -0.8, 0)})
      EXPECT_NEAR(displacement(body, spread(*body.mesh, load, way), 0, way) / down,
                  (2 - nu) / (2 * (1 - nu)), 1e-12);
  }
}

TEST(HalfSpaceGreensFunctions, ServedAreReciprocalAndPositiveDefinite) {
  for (double nu : kRatios)
    for (const Shape& shape : {jitteredPlate(1, 8, 0.3), disc(1, 5)}) {
      const HalfSpace body = halfSpace(shape, nu);
      Eigen::MatrixXd force = denseMatrix(*body.greens);
      for (int v = 0; v < body.mesh->vertexCount(); ++v)
        force.middleCols<3>(3 * v) /= body.greens->vertexArea(v);
      EXPECT_LE((force - force.transpose()).norm(), 1e-14 * force.norm());
      EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(force).eigenvalues().minCoeff(), 0);
      EXPECT_TRUE(body.greens->info().reciprocal);
    }
}

TEST(HalfSpaceGreensFunctions, TheDefectMeasuredIsThatOfTheRawOnes) {
  const HalfSpace raw = halfSpace(jitteredPlate(1, 8, 0.3), 0.3, false);
  Eigen::MatrixXd force = denseMatrix(*raw.greens);
  for (int v = 0; v < raw.mesh->vertexCount(); ++v)
    force.middleCols<3>(3 * v) /= raw.greens->vertexArea(v);
  const double defect = (force - force.transpose()).norm() / force.norm();
  EXPECT_NEAR(raw.greens->info().diagnostics.reciprocityDefect, defect, 1e-12);
  EXPECT_GT(defect, 0.01);
  EXPECT_FALSE(raw.greens->info().reciprocal);
}

TEST(HalfSpaceGreensFunctions, AreTheSameInAnyPlaneAndUnit) {
  const Shape shape = jitteredPlate(1, 6, 0.3);
  const HalfSpace here = halfSpace(shape, 0.3);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (double scale : {1e-6, 1e-3, 1., 1e3, 1e6}) {
    const HalfSpace there =
        halfSpace(shape.mapped([&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
          return scale * (turn * x + Eigen::Vector3d(3, 4, -5));
        }),
                  0.3, true, 1e6);
    for (int row : {0, 10, 24})
      for (int column : {0, 24, 31}) {
        const Eigen::Matrix3d expected =
            scale * 1e-6 * turn * blockOf(*here.greens, row, column) * turn.transpose();
        EXPECT_LE((blockOf(*there.greens, row, column) - expected).norm(), 1e-12 * expected.norm());
      }
  }
}

TEST(HalfSpaceGreensFunctions, AllWaysToThemAgree) {
  const HalfSpace body = halfSpace(jitteredPlate(1, 5, 0.3), 0.3, true, 2);
  std::mt19937 random(1);
  const std::vector<int> columns{3, 30, 0}, rows{5, 3, 35, 7};
  const Eigen::VectorXd weights = randomVectors(3, random).reshaped();
  Eigen::MatrixXd blocks(12, 9);
  body.greens->gather(nodeList(rows), nodeList(columns), blocks.data());
  Eigen::VectorXd some = Eigen::VectorXd::Ones(12), all = Eigen::VectorXd::Ones(3 * 36);
  const long before = allocationCount();
  body.greens->accumulate(nodeList(columns), weights, nodeList(rows), some);
  body.greens->accumulate(nodeList(columns), weights, all);
  body.greens->gather(nodeList(rows), nodeList(columns), blocks.data());
  EXPECT_EQ(allocationCount(), before);
  EXPECT_LE((some - Eigen::VectorXd::Ones(12) - blocks * weights).norm(), 1e-14);
  for (int r = 0; r < 4; ++r)
    EXPECT_LE((all.segment<3>(3 * rows[r]) - some.segment<3>(3 * r)).norm(), 1e-14);

  const auto stiffer = body.greens->withYoungsModulus(5);
  EXPECT_EQ(stiffer->info().material.youngsModulus(), 5);
  EXPECT_LE((blockOf(*stiffer, 3, 30) - 0.4 * blockOf(*body.greens, 3, 30)).norm(), 1e-15);
}

TEST(HalfSpaceGreensFunctions, OfColumnsThatWereAskedForAlone) {
  const auto mesh = plate(1, 4).sheet();
  HalfSpaceOptions options;
  options.columns = {7, 3, 7};
  const auto greens = computeHalfSpaceGreensFunctions(halfSpaceModel(mesh), options);
  EXPECT_EQ(greens->info().columnNodes, (std::vector<int>{3, 7}));
  EXPECT_EQ(greens->missingCount(), 23);
  options.columns = {25};
  EXPECT_TRUE(isRefused([&] { computeHalfSpaceGreensFunctions(halfSpaceModel(mesh), options); },
                        "there is no node 25"));
}

}  // namespace
}  // namespace palpate::test
