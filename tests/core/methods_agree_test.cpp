// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// Two methods that share nothing but the surface, one body: boundary elements, and finite elements
// in the tetrahedra that the surface was filled with.

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <numeric>

#include "bem/boundary_element_method.h"
#include "fem/finite_element_method.h"
#include "mesh/loop_subdivision.h"
#include "support/data_models.h"
#include "support/problems.h"
#include "support/solids.h"

namespace palpate::test {
namespace {

ElasticModel refinedKidney() {
  DataModel data = readDataModel("kidney");
  for (int level = 0; level < 2; ++level) {
    const SubdivisionLevel finer = subdivideLoop(*data.shape.mesh());
    data.boundaryTypes = refineBoundaryTypes(finer, data.boundaryTypes);
    data.shape = {finer.points, finer.triangles};
  }
  const auto mesh = data.shape.mesh();
  return ElasticModel(mesh, Material(data.youngsModulus, data.poissonRatio),
                      BoundaryConditions(data.boundaryTypes),
                      Eigen::VectorXi::Zero(mesh->triangleCount()));
}

struct Body {
  const char* name;
  ElasticModel model;
};
void PrintTo(const Body& body, std::ostream* out) {
  *out << body.name;
}

std::vector<Body> bodies() {
  const Place base = [](const Eigen::Vector3d& x) { return x.z() < 1e-9; };
  return {{"Sphere", makeModel(icosphere(3), cap, 1, 0.3)},
          {"Cube", makeModel(box({1, 1, 1}, {8, 8, 8}), base, 1, 0.3)},
          {"Kidney", refinedKidney()}};
}

class BothMethods : public testing::TestWithParam<Body> {};

TEST_P(BothMethods, AgreeWithinTheSumOfTheirEstimatedErrors) {
  const ElasticModel& model = GetParam().model;
  BoundaryElementOptions boundaryOptions;
  boundaryOptions.estimateError = true;
  const auto boundary = computeBoundaryElementGreensFunctions(model, boundaryOptions).take();

  const Tetrahedralization filled = tetrahedralize(model.mesh());
  ASSERT_EQ(filled.newBoundaryPoints, 0);
  const ElasticModel solid = onBoundary(model, filled);
  FiniteElementOptions options;
  options.estimateError = true;
  const auto finite =
      computeFiniteElementGreensFunctions(
          solid, SolidBody(solid.mesh(), filled.mesh, {Elasticity(model.material())}), options)
          .take();

  const ErrorEstimate a = boundary->info().diagnostics.error, b = finite->info().diagnostics.error;
  ASSERT_GT(a.total(), 0);
  ASSERT_GT(b.total(), 0);
  SpreadLoads loads = errorLoads(model);
  loads.length = std::max(a.loadLength, b.loadLength);
  std::vector<int> same(model.mesh().vertexCount());
  std::iota(same.begin(), same.end(), 0);
  const LoadDifferences found =
      compareUnderLoads(*boundary, model.mesh(), *finite, solid.mesh(), same, loads);
  ASSERT_GT(found.contact.size(), 10u);
  const double field = LoadDifferences::mean(found.field),
               contact = LoadDifferences::mean(found.contact);
  std::cout << GetParam().name << ": displacements differ by " << field << " (estimated "
            << a.total() << " + " << b.total() << "), compliances by " << contact << " ("
            << a.contactTotal() << " + " << b.contactTotal() << ")\n";
  EXPECT_LE(field, a.total() + b.total());
  EXPECT_LE(contact, a.contactTotal() + b.contactTotal());
  EXPECT_LE(LoadDifferences::most(found.contact), a.most() + b.most());
  // Nor is that for want of trying: the estimates are those of usable meshes.
  EXPECT_LE(a.total() + b.total(), 0.4);
}

INSTANTIATE_TEST_SUITE_P(On, BothMethods, testing::ValuesIn(bodies()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace palpate::test
