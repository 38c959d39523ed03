// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The two displacements that a masked stiffness can go by, side by side: the vertex's own (eq. 32)
// and the mean under the mask. Every figure is recorded as a property (--gtest_output=xml).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/LU>

#include "support/contact_bodies.h"
#include "support/watched_contact.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr DisplacementMeasure kVertex = DisplacementMeasure::Vertex;
constexpr DisplacementMeasure kMean = DisplacementMeasure::Mean;

std::shared_ptr<const SurfaceStiffness> stiffnessBy(DisplacementMeasure measure,
                                                    const TouchedBody& body, double radiusInEdges) {
  const PressureMasks masks(*body.mesh, body.greens->info().conditions, MaskShape::Linear,
                            radiusInEdges * body.mesh->meanEdgeLength());
  return std::make_shared<SurfaceStiffness>(body.greens, body.mesh, masks,
                                            StiffnessOptions{0, measure});
}

void record(const std::string& what, double value) {
  testing::Test::RecordProperty(what, std::to_string(value));
  std::printf("%-44s %.6g\n", what.c_str(), value);
}

std::string nameOf(DisplacementMeasure measure) {
  return measure == kVertex ? "vertex" : "mean";
}

TEST(DisplacementMeasures, TheVertexsOwnIsTheSmootherOverAnIrregularMesh) {
  // The mean weighs what single nodes yield by the mask squared. A hole: A spherical hole in
  // infinite space is the same everywhere but for its mesh.
  const Shape shape = jitteredSphere(3, 0.2);
  const TouchedBody body = touchedBody(shape, fixedWhere(shape, [](const auto&) { return false; }),
                                       true, Domain::Exterior);
  for (double radius : {1.0, 1.5, 2.0, 3.0}) {
    double variation[2];
    for (DisplacementMeasure measure : {kVertex, kMean}) {
      const auto stiffness = stiffnessBy(measure, body, radius);
      Eigen::ArrayXd norms(body.mesh->vertexCount());
      for (int v = 0; v < norms.size(); ++v) norms[v] = stiffness->elastic(v).norm();
      const double mean = norms.mean();
      variation[measure == kMean] = std::sqrt((norms - mean).square().mean()) / mean;
      const std::string at =
          nameOf(measure) + ", " + std::to_string(radius).substr(0, 3) + " edges";
      record("variation " + at, variation[measure == kMean]);
      record("peak to peak " + at, (norms.maxCoeff() - norms.minCoeff()) / mean);
    }
    EXPECT_LT(variation[0], variation[1]) << radius;
    EXPECT_LT(variation[1], 0.25 / radius / radius) << "both level out as the mask widens";
  }
}

/// What sliding without friction round a circle of latitude, at a depth, does for the hand.
struct Loop {
  double work;         ///< over the force's length times the way's
  double byStiffness;  ///< the header's bound's part by the variation of K, likewise
};
Loop slideRound(const std::shared_ptr<const SurfaceStiffness>& stiffness, double latitude) {
  constexpr double kDepth = 0.05;
  const auto place = [&](double turn, double radius) -> Eigen::Vector3d {
    return radius * Eigen::Vector3d(std::cos(latitude) * std::cos(turn),
                                    std::cos(latitude) * std::sin(turn), std::sin(latitude));
  };
  WatchedContact probe(stiffness, 0);
  probe.advance(place(0, 1.2));
  probe.moveTo(place(0, 1 - kDepth), 1e-3);
  constexpr int kTicks = 4000;
  const auto once = [&] {
    for (int i = 1; i <= kTicks; ++i) probe.advance(place(2 * kPi * i / kTicks, 1 - kDepth));
  };
  once();  // from where it landed to where it settles
  probe.work = probe.byStiffness = 0;
  once();
  const double way = 2 * kPi * std::cos(latitude) * (1 - kDepth);
  const double scale = way * probe.contact.force().norm();
  return {std::abs(probe.work) / scale, probe.byStiffness / scale};
}

TEST(DisplacementMeasures, SlidingRoundAClosedPathGivesBackNextToNothing) {
  const TouchedBody body = touchedSphere(3, true);
  for (double radius : {1.0, 2.0, 3.0}) {
    double given[2];
    for (DisplacementMeasure measure : {kVertex, kMean}) {
      const auto stiffness = stiffnessBy(measure, body, radius);
      Loop worst{0, 0};
      for (double latitude : {0.0, 0.3, 0.8}) {
        const Loop loop = slideRound(stiffness, latitude);
        worst = {std::max(worst.work, loop.work), std::max(worst.byStiffness, loop.byStiffness)};
      }
      const std::string at =
          nameOf(measure) + ", " + std::to_string(radius).substr(0, 3) + " edges";
      record("loop work " + at, worst.work);
      record("its bound by stiffness " + at, worst.byStiffness);
      given[measure == kMean] = worst.byStiffness;
      EXPECT_LE(worst.work, 0.005) << "of the force times the way";
    }
    EXPECT_LT(given[0], given[1]) << radius << ": K varies less";
  }
}

/// The compliance of a point between vertices under its combined mask, by either measure.
Eigen::Matrix3d complianceAt(const SurfaceStiffness& stiffness, int triangle,
                             const Eigen::Vector3d& at) {
  const GreensFunctions& greens = stiffness.greens();
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero(), block;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      const int v = stiffness.mesh().triangles()(k, triangle);
      const VertexMask& from = stiffness.mask(stiffness.mesh().triangles()(l, triangle));
      VertexMask seen{{v}, Eigen::VectorXd::Constant(1, 1 / greens.vertexArea(v))};
      if (stiffness.measure() == kMean) seen = stiffness.mask(v);
      for (std::size_t i = 0; i < seen.nodes.size(); ++i)
        for (std::size_t j = 0; j < from.nodes.size(); ++j) {
          greens.gather(nodeList({seen.nodes[i]}), nodeList({from.nodes[j]}), block.data());
          sum += at[k] * at[l] * greens.vertexArea(seen.nodes[i]) * seen.density[i] *
                 from.density[j] * block;
        }
    }
  return sum;
}

TEST(DisplacementMeasures, InterpolatedStiffnessFollowsTheMeanMoreCloselyBetweenVertices) {
  const TouchedBody body = touchedSphere(2, true);
  const Eigen::Vector3d centre = Eigen::Vector3d::Constant(1 / 3.);
  for (double radius : {1.0, 2.0}) {
    double median[2];
    for (DisplacementMeasure measure : {kVertex, kMean}) {
      const auto stiffness = stiffnessBy(measure, body, radius);
      std::vector<double> errors;
      for (int f = 0; f < body.mesh->triangleCount(); ++f) {
        const Eigen::Vector3i corners = body.mesh->triangles().col(f);
        if (std::any_of(corners.begin(), corners.end(),
                        [&](int v) { return body.greens->isFixed(v); }))
          continue;
        const Eigen::Matrix3d moved =
            complianceAt(*stiffness, f, centre) * stiffness->elasticAt(f, centre);
        errors.push_back((moved - Eigen::Matrix3d::Identity()).operatorNorm());
      }
      std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
      median[measure == kMean] = errors[errors.size() / 2];
      record("off eq. 34 in faces, " + nameOf(measure) + ", " + std::to_string(radius).substr(0, 3),
             median[measure == kMean]);
    }
    EXPECT_LT(median[1], median[0]);
  }
}

TEST(DisplacementMeasures, TheMeanNeedsNoProjectionAndTheVertexsOwnALittle) {
  const TouchedBody body = touchedSphere(3, true);
  for (double radius : {1.0, 2.0, 3.0}) {
    for (DisplacementMeasure measure : {kVertex, kMean}) {
      const auto stiffness = stiffnessBy(measure, body, radius);
      double largest = 0;
      std::vector<double> astray;  // what symmetrising costs: |C K - 1|, C of the own measure
      for (int f = 0; f < body.mesh->triangleCount(); f += 3) {
        const int v = body.mesh->triangles()(0, f);
        if (body.greens->isFixed(v)) continue;
        largest = std::max(largest, stiffness->asymmetry(v));
        astray.push_back(
            (complianceAt(*stiffness, f, Eigen::Vector3d::UnitX()) * stiffness->elastic(v) -
             Eigen::Matrix3d::Identity())
                .operatorNorm());
      }
      std::sort(astray.begin(), astray.end());
      record("astray, median " + nameOf(measure) + ", " + std::to_string(radius).substr(0, 3),
             astray[astray.size() / 2]);
      record("astray, largest " + nameOf(measure) + ", " + std::to_string(radius).substr(0, 3),
             astray.back());
      record("largest asymmetry " + nameOf(measure) + ", " + std::to_string(radius).substr(0, 3),
             largest);
      if (measure == kMean) {
        EXPECT_LE(largest, 1e-12);
        EXPECT_LE(astray.back(), 1e-11);
      } else {
        EXPECT_LE(largest, 0.3) << "at the support, where the masks are one-sided";
        EXPECT_LE(astray[astray.size() / 2], 0.03);
      }
    }
  }
}

struct Reference {
  DisplacementMeasure measure;
  double normal, tangential;
};
class DisplacementMeasuresAtThePole : public testing::TestWithParam<Reference> {};

TEST_P(DisplacementMeasuresAtThePole, AgreeWithTheFiniteElementReference) {
  // The clamped sphere of clamped_sphere_test; hp finite elements, error <= 1e-5 (E = 1, nu = .3).
  const double rim = 2 * std::asin(0.15), clamp = std::acos(-0.8);
  for (const auto& [underMask, atClamp, bound] :
       {std::tuple(0.1, 0.04, 0.05), std::tuple(0.05, 0.015, 0.01)}) {
    const double under = underMask, at = atClamp;
    const Shape shape = ringedSphere(
        [=](double angle) {
          return std::min(
              {0.3, under + 0.4 * std::max(0., angle - rim), at + 0.5 * std::abs(angle - clamp)});
        },
        {rim, clamp});
    const ElasticModel model(
        shape.mesh(), Material(1, 0.3),
        BoundaryConditions(fixedWhere(shape, [](const auto& x) { return x.z() < -0.8 + 1e-9; })),
        Eigen::VectorXi::Zero(shape.triangles.cols()));
    const VertexMask mask =
        PressureMasks(model.mesh(), model.conditions(), MaskShape::Linear, 0.3).at(0);
    BoundaryElementOptions options;
    options.columns = mask.nodes;
    const Eigen::Matrix3d compliance =
        maskedVertexStiffness(*computeGreens(model, options), 0, mask, GetParam().measure)
            .stiffness.inverse();
    const std::string of =
        nameOf(GetParam().measure) + ", n = " + std::to_string(shape.points.cols());
    record("normal error " + of, compliance(2, 2) / GetParam().normal - 1);
    record("tangential error " + of, compliance(0, 0) / GetParam().tangential - 1);
    EXPECT_NEAR(compliance(2, 2) / GetParam().normal, 1, bound);
    EXPECT_NEAR(compliance(0, 0) / GetParam().tangential, 1, bound);
  }
}
INSTANTIATE_TEST_SUITE_P(References, DisplacementMeasuresAtThePole,
                         testing::Values(Reference{kVertex, 3.137999, 15.631981},
                                         Reference{kMean, 2.363210, 14.488805}));

}  // namespace
}  // namespace palpate::test
