// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_stress_arrays_h
#define palpate_stress_arrays_h

#include "greens/probe_rows.h"
#include "model/elastic_model.h"

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

class vtkDataSetAttributes;
class vtkPolyData;

/// Stresses as arrays, and what they are computed from. Not for wrapping. All functions throw
/// std::invalid_argument with a sentence for data that cannot be used.
namespace palpate::convert
{
/// A deformed body with all that its surface is known to do.
struct DeformedBody
{
  ElasticModel model;
  Eigen::Matrix3Xd displacement, traction; // 3 by #points
};

/// A model with the arrays Displacement and Traction of a contact, of what nothing holds with what
/// balances it.
/// @throws also for a half-space, and for bodies of several or anisotropic materials.
DeformedBody deformedBodyOf(vtkPolyData* surface);

/// The same to look at its surface alone, of half-spaces and any materials, too.
/// @param materials  set to those behind the triangles; to nothing where the model's is.
DeformedBody deformedSurfaceOf(vtkPolyData* surface, std::vector<Elasticity>& materials);

/// Rows of points that a model carries, and the contact that they are read under.
struct StoredProbes
{
  ProbeRows rows;
  std::shared_ptr<const SurfaceMesh> mesh;
  Eigen::Matrix3Xd given; // 3 by #points: tractions, at fixed vertices displacements
};

/// Those at these places of a body of several or anisotropic materials; none for others, whose inside the
/// surface tells.
/// @throws also for such a body without rows of one of the places, or whose fixed vertices were moved
/// without Green's functions of theirs.
std::optional<StoredProbes> storedProbesOf(vtkPolyData* surface, const Eigen::Matrix3Xd& places);

/// Adds Strain, Stress (six components each, as VTK orders them), VonMisesStress and PrincipalStress.
void setStresses(vtkDataSetAttributes* attributes, const std::vector<Eigen::Matrix3d>& gradients,
  const std::vector<Eigen::Matrix3d>& stresses);
} // namespace palpate::convert

#endif
