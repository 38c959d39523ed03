// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_model_arrays_h
#define palpate_model_arrays_h

#include "greens/computed_greens_functions.h"
#include "greens/greens_functions.h"
#include "model/elastic_model.h"

#include <memory>

class vtkPolyData;

/// Elastic models and their Green's functions as polydata with arrays (see array_names.h). Not for
/// wrapping. All functions throw std::invalid_argument with a sentence for data that cannot be used.
namespace palpate::convert
{
/// A surface checked whole, self-intersections included.
std::shared_ptr<const SurfaceMesh> soundMeshOf(vtkPolyData* surface, Rims rims = Rims::Refused);

/// A surface, with rims only if it carries Green's functions of a half-space, a shell or a given matrix.
SurfaceMesh meshOf(vtkPolyData* surface);

/// The reference problem of a surface with boundary types, smooth patches and material.
/// @param smoothAngle  for smooth patches where the surface carries no SmoothPatch array; a shell has one
///                     a piece.
/// @param domain       Given needs no material.
ElasticModel modelOf(vtkPolyData* surface, double smoothAngle, Domain domain);

/// Adds Green's functions with their provenance and diagnostics. Takes over their memory. Those of a
/// half-space have no matrix.
void setGreensFunctions(vtkPolyData* surface, const ElasticModel& model, ComputedGreensFunctions result);

/// Gives a surface the Green's functions that setGreensFunctions added to another, without copying, in
/// place of its own.
/// @param youngsModulus  of the surface, by which the diagnostics that depend on it are scaled.
void shareGreensFunctions(vtkPolyData* from, vtkPolyData* surface, double youngsModulus);

/// A surface with the Green's functions that it carries, ready to serve; the matrix is not copied.
struct ServedModel
{
  std::shared_ptr<const SurfaceMesh> mesh;
  std::shared_ptr<const GreensFunctions> greens;
  Eigen::VectorXi smoothPatches;
};

/// @throws also if the Green's functions belong to another mesh, other boundary types or patches, or
///         if an array has not the size or the finite values that it must have.
ServedModel servedModelOf(vtkPolyData* surface);
} // namespace palpate::convert

#endif
