// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <functional>
#include <memory>

#include "bem/boundary_element_method.h"
#include "model/elastic_model.h"
#include "support/shapes.h"

namespace palpate::test {

using Place = std::function<bool(const Eigen::Vector3d&)>;

/// The support of most unit spheres here: z below -0.79, between two rings of an icosphere.
inline bool cap(const Eigen::Vector3d& x) {
  return x.z() < -0.79;
}

/// Nodal values of an elastic state.
struct NodalField {
  Eigen::Matrix3Xd displacement, traction;  ///< 3 by #V
};

/// On a unit sphere, the field of the point force (0.3, -0.5, 1) at (0.3, 0.4, 1.9) outside it: A2.
NodalField pointSourceField(const ElasticModel& model);

/// Relative error of the free nodes' displacement of a body that fills a unit sphere under that
/// field.
double pointSourceError(const ElasticModel& model);

/// On a sphere of radii 1 and 2 under a unit pressure inside, for E = 1: A8. Displacements are
/// given where it is fixed, tractions elsewhere.
struct ThickSphere {
  Eigen::Matrix3Xd exact, given;  ///< 3 by #V: displacement, and what solveReferenceProblem takes
};
ThickSphere thickSphere(const ElasticModel& model);

/// The patch test: largest error of the free nodes' displacement, over the largest displacement, of
/// a body of any polyhedron under uniform stress. The displacement is given at the support, the
/// tractions on the triangles elsewhere; the discretisation holds the exact solution, integration
/// aside.
double patchTestError(const ElasticModel& model, BoundaryElementOptions options);

/// A model of a shape, fixed where `fixed` says.
ElasticModel makeModel(const Shape& shape, const Place& fixed, double youngsModulus,
                       double poissonRatio, double smoothAngle = 30,
                       Domain domain = Domain::Interior);

/// Its Green's functions, raw unless the options say otherwise.
std::shared_ptr<const GreensFunctions> computeGreens(const ElasticModel& model,
                                                     BoundaryElementOptions options);

/// Options with all nodes' columns, not symmetrised: the plain discretisation.
BoundaryElementOptions rawWithAllColumns(const ElasticModel& model);

/// Options with the free nodes' columns, not symmetrised.
BoundaryElementOptions raw();

/// sqrt(sum a_i |x_i - y_i|^2 / sum a_i |y_i|^2) over the nodes where `where` holds.
double relativeError(const Eigen::Matrix3Xd& values, const Eigen::Matrix3Xd& exact,
                     const ElasticModel& model, const std::function<bool(int)>& where);

/// Slope of log(error) over log(mesh size) between two meshes, size falling like vertices^-1/2.
double convergenceOrder(double coarseError, int coarseVertices, double fineError, int fineVertices);

}  // namespace palpate::test
