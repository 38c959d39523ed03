// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greens/computed_greens_functions.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "greens/dense_greens_functions.h"

namespace palpate {

std::shared_ptr<const GreensFunctions> ComputedGreensFunctions::view() const {
  if (floatMatrix.size() > 0)
    return std::make_shared<DenseGreensFunctions<float>>(info, floatMatrix.data(),
                                                         floatPatchMatrix.data(), nullptr);
  return std::make_shared<DenseGreensFunctions<double>>(info, matrix.data(), patchMatrix.data(),
                                                        nullptr);
}

std::shared_ptr<const GreensFunctions> ComputedGreensFunctions::take() {
  if (floatMatrix.size() > 0)
    return std::make_shared<DenseGreensFunctions<float>>(std::move(info), std::move(floatMatrix),
                                                         std::move(floatPatchMatrix));
  return std::make_shared<DenseGreensFunctions<double>>(std::move(info), std::move(matrix),
                                                        std::move(patchMatrix));
}

std::vector<int> checkedColumns(const ElasticModel& model, const std::vector<int>& columns) {
  if (columns.empty()) return model.conditions().freeNodes();
  std::vector<int> sorted = columns;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  for (int node : {sorted.front(), sorted.back()})
    if (node < 0 || node >= model.mesh().vertexCount())
      throw std::invalid_argument("there is no node " + std::to_string(node) +
                                  " to compute Green's functions of: the model has " +
                                  std::to_string(model.mesh().vertexCount()) + " nodes");
  return sorted;
}

void scaleToModel(const GreensFunctionsInfo& info, double length, double stiffness,
                  const std::vector<double>& perGiven, Eigen::Ref<Eigen::MatrixXd> columns) {
  const Eigen::VectorXd areas = info.vertexAreas / (length * length);
  for (std::size_t c = 0; c < perGiven.size(); ++c)
    for (int v = 0; v < info.conditions.nodeCount(); ++v)
      columns.block<3, 3>(3 * v, 3 * c) *=
          perGiven[c] * (info.conditions.isFixed(v) ? stiffness / areas[v] : length);
}

std::vector<double> perGivenOfNodes(const GreensFunctionsInfo& info, double length,
                                    double stiffness) {
  std::vector<double> perGiven;
  for (int node : info.columnNodes)
    perGiven.push_back(info.conditions.isFixed(node)
                           ? 1 / length
                           : info.vertexAreas[node] / (length * length) / stiffness);
  return perGiven;
}

GreensFunctionsInfo infoOf(const ElasticModel& model, const std::vector<int>& columns) {
  GreensFunctionsInfo info;
  info.conditions = model.conditions();
  info.material = model.material();
  info.domain = model.domain();
  info.vertexAreas = model.mesh().vertexAreas();
  info.columnNodes = checkedColumns(model, columns);
  info.fingerprint = model.fingerprint();
  return info;
}

}  // namespace palpate
