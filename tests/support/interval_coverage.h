// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include "support/rigs.h"

namespace palpate::test {

/// A bent bar that is held at one end and stands for what a rig and its identification share, so
/// that the statistics of estimates are seen, not the discretisation. From few markers its
/// Poisson's ratio is known badly.
class BentBar {
 public:
  static constexpr double kYoung = 8e3;

  /// @param yields  whether the support does, by kYield, and that is unknown, too.
  BentBar(double poisson, bool yields)
      : poisson_(poisson),
        yields_(yields),
        model_(makeModel(
            shape(), [](const Eigen::Vector3d& x) { return x.x() < 1e-3; }, kYoung, poisson)) {}

  static constexpr double kYield = 0.003;

  /// Of Young's modulus, Poisson's ratio, and the support's yielding length.
  std::vector<double> truth() const {
    std::vector<double> truth{kYoung, poisson_};
    if (yields_) truth.push_back(kYield);
    return truth;
  }

  MaterialIdentification identified(unsigned seed, int folds = 0, int probes = 3) {
    RigSettings rig;
    rig.probes = probes;
    rig.markers = 20;
    rig.seed = seed;
    rig.foundationLength = yields_ ? kYield : 0;
    const Measurements m = measuredOn(greensOf(Material(kYoung, poisson_)), model_.mesh(), rig);
    const RigSetup setup = setupOn(model_, m);
    IdentificationOptions options;
    options.unknowns.support = yields_;
    options.folds = folds;
    const auto responseOf = [&](const std::vector<Material>& materials, const Progress&) {
      return MeasuredResponse(*greensOf(materials.front()), setup.setup, yields_);
    };
    return MaterialIdentifier(responseOf, setup.setup, model_.mesh().diagonal(), setup.normals,
                              options)
        .identify(m);
  }

 private:
  static Shape shape() {
    Shape bar = box({0.16, 0.03, 0.03}, {8, 2, 2});
    constexpr double kRadius = 0.1;
    for (auto point : bar.points.colwise()) {
      const double angle = point.x() / kRadius, distance = kRadius + point.y();
      point = Eigen::Vector3d(distance * std::sin(angle), distance * std::cos(angle) - kRadius,
                              point.z());
    }
    return bar;
  }

  std::shared_ptr<const GreensFunctions> greensOf(const Material& material) {
    auto& kept = computed_[{material.youngsModulus(), material.poissonRatio()}];
    if (kept) return kept;
    BoundaryElementOptions how;
    if (yields_) how.columns = allNodes(model_);
    const ElasticModel here(model_.sharedMesh(), material, model_.conditions(),
                            model_.smoothPatches());
    return kept = computeBoundaryElementGreensFunctions(here, how).take();
  }

  double poisson_;
  bool yields_;
  ElasticModel model_;
  std::map<std::pair<double, double>, std::shared_ptr<const GreensFunctions>> computed_;
};

/// How many sets of measurements have the truth within their intervals of 95 %, a parameter.
/// @param sets  as many as are tried; set to those that are not refused as telling too little.
inline std::vector<int> coveredOf(BentBar& bar, int& sets) {
  const std::vector<double> truth = bar.truth();
  std::vector<int> covered(truth.size(), 0);
  const int tried = sets;
  for (int set = 1; set <= tried; ++set) {
    MaterialIdentification result;
    try {
      result = bar.identified(set);
    } catch (const std::invalid_argument&) {
      --sets;
      continue;
    }
    for (std::size_t i = 0; i < truth.size(); ++i)
      covered[i] +=
          truth[i] >= result.parameters[i].lower && truth[i] <= result.parameters[i].upper;
  }
  return covered;
}

}  // namespace palpate::test
