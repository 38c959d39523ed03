// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <cstdint>
#include <vector>

#include "fem/solid_body.h"
#include "fem/solid_elements.h"
#include "greens/computed_greens_functions.h"
#include "mesh/tetrahedralization.h"
#include "model/elastic_model.h"
#include "progress.h"

namespace palpate {

struct FiniteElementOptions {
  SolidElement element = SolidElement::Quadratic;
  /// Places inside the body whose fields are wanted for any load (GreensFunctionsInfo::probes), 3
  /// by any, m. Displacements are the elements', gradients jump between them.
  Eigen::Matrix3Xd probes;
  /// Nodes whose Green's functions are computed; empty for all free nodes.
  std::vector<int> columns;
  /// Also compute, at vertices on sharp edges, the response to a traction on one patch alone.
  bool patchColumns = false;
  /// Loads and displacements conjugate to each other, so that the compliance is symmetric; else
  /// each as exact as can be.
  bool reciprocal = true;
  /// Components that symmetry or a guide holds, 3 by #V, or empty for none: along them a force does
  /// nothing. Where all three are, the vertex has to be fixed. What these bear is not known, so
  /// that such a body is looked into by its `probes` alone, as one of several materials.
  HeldDisplacements held;
  /// Also estimate the error on another mesh of the model, filled anew (see estimateError); unknown
  /// for bodies of several materials and where single components are held.
  bool estimateError = false;
};

/// What a model with held components is told from others by, from that of the model without any.
std::uint64_t heldFingerprint(const HeldDisplacements& held, std::uint64_t ofModel);

/// Computes the discrete Green's functions of a solid body by finite elements: displacements linear
/// or quadratic in tetrahedra, condensed to the vertices of its surface.
///
/// Forces F of the free vertices, F = a p, are spread over their hats as a traction t, and a
/// displacement u of each vertex is found from the means under the hats, so that with the elements'
/// stiffness K, their loads L of the hats, and the products M of two hats
///     u = R L^T K^-1 L R F,    R = (M^-1 + 1 / a) / 2.
/// M^-1 makes u the piecewise linear field nearest to the elements' displacement and t the traction
/// that does the work of F on such fields: sharper than a force at the vertex by as much as 1 / a,
/// hats as they are and means under them, is wider. Their mean has neither error of second order,
/// total forces are exactly those of F, and the force compliance is symmetric to rounding. (M^-1
/// alone errs by 4 % where that mean errs by 1 %: under a mask of three edges on a sphere.)
/// Where hats wrap round a sharp edge or end at a support, means under them belong to places beside
/// the vertex, an error of first order there. Without `reciprocal`, tractions are the hats as they
/// are, and displacements the nearest in the mean square, u = M^-1 L^T K^-1 L p, which holds linear
/// fields exactly. Reactions of fixed vertices are the forces that go with them by Betti's theorem.
/// In nearly incompressible isotropic cells (nu from 0.45 on) the pressure is an unknown of its own
/// (Taylor and Hood 1973), which does not lock up to nu = 0.5.
///
/// Where few columns are asked for they are solved for one by one, else all at once as the Schur
/// complement of a multifrontal factorisation.
/// @param model  its surface is that of the body; its material serves as unit of what is reported.
/// @throws std::invalid_argument for columns out of range, another domain, linear elements of
///         nearly incompressible materials, or components held of an unsupported body or of all
///         three of a free vertex; Aborted; std::bad_alloc; std::runtime_error if the system is
///         singular or the library was built without MUMPS.
ComputedGreensFunctions computeFiniteElementGreensFunctions(
    const ElasticModel& model, const SolidBody& body, const FiniteElementOptions& options = {},
    const ProgressCallback& progress = {});

/// The model on the boundary of what its surface was filled with: the same vertices, triangles that
/// may be others, each of the smooth patch of the nearest one.
/// @throws std::runtime_error if the boundary has new vertices.
ElasticModel onBoundary(const ElasticModel& model, const Tetrahedralization& filled);

}  // namespace palpate
