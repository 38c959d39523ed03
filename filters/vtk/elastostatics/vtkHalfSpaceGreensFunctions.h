// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkHalfSpaceGreensFunctions
 * @brief the Green's functions of the elastic half-space below a flat surface
 *
 * The input is a flat triangle surface, open or in several pieces of one plane, with the field data
 * `YoungsModulus` and `PoissonRatio` (vtkReferenceBoundaryConditions). The material fills all that lies
 * below the plane, against the triangles' normals, and needs no support: fixed points are refused.
 *
 * No matrix is computed: the output carries the field arrays `GreensFunctionNodes`,
 * `GreensFunctionDomain` ("halfspace"), provenance and diagnostics (array_names.h), and who uses it has
 * each entry computed in closed form: Boussinesq's and Cerruti's solutions, integrated over linear
 * tractions on the triangles (palpate::HalfSpaceGreensFunctions; K. L. Johnson, "Contact mechanics",
 * 1985, chapter 3). There are no smooth patches to speak of: PatchColumns are refused.
 */

#ifndef vtkHalfSpaceGreensFunctions_h
#define vtkHalfSpaceGreensFunctions_h

#include "vtkGreensFunctionsAlgorithm.h"

class PALPATEELASTOSTATICS_EXPORT vtkHalfSpaceGreensFunctions : public vtkGreensFunctionsAlgorithm
{
public:
  static vtkHalfSpaceGreensFunctions* New();
  vtkTypeMacro(vtkHalfSpaceGreensFunctions, vtkGreensFunctionsAlgorithm);

protected:
  vtkHalfSpaceGreensFunctions() = default;
  ~vtkHalfSpaceGreensFunctions() override = default;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkHalfSpaceGreensFunctions(const vtkHalfSpaceGreensFunctions&) = delete;
  void operator=(const vtkHalfSpaceGreensFunctions&) = delete;
};

#endif
