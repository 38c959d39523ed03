// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "bem/boundary_element_method.h"
#include "contact/frictional_contact_solver.h"
#include "support_options.h"

namespace palpate::app {

/// What is asked of a body's Green's functions.
enum class QueryKind {
  Compliance,  ///< 3 by 3 compliances under a mask at points
  Greens,  ///< displacement of the whole surface under masked forces, or of a point source's field
  Force,   ///< on a ball that is pressed in at points
};

/// Rows of which a query evaluates the deformation.
enum class Rows { Contact, Visible, All };

/// Where traction may jump.
enum class TractionJumps {
  SharpEdges,  ///< and at the borders of patches that are given
  Nowhere,     ///< one traction per vertex, as in [JP01]
  Support,     ///< at sharp edges, and round the support: its triangles are patches of their own
};

/// What Green's functions are computed by.
enum class Method { BoundaryElements, QuadraticTetrahedra, LinearTetrahedra, ThinShell, HalfSpace };

/// As `precompute` calls it: bem, fem, shell or halfspace.
Method methodNamed(const std::string& name);
/// For people.
std::string nameOf(Method method);

/// One way to an answer: a value of every knob.
struct Setting {
  // What the Green's functions are computed by.
  int level = 1;
  Method method = Method::BoundaryElements;
  double tolerance = BoundaryElementOptions().tolerance;
  Precision precision = Precision::Double;
  LinearSolver solver = LinearSolver::Direct;
  Collocation collocation = Collocation::Averaged;
  TractionJumps jumps = TractionJumps::SharpEdges;
  bool allColumns = false;  ///< all free nodes', or those that the query needs
  bool reciprocal = true;
  double radius = 0;  ///< of the mask, m
  // What the query is made by.
  bool floatStorage = false;
  Rows rows = Rows::Contact;
  double contactTolerance = ContactSolverSettings().tolerance;

  /// Equal for settings that share their Green's functions.
  auto precomputeKey() const {
    return std::tuple(level, method, tolerance, precision, solver, collocation, jumps, allColumns,
                      reciprocal, radius);
  }
  auto key() const {
    return std::tuple_cat(precomputeKey(), std::tuple(floatStorage, rows, contactTolerance));
  }
};

/// A value of a knob that is tried.
struct Trial {
  std::string knob, value;
  std::string series;  ///< of the plot
  Setting setting;
  bool isPrecompute;  ///< whether the time that the knob changes is that of the Green's functions
  std::optional<Setting> best;  ///< the knob at its most accurate, where it has such a value
};

/// What a body's material is identified from: a rig's measurements of a model.
struct RigOptions {
  std::string model;  ///< its file
  int probes = 10, markers = 50, seed = 1;
  double noise = 0.01, outliers = 0.05;  ///< as vtkRigSimulation has them
};

/// What `palpate accuracy` is asked for.
struct AccuracyOptions {
  std::string input;
  SupportOptions support;
  std::string method = "bem";
  double thickness = 0;  ///< of a shell, m, 0 for the surface's array
  bool hinged = false;   ///< a shell's fixed vertices may turn
  std::string query = "compliance";
  RigOptions rig;                    ///< of the query identification
  std::vector<double> points;        ///< x y z of each; empty: spread over the surface
  double radius = 0;                 ///< m, 0 for a mean edge of the surface as it is
  double ballRadius = 0, depth = 0;  ///< m, 0 for the mask's radius, and a tenth of the ball's
  std::vector<int> levels{1, 2, 3};
  int baseLevel = 0;       ///< of the knobs other than the level; 0 for the last but one
  int referenceLevel = 0;  ///< the finest that is extrapolated from; 0 for the last of the levels
  std::vector<std::string> knobs;  ///< empty: all that the query has
  std::string reference;           ///< empty: boussinesq where it can be, else finest
  std::string subdivision;  ///< empty: loop for bodies, curved for shells, flat for half-spaces
  std::string clock = "wall";
  int repeats = 5, threads = 0;
  double budget = 60;  ///< s that a setting may take in all before it is not repeated any more
};

}  // namespace palpate::app
