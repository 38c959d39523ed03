// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkSurfaceStress
 * @brief strain and stress at the surface of a pressed body
 *
 * Input: a model with `Displacement` and `Traction` at its points, as vtkPointContact and
 * vtkCapacitanceSolve leave them: a solid of any materials, a cavity or a half-space. Output: the same with the cell arrays
 * `Strain` and `Stress` (six components: xx, yy, zz, xy, yz, xz; Pa), `VonMisesStress` and
 * `PrincipalStress` (three, the largest first; Pa), constant in each triangle. Along the surface strains
 * are those of the displacements, out of it those that the traction asks for
 * (palpate::surfaceFields); their error is of the first order in the edges, and under a load on a single
 * vertex they grow without bound as the mesh is refined, as the load does.
 */

#ifndef vtkSurfaceStress_h
#define vtkSurfaceStress_h

#include "vtkElastostaticAlgorithm.h"

class PALPATEELASTOSTATICS_EXPORT vtkSurfaceStress : public vtkElastostaticAlgorithm
{
public:
  static vtkSurfaceStress* New();
  vtkTypeMacro(vtkSurfaceStress, vtkElastostaticAlgorithm);

protected:
  vtkSurfaceStress() = default;
  ~vtkSurfaceStress() override = default;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkSurfaceStress(const vtkSurfaceStress&) = delete;
  void operator=(const vtkSurfaceStress&) = delete;
};

#endif
