// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cmath>
#include <map>
#include <memory>

#include "identification/registration_changes.h"
#include "support/rigs.h"

namespace palpate::test {

/// An ellipsoid of 10 cm with waves, so that places on it tell every motion, that stands for what a
/// rig of unknown frame and its identification share.
class WavyEllipsoid {
 public:
  static constexpr double kYoung = 8e3, kPoisson = 0.4;

  WavyEllipsoid()
      : model_(makeModel(
            shape(), [](const Eigen::Vector3d& x) { return x.z() < -0.010; }, kYoung, kPoisson)),
        truth_(computed(Material(kYoung, kPoisson))) {}

  const ElasticModel& model() const { return model_; }

  /// What a rig sees that tells places with this noise, m.
  Measurements measured(unsigned seed, double placeNoise) const {
    RigSettings rig;
    rig.probes = 5;
    rig.markers = 40;
    rig.radius = 0.012;
    rig.seed = seed;
    rig.placeNoise = placeNoise;
    rig.rotation = {8, -12, 20};
    rig.translation = {0.05, 0.02, -0.03};
    return measuredOn(truth_, model_.mesh(), rig);
  }

  /// @param isCarried  whether what the registration leaves open has its part in the deviations.
  MaterialIdentification identified(const Measurements& seen, bool isCarried) {
    const Registration registration = registerToSurface(model_.mesh(), seen);
    const Measurements m = registered(seen, registration);
    const RigSetup rig = setupOn(model_, m);
    IdentificationOptions options;
    options.folds = 0;
    const MaterialIdentifier identifier(
        [&](const std::vector<Material>& materials, const Progress&) {
          auto& kept = computed_[materials.front().poissonRatio()];
          if (!kept) kept = computed(materials.front());
          return MeasuredResponse(*kept, rig.setup, false);
        },
        rig.setup, model_.mesh().diagonal(), rig.normals, options);
    const MaterialIdentification found = identifier.identify(m);
    if (!isCarried) return found;
    const auto greens = computed(found.materials.front());
    return identifier.identify(
        m, {}, changesByRegistration(m, registration, [&](const Measurements& moved) {
          return MeasuredResponse(*greens, setupOn(model_, moved).setup, false).residuals(moved, 0);
        }));
  }

 private:
  static Shape shape() {
    Shape body = icosphere(2);
    for (auto point : body.points.colwise()) {
      const Eigen::Vector3d p = point.cwiseProduct(Eigen::Vector3d(0.05, 0.03, 0.02));
      point =
          p + Eigen::Vector3d(0.004 * std::sin(60 * p.x()), 0, 0.006 * std::cos(50 * p.x() + 0.5));
    }
    return body;
  }

  std::shared_ptr<const GreensFunctions> computed(const Material& material) const {
    const ElasticModel here(model_.sharedMesh(), material, model_.conditions(),
                            model_.smoothPatches());
    return computeBoundaryElementGreensFunctions(here, {}).take();
  }

  ElasticModel model_;
  std::shared_ptr<const GreensFunctions> truth_;
  std::map<double, std::shared_ptr<const GreensFunctions>> computed_;  // by Poisson's ratio
};

}  // namespace palpate::test
