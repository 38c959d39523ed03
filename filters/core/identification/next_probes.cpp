// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "identification/next_probes.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <limits>
#include <set>

#include "sentence.h"

namespace palpate {
namespace {

/// Of a matrix that may be singular: those that are more so come later.
double logDeterminant(const Eigen::MatrixXd& matrix) {
  const Eigen::VectorXd pivots = matrix.ldlt().vectorD();
  double sum = 0;
  for (double pivot : pivots) sum += std::log(std::max(pivot, std::numeric_limits<double>::min()));
  return sum;
}

/// Free vertices, each the farthest from those before; the first the farthest from the support.
std::vector<int> verticesApart(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                               int count) {
  const std::vector<int> free = conditions.freeNodes();
  std::vector<int> chosen;
  Eigen::VectorXd distance = Eigen::VectorXd::Constant(mesh.vertexCount(), INFINITY);
  const auto add = [&](int vertex) {
    for (int other : free)
      distance[other] =
          std::min(distance[other], (mesh.points().col(other) - mesh.points().col(vertex)).norm());
  };
  for (int node : conditions.fixedNodes()) add(node);
  while (int(chosen.size()) < std::min(count, int(free.size()))) {
    const int next = *std::max_element(free.begin(), free.end(),
                                       [&](int a, int b) { return distance[a] < distance[b]; });
    chosen.push_back(next);
    add(next);
  }
  return chosen;
}

}  // namespace

std::vector<Eigen::MatrixXd> informationOfProbes(const MaterialIdentifier& identifier,
                                                 const Eigen::VectorXd& parameters,
                                                 const Measurements& probes, double noise) {
  if (!(noise > 0)) refuse("what a probe tells depends on the noise, which must be above 0");
  const Eigen::MatrixXd jacobian = identifier.sensitivities(parameters, probes) / noise;
  std::vector<Eigen::MatrixXd> information(probes.probes.size(),
                                           Eigen::MatrixXd::Zero(jacobian.cols(), jacobian.cols()));
  for (std::size_t i = 0; i < probes.displacements.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      if (std::isnan(probes.displacements[i].displacement[c])) continue;
      const Eigen::RowVectorXd row = jacobian.row(static_cast<Eigen::Index>(3 * i + c));
      information[probes.displacements[i].probe] += row.transpose() * row;
    }
  return information;
}

std::vector<ChosenProbe> chooseProbes(const Eigen::MatrixXd& present,
                                      const std::vector<Eigen::MatrixXd>& candidates,
                                      const std::vector<int>& places, int count) {
  if (candidates.empty()) refuse("there is no candidate to choose a probe from");
  if (places.size() != candidates.size())
    refuse("there are ", candidates.size(), " candidates, but ", places.size(), " places of them");
  const std::set<int> all(places.begin(), places.end());
  std::set<int> left;
  std::vector<ChosenProbe> chosen;
  Eigen::MatrixXd information = present;
  for (int i = 0; i < count; ++i) {
    if (left.empty()) left = all;
    int best = -1;
    double most = -INFINITY;
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      if (left.count(places[c]) == 0) continue;
      const double determinant = logDeterminant(information + candidates[c]);
      if (best >= 0 && !(determinant > most)) continue;
      most = determinant;
      best = static_cast<int>(c);
    }
    information += candidates[best];
    left.erase(places[best]);
    chosen.push_back({best, information});
  }
  return chosen;
}

std::vector<int> contactVertices(const Measurements& probes) {
  std::vector<int> vertices;
  for (const Probe& probe : probes.probes) vertices.push_back(probe.contact.vertex);
  return vertices;
}

Measurements candidateProbes(const SurfaceMesh& mesh, const BoundaryConditions& conditions,
                             const Measurements& measurements, int places) {
  const int probes = static_cast<int>(measurements.probes.size());
  std::vector<int> markers(probes, 0);
  double force = 0;
  for (const Probe& probe : measurements.probes) force += probe.force.norm() / probes;
  for (const MeasuredDisplacement& measured : measurements.displacements) ++markers[measured.probe];
  const int most =
      static_cast<int>(std::max_element(markers.begin(), markers.end()) - markers.begin());
  Measurements candidates;
  candidates.source = "candidates";
  for (int vertex : verticesApart(mesh, conditions, places)) {
    const Eigen::Vector3d normal = mesh.vertexNormals().col(vertex),
                          across = normal.unitOrthogonal(), along = normal.cross(across);
    const Eigen::Vector3d directions[] = {-normal, across - normal, -across - normal,
                                          along - normal, -along - normal};
    for (const Eigen::Vector3d& direction : directions) {
      Probe probe;
      probe.name = std::to_string(candidates.probes.size());
      probe.contact.vertex = vertex;
      probe.radius = measurements.probes[most].radius;
      probe.force = force * direction.normalized();
      for (const MeasuredDisplacement& measured : measurements.displacements) {
        if (measured.probe != most) continue;
        MeasuredDisplacement seen = measured;
        seen.probe = static_cast<int>(candidates.probes.size());
        seen.displacement.setZero();
        candidates.displacements.push_back(seen);
      }
      candidates.probes.push_back(probe);
    }
  }
  return candidates;
}

}  // namespace palpate
