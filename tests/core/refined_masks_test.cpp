// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// A mask has a size of its own: under refinement the stiffness settles ([JP01] table 1).

#include <gtest/gtest.h>

#include <cmath>

#include "contact/mask_settings.h"
#include "contact/surface_stiffness.h"
#include "mesh/loop_subdivision.h"
#include "support/data_models.h"
#include "support/problems.h"

namespace palpate::test {
namespace {

/// The nodule of [JP01] fig. 10 at Loop's levels 0, 1 and 2 (the paper's 1 to 3), held below.
class RefinedNodule : public testing::Test {
 protected:
  struct Level {
    std::shared_ptr<const SurfaceMesh> mesh;
    std::shared_ptr<const GreensFunctions> greens;
    int top;
  };
  static void SetUpTestSuite() {
    levels_ = new std::vector<Level>;
    DataModel data = readDataModel("nodule");
    for (int level = 0; level < 3; ++level) {
      if (level > 0) {
        const SubdivisionLevel finer = subdivideLoop(*data.shape.mesh());
        data.boundaryTypes = refineBoundaryTypes(finer, data.boundaryTypes);
        data.shape = {finer.points, finer.triangles};
      }
      const auto mesh = data.shape.mesh();
      const ElasticModel model(mesh, Material(data.youngsModulus, data.poissonRatio),
                               BoundaryConditions(data.boundaryTypes),
                               Eigen::VectorXi::Zero(mesh->triangleCount()));
      BoundaryElementOptions options;
      Eigen::Index top;
      mesh->points().row(2).maxCoeff(&top);
      levels_->push_back({mesh, computeGreens(model, options), static_cast<int>(top)});
    }
  }
  static void TearDownTestSuite() { delete levels_; }

  /// |K|_F at the top, a level.
  static Eigen::Vector3d norms(const MaskSettings& settings, DisplacementMeasure measure) {
    Eigen::Vector3d result;
    for (int i = 0; i < 3; ++i) {
      const Level& level = (*levels_)[i];
      const auto masks = makeMasks(*level.mesh, level.greens->info().conditions, settings);
      result[i] = maskedVertexStiffness(*level.greens, level.top, masks->at(level.top), measure)
                      .stiffness.norm();
    }
    return result;
  }
  static std::vector<Level>* levels_;
};
std::vector<RefinedNodule::Level>* RefinedNodule::levels_ = nullptr;

TEST_F(RefinedNodule, SettlesUnderEveryMaskAndMeasureAndNotAtSingleVertices) {
  const double radius = levels_->front().mesh->meanEdgeLength();  // as in the paper
  const Eigen::Vector3d single = norms({}, DisplacementMeasure::Vertex);
  EXPECT_LT(single[1], 0.7 * single[0]);
  EXPECT_LT(single[2], 0.7 * single[1]);
  std::vector<MaskSettings> all;
  for (MaskKind kind : {MaskKind::Linear, MaskKind::Uniform, MaskKind::Gaussian, MaskKind::Hertzian,
                        MaskKind::Gradient, MaskKind::Biharmonic})
    all.push_back({kind, radius, MaskDistance::Euclidean});
#ifdef PALPATE_WITH_CGAL
  all.push_back({MaskKind::Linear, radius, MaskDistance::Geodesic});
  all.push_back({MaskKind::Hertzian, radius, MaskDistance::Geodesic});
#endif
  for (const MaskSettings& settings : all)
    for (DisplacementMeasure measure : {DisplacementMeasure::Vertex, DisplacementMeasure::Mean}) {
      const Eigen::Vector3d masked = norms(settings, measure);
      RecordProperty("kind" + std::to_string(int(settings.kind)) + "distance" +
                         std::to_string(int(settings.distance)) + "measure" +
                         std::to_string(int(measure)),
                     std::to_string(masked[0]) + " " + std::to_string(masked[1]) + " " +
                         std::to_string(masked[2]));
      EXPECT_LT(std::abs(masked[2] / masked[1] - 1), 0.15) << int(settings.kind);
    }
}

TEST_F(RefinedNodule, YieldsAlikeUnderLinearAndVariationalMasksOfARadius) {
  // lengthForRadius holds for the half-space; here the mask is as wide as the nodule's top.
  const double radius = levels_->front().mesh->meanEdgeLength();
  const double linear = norms({MaskKind::Linear, radius}, DisplacementMeasure::Vertex)[2];
  for (MaskKind kind : {MaskKind::Gradient, MaskKind::Biharmonic})
    EXPECT_NEAR(norms({kind, radius}, DisplacementMeasure::Vertex)[2] / linear, 1, 0.05);
}

}  // namespace
}  // namespace palpate::test
