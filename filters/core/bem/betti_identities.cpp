// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/betti_identities.h"

#include <cmath>
#include <Eigen/Geometry>

#include "bem/triangle_quadrature.h"
#include "mesh/shells.h"

namespace palpate::bem {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// The auxiliary state at a surface point y with unit normal n out of the material (G = 1).
struct AuxiliaryState {
  Eigen::Vector3d displacement, traction;
};

/// Dilatation about c, divided by its stress so that the incompressible limit stays finite.
AuxiliaryState dilatation(const Eigen::Vector3d& y, const Eigen::Vector3d& n,
                          const Eigen::Vector3d& c, double poissonRatio) {
  const double youngsModulus = 2 * (1 + poissonRatio);
  return {(1 - 2 * poissonRatio) / youngsModulus * (y - c), n};
}

/// Centre of dilatation at c: w = grad(1/r), so that div w = 0 and t_w = 2 grad grad(1/r) n.
AuxiliaryState centreOfDilatation(const Eigen::Vector3d& y, const Eigen::Vector3d& n,
                                  const Eigen::Vector3d& c) {
  const Eigen::Vector3d r = y - c;
  const double r2 = r.squaredNorm(), r3 = r2 * std::sqrt(r2);
  return {-r / r3, 2 * (3 * r.dot(n) / r2 * r - n) / r3};
}

using Corners = Eigen::Matrix3d;  // a column a corner

/// Integrates hat functions times an auxiliary state over one triangle, cut in four while its
/// centroid is nearer to the state's singular point than three radii.
template <class State>
void integrate(const State& state, const Eigen::Vector3d* singular, const Corners& corners,
               const Eigen::Matrix3d& hats, const Eigen::Vector3d& normal, int depth,
               Eigen::Matrix3d& traction, Eigen::Matrix3d& displacement) {
  static const TriangleRule rule = triangleRule(16);
  const Eigen::Vector3d centroid = corners.rowwise().mean();
  const double radius = (corners.colwise() - centroid).colwise().norm().maxCoeff();
  if (singular && depth < 12 && (centroid - *singular).norm() < 3 * radius) {
    for (int part = 0; part < 4; ++part) {
      Eigen::Matrix3d to = Eigen::Matrix3d::Constant(0.5);
      to.diagonal().setZero();  // the middle triangle
      if (part < 3) {
        to = Eigen::Matrix3d::Identity() / 2;
        to.row(part).array() += 0.5;
      }
      integrate(state, singular, Corners(corners * to), Eigen::Matrix3d(hats * to), normal,
                depth + 1, traction, displacement);
    }
    return;
  }
  const double area =
      (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).norm() / 2;
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const Eigen::Vector3d hat = hats * rule.barycentric.col(q);
    const AuxiliaryState at = state(corners * rule.barycentric.col(q), normal);
    traction += area * rule.weights[q] * at.traction * hat.transpose();
    displacement += area * rule.weights[q] * at.displacement * hat.transpose();
  }
}

template <class State>
void integrateOverSurface(const BodySurface& body, const State& state,
                          const Eigen::Vector3d* singular, BettiIdentity& identity) {
  identity.displacement = Eigen::Matrix3Xd::Zero(3, body.vertexCount());
  identity.traction = Eigen::Matrix3Xd::Zero(3, body.nodes.count());
  for (int f = 0; f < body.triangleCount(); ++f) {
    Corners corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = body.points.col(body.triangles(k, f));
    const Eigen::Vector3d normal = (body.exterior ? -1 : 1) * body.normals.col(f);
    Eigen::Matrix3d traction = Eigen::Matrix3d::Zero(), displacement = traction;
    integrate(state, singular, corners, Eigen::Matrix3d(Eigen::Matrix3d::Identity()), normal, 0,
              traction, displacement);
    for (int k = 0; k < 3; ++k) {
      identity.displacement.col(body.triangles(k, f)) += traction.col(k);
      identity.traction.col(body.nodes.ofCorner(k, f)) += displacement.col(k);
    }
  }
}

std::vector<int> trianglesOfShell(const BodySurface& body, int shell) {
  std::vector<int> triangles;
  for (int f = 0; f < body.triangleCount(); ++f)
    if (body.shell[f] == shell) triangles.push_back(f);
  return triangles;
}

/// A point well inside a closed shell: of its centroid and the middles of chords from its triangles
/// straight inwards, the one farthest from the surface.
Eigen::Vector3d pointDeepInside(const BodySurface& body, int shell) {
  const std::vector<int> triangles = trianglesOfShell(body, shell);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int f : triangles) middle += body.centroid(f) / double(triangles.size());
  const auto depth = [&](const Eigen::Vector3d& x) {
    double angle = 0, nearest = 1e300;
    for (int f : triangles) {
      angle +=
          solidAngle(x, body.points.col(body.triangles(0, f)),
                     body.points.col(body.triangles(1, f)), body.points.col(body.triangles(2, f)));
      nearest = std::min(nearest, (body.centroid(f) - x).norm());
    }
    return std::abs(angle) > 2 * kPi ? nearest : -1;
  };
  // The void is where the mesh's normals do not point from in an exterior domain, and where they do
  // point to in a cavity of a body.
  const double inwards = body.exterior ? -1 : 1;
  Eigen::Vector3d best = middle;
  double bestDepth = depth(middle);
  const std::size_t stride = std::max<std::size_t>(1, triangles.size() / 32);
  for (std::size_t i = 0; i < triangles.size(); i += stride) {
    const Eigen::Vector3d from = body.centroid(triangles[i]);
    const Eigen::Vector3d along = inwards * body.normals.col(triangles[i]);
    for (double step = std::sqrt(body.areas[triangles[i]]) / 2; step < 10; step *= 1.5) {
      const Eigen::Vector3d x = from + step * along;
      const double reached = depth(x);
      if (reached < 0) break;
      if (reached > bestDepth) {
        best = x;
        bestDepth = reached;
      }
    }
  }
  return best;
}

/// The identity of one shell's volume.
BettiIdentity volumeIdentity(const BodySurface& body, const CollocationScheme& scheme, int shell,
                             const std::vector<int>& shellOfVertex, const Eigen::Vector3d& middle) {
  BettiIdentity identity;
  if (body.shellIsCavity[shell]) {
    const Eigen::Vector3d centre = pointDeepInside(body, shell);
    integrateOverSurface(
        body,
        [&](const Eigen::Vector3d& y, const Eigen::Vector3d& n) {
          return centreOfDilatation(y, n, centre);
        },
        &centre, identity);
  } else {
    integrateOverSurface(
        body,
        [&](const Eigen::Vector3d& y, const Eigen::Vector3d& n) {
          return dilatation(y, n, middle, body.poissonRatio);
        },
        nullptr, identity);
  }
  const double scale = 1 / identity.displacement.norm();
  identity.displacement *= scale;
  identity.traction *= scale;
  identity.weights = Eigen::MatrixX3d::Zero(scheme.equationCount(), 3);
  for (int e = 0; e < scheme.equationCount(); ++e)
    if (shellOfVertex[scheme.equations[e].vertex] == shell)
      identity.weights.row(e) = scheme.equations[e].areaVector.transpose();
  return identity;
}

/// Equilibrium of forces along an axis (motion 0..2) or of moments about it (3..5).
BettiIdentity equilibriumIdentity(const BodySurface& body, const CollocationScheme& scheme,
                                  int motion, const Eigen::Vector3d& middle) {
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(motion % 3);
  const auto displacementAt = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return motion < 3 ? axis : Eigen::Vector3d(axis.cross(x - middle));
  };
  BettiIdentity identity;
  integrateOverSurface(
      body,
      [&](const Eigen::Vector3d& y, const Eigen::Vector3d&) {
        return AuxiliaryState{displacementAt(y), Eigen::Vector3d::Zero()};
      },
      nullptr, identity);
  // About the size of the entries of G that it stands for.
  identity.traction *= 0.1 / identity.traction.norm();
  identity.weights.resize(scheme.equationCount(), 3);
  for (int e = 0; e < scheme.equationCount(); ++e)
    identity.weights.row(e) =
        scheme.equations[e].area *
        displacementAt(body.points.col(scheme.equations[e].vertex)).transpose();
  return identity;
}

/// Gram-Schmidt, twice for accuracy.
void orthonormaliseWeights(std::vector<BettiIdentity>& identities) {
  for (std::size_t a = 0; a < identities.size(); ++a) {
    Eigen::MatrixX3d& weights = identities[a].weights;
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t b = 0; b < a; ++b)
        weights -= weights.cwiseProduct(identities[b].weights).sum() * identities[b].weights;
    weights /= weights.norm();
  }
}

}  // namespace

std::vector<BettiIdentity> bettiIdentities(const BodySurface& body,
                                           const CollocationScheme& scheme) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int f = 0; f < body.triangleCount(); ++f)
    middle += body.areas[f] / body.areas.sum() * body.centroid(f);
  std::vector<int> shellOfVertex(body.vertexCount());
  for (int f = 0; f < body.triangleCount(); ++f)
    for (int k = 0; k < 3; ++k) shellOfVertex[body.triangles(k, f)] = body.shell[f];

  const bool hasEquilibrium = scheme.kind == Collocation::Averaged && !body.exterior;
  std::vector<BettiIdentity> identities;
  for (int shell = 0; shell < static_cast<int>(body.shellIsCavity.size()); ++shell)
    identities.push_back(volumeIdentity(body, scheme, shell, shellOfVertex, middle));
  for (int motion = 0; motion < 6 && hasEquilibrium; ++motion)
    identities.push_back(equilibriumIdentity(body, scheme, motion, middle));
  orthonormaliseWeights(identities);
  return identities;
}

}  // namespace palpate::bem
