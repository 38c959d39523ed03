// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// NAFEMS, "The Standard NAFEMS Benchmarks", 1990, test LE10: a quarter of a thick elliptic plate
// with an elliptic hole under a pressure on its top. Its planes of symmetry hold the displacement
// across them, its outer face holds x and y, the line in the middle of that face z, too. At D, the
// top of the hole on the x axis, sigma_yy = -5.38 MPa.

#include <gtest/gtest.h>

#include <cmath>

#include "fem/surface_response.h"
#include "greens/probe_rows.h"
#include "support/solids.h"

namespace palpate::test {
namespace {

constexpr double kYoungsModulus = 210e9, kPoissonRatio = 0.3, kPressure = 1e6;
constexpr double kThickness = 0.6, kReference = -5.38e6;
const Eigen::Vector3d kPointD(2, 0, kThickness);

/// Finer towards the hole, the x axis and the top. Even divisions across the thickness have points
/// in its middle.
TetrahedralMesh plate(const Eigen::Vector3i& divisions) {
  const double quarter = std::acos(0.0), ratio = 1.5;
  return kuhnBox({1, 1, 1}, divisions)
      .mapped([=](const Eigen::Vector3d& x) -> Eigen::Vector3d {
        const double out = std::pow(x.x(), ratio), angle = quarter * std::pow(x.y(), ratio);
        return {(2 + 1.25 * out) * std::cos(angle), (1 + 1.75 * out) * std::sin(angle),
                kThickness * x.z()};
      })
      .mesh();
}

bool isOuter(const Eigen::Vector3d& x) {
  return std::abs(std::hypot(x.x() / 3.25, x.y() / 2.75) - 1) < 1e-9;
}

bool isFixed(const Eigen::Vector3d& x) {
  return isOuter(x) && std::abs(x.z() - kThickness / 2) < 1e-9;
}

HeldDisplacements heldOf(const SurfaceMesh& mesh) {
  HeldDisplacements held(3, mesh.vertexCount());
  for (int v = 0; v < mesh.vertexCount(); ++v) {
    const Eigen::Vector3d x = mesh.points().col(v);
    held.col(v) << (isOuter(x) || x.x() < 1e-9), (isOuter(x) || x.y() < 1e-9), isFixed(x);
  }
  return held;
}

/// Just inside each tetrahedron that has its corner at D.
Eigen::Matrix3Xd besideD(const TetrahedralMesh& mesh) {
  std::vector<Eigen::Vector3d> places;
  for (const auto& cell : mesh.tetrahedra().colwise()) {
    const Eigen::Matrix<double, 3, 4> corners = mesh.points()(Eigen::all, cell);
    if ((corners.colwise() - kPointD).colwise().norm().minCoeff() < 1e-9)
      places.push_back(kPointD + 1e-6 * (corners.rowwise().mean() - kPointD));
  }
  Eigen::Matrix3Xd points(3, places.size());
  for (std::size_t i = 0; i < places.size(); ++i) points.col(i) = places[i];
  return points;
}

/// sigma_yy at D, Pa: the mean of the tetrahedra that meet there.
double stressAtD(const Eigen::Vector3i& divisions, SolidElement element) {
  const SolidProblem problem =
      solidProblem(plate(divisions), isFixed, kYoungsModulus, kPoissonRatio);
  const SurfaceMesh& mesh = problem.model.mesh();
  const Eigen::VectorXi& patches = problem.model.smoothPatches();
  std::vector<fem::LoadHat> hats;
  std::vector<fem::WantedColumn> wanted;
  for (int v : problem.model.conditions().freeNodes())
    for (int f : mesh.trianglesOfVertex(v)) {
      if (mesh.triangleNormals()(2, f) < 0.99) continue;
      wanted.push_back({fem::WantedColumn::Traction, static_cast<int>(hats.size())});
      hats.push_back({v, patches[f]});
      break;
    }
  const Eigen::Matrix3Xd points = besideD(problem.body.mesh());
  fem::SolidSystem system(problem.model, problem.body, element, std::move(hats), heldOf(mesh),
                          fem::locateProbes(problem.body, points), Progress());
  const double stiffness = system.stiffness;
  const Eigen::MatrixXd probes =
      fem::surfaceResponse(std::move(system), problem.model, wanted, {0, 1}, Progress()).probes;
  double stress = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    ProbeValues values = ProbeValues::Zero();
    for (std::size_t c = 0; c < wanted.size(); ++c)
      values -= kPressure / stiffness * probes.block<13, 1>(13 * i, 3 * c + 2);
    stress += fieldOf(values, problem.body.material(0).stiffness()).stress(1, 1) / points.cols();
  }
  return stress;
}

TEST(ThickPlateLe10, IsStressedAtDAsPublished) {
  // Measured over -5.38 MPa: 1.047, 1.027, 1.019 (and 1.015 at 16 by 24 by 8) by quadratic
  // tetrahedra, 0.65, 0.86, 0.94 by linear ones, whose stress is constant in each.
  const Eigen::Vector3i coarse(4, 6, 2), middle(8, 12, 4), fine(12, 18, 6);
  const auto errors = [&](SolidElement element) {
    Eigen::Vector3d found;
    int i = 0;
    for (const Eigen::Vector3i& divisions : {coarse, middle, fine})
      found[i++] = std::abs(stressAtD(divisions, element) / kReference - 1);
    return found;
  };
  const Eigen::Vector3d quadratic = errors(SolidElement::Quadratic);
  EXPECT_LT(quadratic[0], 0.06);
  EXPECT_LT(quadratic[1], 0.65 * quadratic[0]);
  EXPECT_LT(quadratic[2], 0.8 * quadratic[1]);
  EXPECT_LT(quadratic[2], 0.025);
  const Eigen::Vector3d linear = errors(SolidElement::Linear);
  EXPECT_LT(linear[1], 0.5 * linear[0]);
  EXPECT_LT(linear[2], 0.6 * linear[1]);
  EXPECT_GT(linear[2], 2 * quadratic[2]);
}

}  // namespace
}  // namespace palpate::test
