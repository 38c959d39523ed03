// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "identification/contact_recovery.h"
#include "mesh/surface_locator.h"
#include "support/rigs.h"

namespace palpate::test {

/// A body and its Green's functions.
struct TouchedBody {
  explicit TouchedBody(ElasticModel m) : model(std::move(m)), greens(computeGreens(model, {})) {}
  const SurfaceMesh& mesh() const { return model.mesh(); }

  ElasticModel model;
  std::shared_ptr<const GreensFunctions> greens;
};

/// A force that is spread like a linear mask about a place.
struct KnownContact {
  Eigen::Vector3d place;
  Eigen::Vector3d force;
  double radius;
};

/// How a body moves under contacts, 3 by #V.
inline Eigen::Matrix3Xd displacementUnder(const TouchedBody& body,
                                          const std::vector<KnownContact>& contacts) {
  Eigen::Matrix3Xd traction = Eigen::Matrix3Xd::Zero(3, body.mesh().vertexCount());
  for (const KnownContact& contact : contacts) {
    const SpreadForce load =
        loadOn(body.mesh(), body.model.conditions(),
               nearestSurfacePoint(body.mesh(), contact.place), contact.radius);
    for (std::size_t j = 0; j < load.nodes.size(); ++j)
      traction.col(load.nodes[j]) += load.density[j] * contact.force;
  }
  Eigen::Matrix3Xd u = solveReferenceProblem(*body.greens, traction);
  for (int node : body.model.conditions().fixedNodes()) u.col(node).setZero();
  return u;
}

/// Points that are evenly spread by area over the triangles that are free all round.
inline std::vector<SurfacePoint> markersOn(const TouchedBody& body, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> areas;
  for (int t = 0; t < body.mesh().triangleCount(); ++t) {
    bool isFree = true;
    for (int v : body.mesh().triangles().col(t))
      isFree = isFree && !body.model.conditions().isFixed(v);
    areas.push_back(isFree ? body.mesh().triangleAreas()[t] : 0);
  }
  std::discrete_distribution<int> triangle(areas.begin(), areas.end());
  std::vector<SurfacePoint> points;
  for (int i = 0; i < count; ++i) {
    const int at = triangle(random);
    double a = uniform(random), b = uniform(random);
    if (a + b > 1) {
      a = 1 - a;
      b = 1 - b;
    }
    points.push_back({at, {1 - a - b, a, b}});
  }
  return points;
}

/// What markers on a body see of a displacement, with noise, as points of a model's surface.
/// @param noise  standard deviation over the largest displacement.
inline ObservedDisplacements observedOn(const TouchedBody& body, const Eigen::Matrix3Xd& u,
                                        const SurfaceMesh& seenOn, int markers, double noise,
                                        unsigned seed) {
  const SurfaceLocator locator(
      std::make_shared<SurfaceMesh>(seenOn.points(), seenOn.triangles(), seenOn.rims()));
  const std::vector<SurfacePoint> points = markersOn(body, markers, seed);
  ObservedDisplacements observed;
  observed.displacements.setZero(3, markers);
  for (int i = 0; i < markers; ++i) {
    for (int k = 0; k < 3; ++k)
      observed.displacements.col(i) +=
          points[i].barycentric[k] * u.col(body.mesh().triangles()(k, points[i].triangle));
    observed.points.push_back(locator.nearest(placeOf(body.mesh(), points[i])));
  }
  std::mt19937 random(seed + 1000);
  std::normal_distribution<double> normal(0, noise * observed.displacements.cwiseAbs().maxCoeff());
  if (noise > 0)
    for (double& value : observed.displacements.reshaped()) value += normal(random);
  return observed;
}

inline ContactRecovery recoverOn(const TouchedBody& body, const ObservedDisplacements& observed,
                                 const RecoveryOptions& options = {}) {
  return recoverContacts(*body.greens, body.mesh(), body.model.smoothPatches(), observed, options);
}

}  // namespace palpate::test
