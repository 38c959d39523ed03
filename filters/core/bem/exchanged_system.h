// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vector>

#include "bem/collocation_scheme.h"
#include "linear_algebra/aligned_buffer.h"
#include "progress.h"

namespace palpate::bem {

/// What is asked of a body's system.
struct SystemColumns {
  std::vector<int> vertices;        ///< local vertices whose Green's functions are wanted
  std::vector<int> patchTractions;  ///< traction nodes of free vertices wanted by themselves
  int count() const { return static_cast<int>(vertices.size() + patchTractions.size()); }
};

/// The boundary element system of a body, A v = B v_given, with the columns already exchanged
/// ([JP01] eq. 9-10; B is minus the complementary matrix, of which only the wanted columns exist):
///   A's column:  H where the vertex is free, -G times its scale for a traction unknown;
///   B's column:  G (summed over the vertex's patches) where it is free, -H where it is fixed.
/// Columns are blocks of three. Rows are the equations in the order of assembly, which does not
/// matter to the solution.
template <class Scalar>
struct ExchangedSystem {
  int size = 0;                  ///< rows and columns of A, 3 * #equations
  int columns = 0;               ///< columns of B, 3 * wanted
  int stride = 0;                ///< from column to column of either, a whole number of cache lines
  AlignedBuffer<Scalar> matrix;  ///< A, column-major, destroyed by the solver
  AlignedBuffer<Scalar> right;   ///< B, column-major, overwritten with the solution
  /// The rows that belong with A's columns, one each: those of an equation of the same vertex.
  std::vector<int> diagonalRows;
  double rotationDefect = 0;  ///< largest |H (omega x r)| over the largest |omega x r|
};

/// Integrates and fills the system, panel by panel, so that H and G never exist as a whole.
/// @param tolerance  of an equation, see choosePanelRules.
/// @param threads    number of threads.
template <class Scalar>
ExchangedSystem<Scalar> assembleSystem(const BodySurface& body, const CollocationScheme& scheme,
                                       const SystemColumns& wanted, double tolerance, int threads,
                                       const Progress& progress);

extern template ExchangedSystem<double> assembleSystem(const BodySurface&, const CollocationScheme&,
                                                       const SystemColumns&, double, int,
                                                       const Progress&);
extern template ExchangedSystem<float> assembleSystem(const BodySurface&, const CollocationScheme&,
                                                      const SystemColumns&, double, int,
                                                      const Progress&);

}  // namespace palpate::bem
