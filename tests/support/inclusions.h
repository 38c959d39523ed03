// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "fem/modulus_response.h"
#include "identification/compliance_correction.h"
#include "identification/stiffness_field.h"
#include "identification/stiffness_modes.h"
#include "support/rigs.h"
#include "support/solids.h"

namespace palpate::test {

/// Bodies that are not what they look like from outside, on rigs.
namespace inclusions {

constexpr double kYoung = 2e4, kPoisson = 0.3;
inline const Eigen::Vector3d kBall(0.5, 0.5, 0.6);

inline bool base(const Eigen::Vector3d& x) {
  return x.z() < 1e-9;
}

inline Eigen::Matrix3Xd centresOf(const TetrahedralMesh& mesh) {
  Eigen::Matrix3Xd centres(3, mesh.cellCount());
  for (int c = 0; c < mesh.cellCount(); ++c)
    centres.col(c) = mesh.points()(Eigen::all, mesh.tetrahedra().col(c)).rowwise().mean();
  return centres;
}

/// A cube of edge 1 m on its base, in whose upper middle a ball is of another stiffness, by this
/// factor.
inline SolidProblem cubeWithBall(int divisions, double factor, double poisson = kPoisson) {
  const TetrahedralMesh mesh = kuhnBox({1, 1, 1}, {divisions, divisions, divisions}).mesh();
  const Eigen::Matrix3Xd centres = centresOf(mesh);
  std::vector<int> materials;
  for (const auto& centre : centres.colwise()) materials.push_back((centre - kBall).norm() < 0.37);
  const ElasticModel model = makeModel(boundaryOf(mesh), base, 1, poisson);
  return SolidProblem{model, SolidBody(model.mesh(), mesh,
                                       {Elasticity(Material(kYoung, poisson)),
                                        Elasticity(Material(kYoung * factor, poisson))},
                                       materials)};
}

/// Of displacements predicted for a table's probes.
/// @param predicted  3 by #markers.
inline double relativeError(const Eigen::Matrix3Xd& predicted, const Measurements& m) {
  double error = 0, size = 0;
  for (Eigen::Index i = 0; i < predicted.cols(); ++i) {
    error += (predicted.col(i) - m.displacements[i].displacement).squaredNorm();
    size += m.displacements[i].displacement.squaredNorm();
  }
  return std::sqrt(error / size);
}

inline RigSettings rigOf(int probes, double noise, unsigned seed = 1) {
  RigSettings rig;
  rig.radius = 0.3;
  rig.probes = probes;
  rig.noise = noise;
  rig.seed = seed;
  return rig;
}

/// What a field is identified with: a coarser cube of one stiffness.
struct FieldPrior {
  TetrahedralMesh mesh;
  ElasticModel model;

  explicit FieldPrior(int divisions)
      : mesh(kuhnBox({1, 1, 1}, {divisions, divisions, divisions}).mesh()),
        model(makeModel(boundaryOf(mesh), base, 1, kPoisson)) {}

  StiffnessField identified(const Measurements& m, const StiffnessFieldOptions& options,
                            int modes = 50, double length = 0.3) const {
    const RigSetup rig = setupOn(model, m);
    const ModulusResponse response(model, mesh,
                                   stiffnessModes(centresOf(mesh), mesh.volumes(), length, modes),
                                   nodalForces(rig.setup, m, model.mesh().vertexAreas()));
    return identifyStiffnessField(
        [&](const Eigen::VectorXd& modulus, double poisson, bool derivatives,
            const Progress& progress) {
          auto answer = response.at(modulus, poisson, derivatives, progress);
          return MovedSurface{std::move(answer.displacements), std::move(answer.byModes)};
        },
        response.modes(), mesh.volumes(), rig.setup, m, options);
  }

  /// Relative error of the displacements that a body of these moduli predicts.
  double errorOf(const Eigen::VectorXd& modulus, double poisson, const Measurements& m) const {
    const RigSetup rig = setupOn(model, m);
    const ModulusResponse response(model, mesh, Eigen::MatrixXd(mesh.cellCount(), 0),
                                   nodalForces(rig.setup, m, model.mesh().vertexAreas()));
    const Eigen::MatrixXd moved = response.at(modulus, poisson, false).displacements;
    Eigen::Matrix3Xd predicted = Eigen::Matrix3Xd::Zero(3, rig.setup.markerCount());
    for (int i = 0; i < rig.setup.markerCount(); ++i)
      for (int k = 0; k < 3; ++k)
        predicted.col(i) += rig.setup.weights[i][k] *
                            moved.col(rig.setup.probeOf[i]).segment<3>(3 * rig.setup.nodes[i][k]);
    return relativeError(predicted, m);
  }
};

/// What is corrected: the Green's functions of a coarser cube of one stiffness.
struct CorrectionPrior {
  SolidProblem problem;
  std::shared_ptr<const GreensFunctions> greens;

  explicit CorrectionPrior(int divisions, double poisson = kPoisson)
      : problem(cubeWithBall(divisions, 1, poisson)), greens(problem.greens()) {}

  CorrectedGreensFunctions corrected(const Measurements& m,
                                     const CorrectionOptions& options = {}) const {
    const RigSetup rig = setupOn(problem.model, m);
    return correctCompliance(*greens, problem.model, rig.setup, m, options);
  }
  /// Relative error of the displacements that Green's functions predict.
  double errorOf(const GreensFunctions& of, const Measurements& m) const {
    const RigSetup rig = setupOn(problem.model, m);
    const MeasuredResponse response(of, rig.setup, false);
    Eigen::Matrix3Xd predicted(3, rig.setup.markerCount());
    for (int i = 0; i < rig.setup.markerCount(); ++i)
      predicted.col(i) =
          response.rows().middleRows<3>(3 * i) * m.probes[m.displacements[i].probe].force;
    return relativeError(predicted, m);
  }
};

}  // namespace inclusions
}  // namespace palpate::test
