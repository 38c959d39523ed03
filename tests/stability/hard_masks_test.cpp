// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Pressure masks across thin walls, gaps and supports, on bad triangles and of absurd radii.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/mask_settings.h"
#include "stability/hard_case.h"
#include "support/pole_compliance.h"
#include "support/problems.h"

namespace palpate::test {
namespace {

HardCase hard(const std::string& name, const std::string& danger) {
  return {"masks", name, danger};
}

/// A surface with a boundary type a vertex, and masks on it of every kind.
struct Surface {
  Surface(const Shape& shape, const Place& fixed)
      : mesh(shape.mesh()), conditions(fixedWhere(shape, fixed)) {}

  int vertexNear(const Eigen::Vector3d& place) const {
    Eigen::Index vertex;
    (mesh->points().colwise() - place).colwise().norm().minCoeff(&vertex);
    return static_cast<int>(vertex);
  }
  double force(const VertexMask& mask) const {
    return mesh->vertexAreas()(mask.nodes).dot(mask.density);
  }
  /// Calls with the masks of every kind of a radius.
  template <class Call>
  void forEachKind(double radius, const Call& call) const {
    for (const MaskKind kind : {MaskKind::Linear, MaskKind::Uniform, MaskKind::Gaussian,
                                MaskKind::Hertzian, MaskKind::Gradient, MaskKind::Biharmonic})
      call(*makeMasks(*mesh, conditions, {kind, radius}));
#ifdef PALPATE_WITH_CGAL
    call(*makeMasks(*mesh, conditions, {MaskKind::Linear, radius, MaskDistance::Geodesic}));
#endif
  }
  /// The same of radial masks, which end.
  template <class Call>
  void forEachRadialKind(double radius, const Call& call) const {
    for (const MaskShape shape :
         {MaskShape::Linear, MaskShape::Uniform, MaskShape::Gaussian, MaskShape::Hertzian})
      call(PressureMasks(*mesh, conditions, shape, radius));
#ifdef PALPATE_WITH_CGAL
    call(PressureMasks(*mesh, conditions, MaskShape::Linear, radius, MaskDistance::Geodesic));
#endif
  }

  std::shared_ptr<const SurfaceMesh> mesh;
  BoundaryConditions conditions;
};

bool nowhere(const Eigen::Vector3d&) {
  return false;
}
bool lower(const Eigen::Vector3d& x) {
  return x.z() < -0.6;
}

TEST(Masks, NeverReachTheFarSideOfAWall) {
  for (const double thickness : {0.05, 1e-6}) {
    const Surface plate(box({1, 1, thickness}, {8, 8, 1}), nowhere);
    double farSide = 0;
    for (const double radius : {0.2, 0.6, 3.0})
      for (const Eigen::Vector3d& place :
           {Eigen::Vector3d(0.5, 0.5, thickness), Eigen::Vector3d(0.125, 0.5, thickness)})
        plate.forEachRadialKind(radius, [&](const VertexMasks& masks) {
          const VertexMask mask = masks.at(plate.vertexNear(place));
          for (std::size_t j = 0; j < mask.nodes.size(); ++j)
            if (plate.mesh->points()(2, mask.nodes[j]) < thickness)
              farSide += plate.mesh->vertexAreas()[mask.nodes[j]] * mask.density[j];
        });
    hard(thickness < 1e-3 ? "walls of 1e−6, masks of 0.2 … 3" : "walls of 0.05, masks of 0.2 … 3",
         "a push that acts on both sides at once")
        .expectAtMost("force on the far side", farSide, 0);
  }
  const Surface ring(torus(1, 0.8, 24, 24), nowhere);
  const int inside = ring.vertexNear({0.2, 0, 0});
  const Eigen::Vector3d normal = ring.mesh->vertexNormals().col(inside);
  double least = 1;
  ring.forEachRadialKind(1, [&](const VertexMasks& masks) {
    for (int node : masks.at(inside).nodes)
      least = std::min(least, ring.mesh->vertexNormals().col(node).dot(normal));
  });
  hard("the narrow inside of a torus, masks wider than it", "a push across the hole")
      .expectAtLeast("least cosine between the mask's normals and its centre's", least, 0);
}

TEST(Masks, DoNotFeelASecondBodyThatApproaches) {
  const Shape one = icosphere(2);
  const Eigen::Matrix3d alone = poleCompliance(makeModel(one, cap, 1, 0.3));
  double worst = 0;
  for (const double gap : {1e-1, 1e-3, 1e-5}) {
    // Above the pole that is pressed, within the mask's radius of 0.6.
    const ElasticModel model = makeModel(
        one.with(one.moved({0, 0, 2 + gap})),
        [&](const Eigen::Vector3d& x) {
          return cap(x) || cap(Eigen::Vector3d(x.x(), x.y(), 2 + gap - x.z()));
        },
        1, 0.3);
    const PressureMasks masks(model.mesh(), model.conditions(), MaskShape::Linear, 0.6);
    const VertexMask mask = masks.at(0);
    BoundaryElementOptions options;
    options.columns = mask.nodes;
    worst = std::max(
        worst,
        complianceChange(
            maskedVertexStiffness(*computeGreens(model, options), 0, mask).stiffness.inverse(),
            alone));
  }
  hard("a second body 1e−1, 1e−3, 1e−5 from the pole that is pressed", "the compliance halves")
      .expectAtMost("largest change of the compliance", worst, 1e-3);
}

TEST(Masks, TransmitTheirForceAtTheSupport) {
  const Surface sphere(jitteredSphere(2, 0.2), lower);
  double worst = 0;
  for (const double radius : {0.3, 0.6, 1.5})
    sphere.forEachKind(radius, [&](const VertexMasks& masks) {
      for (int v : sphere.conditions.freeNodes())
        worst = std::max(worst, std::abs(sphere.force(masks.at(v)) - 1));
    });
  // NUMERICS.md section 5: of sums of up to 140 numbers.
  hard("masks of every kind that overlap the support", "a force that is lost in the support")
      .expectAtMost("largest error of aᵀρ", worst, 1e-14);
}

TEST(Masks, OnBadTrianglesTransmitTheirForceToo) {
  double worst = 0;
  for (const Shape& shape : {boxWithNeedles(1e-4), boxWithNeedles(1e-6),
                             ringedSphere([](double a) { return 0.02 + 0.2 * a; }, {})}) {
    const Surface surface(shape, [](const Eigen::Vector3d& x) { return x.z() < 0.01; });
    for (const double radius : {1e-5, 0.1, 0.5})
      surface.forEachKind(radius, [&](const VertexMasks& masks) {
        for (int v : surface.conditions.freeNodes()) {
          const VertexMask mask = masks.at(v);
          worst =
              std::max({worst, std::abs(surface.force(mask) - 1),
                        mask.density.allFinite() ? 0 : std::numeric_limits<double>::infinity()});
        }
      });
  }
  // Areas of needles are 1e-7 of the others, and so their densities' rounding counts no more.
  hard("masks of every kind on needles of aspect 2.5e3, 2.5e5 and a mesh graded 1 : 30",
       "densities of 1 / area of almost nothing")
      .expectAtMost("largest error of aᵀρ", worst, 1e-13);
}

TEST(Masks, OfAnyRadiusAreFiniteOrRefused) {
  const Surface sphere(jitteredSphere(2, 0.2), lower);
  double worst = 0;
  for (const double radius : {0.0, 1e-300, 1e-12, 10.0, 1e150, 1e300})
    for (const MaskShape shape :
         {MaskShape::Linear, MaskShape::Uniform, MaskShape::Gaussian, MaskShape::Hertzian}) {
      const PressureMasks masks(*sphere.mesh, sphere.conditions, shape, radius);
      for (int v : sphere.conditions.freeNodes())
        worst = std::max(worst, std::abs(sphere.force(masks.at(v)) - 1));
    }
  hard("radii 0, 1e−300 … 1e300", "squares that overflow or vanish")
      .expectAtMost("largest error of aᵀρ", worst, 1e-14);
  std::vector<std::function<void()>> calls;
  for (const double radius : {-1.0, std::numeric_limits<double>::quiet_NaN()})
    calls.push_back(
        [&, radius] { PressureMasks(*sphere.mesh, sphere.conditions, MaskShape::Linear, radius); });
  hard("radii −1, NaN", "a mask of nothing")
      .expectAllRefused(calls, "the radius of a pressure mask must be at least 0, not ");
  const int fixed = sphere.conditions.fixedNodes().front();
  hard("a mask at a fixed vertex", "a force that acts on nothing")
      .expectRefused(
          [&] { PressureMasks(*sphere.mesh, sphere.conditions, MaskShape::Linear, 0.5).at(fixed); },
          "vertex " + std::to_string(fixed) + " is fixed: a pressure mask needs a free node");
}

}  // namespace
}  // namespace palpate::test
