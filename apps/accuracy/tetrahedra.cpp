// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/tetrahedra.h"

#include "fem/finite_element_method.h"
#include "linear_algebra/sparse_factorization.h"

namespace palpate::app {

bool canUseTetrahedra() {
  return SparseFactorization::isAvailable();
}

ComputedGreensFunctions greensOfFilling(const ElasticModel& model, const SolidBody& body,
                                        SolidElement element, bool reciprocal,
                                        const std::vector<int>& columns,
                                        const ProgressCallback& progress) {
  FiniteElementOptions options;
  options.element = element;
  options.reciprocal = reciprocal;
  options.columns = columns;
  return computeFiniteElementGreensFunctions(model, body, options, progress);
}

ComputedGreensFunctions greensByTetrahedra(const ElasticModel& model, SolidElement element,
                                           bool reciprocal, const std::vector<int>& columns,
                                           const ProgressCallback& callback) {
  const Progress progress(callback);
  const Tetrahedralization filled =
      tetrahedralize(model.mesh(), 0, progress.part(0, 0.2).callback());
  const ElasticModel solid = onBoundary(model, filled);
  ComputedGreensFunctions result =
      greensOfFilling(solid, SolidBody(solid.mesh(), filled.mesh, {Elasticity(model.material())}),
                      element, reciprocal, columns, progress.part(0.2, 1).callback());
  GreensFunctionsInfo& info = result.info;
  const Eigen::VectorXd ratio =
      model.mesh().vertexAreas().cwiseQuotient(solid.mesh().vertexAreas());
  Eigen::Map<Eigen::MatrixXd> matrix(result.matrix.data(), 3 * ratio.size(),
                                     3 * info.columnNodes.size());
  for (std::size_t c = 0; c < info.columnNodes.size(); ++c)
    if (!info.conditions.isFixed(info.columnNodes[c]))
      matrix.middleCols<3>(3 * c) *= ratio[info.columnNodes[c]];
  for (int node : info.conditions.fixedNodes()) matrix.middleRows<3>(3 * node) /= ratio[node];
  info.vertexAreas = model.mesh().vertexAreas();
  info.fingerprint = model.fingerprint();
  return result;
}

}  // namespace palpate::app
