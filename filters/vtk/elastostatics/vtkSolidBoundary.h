// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkSolidBoundary
 * @brief the closed triangle surface that bounds a body of tetrahedra
 *
 * The input is an unstructured grid; quadratic tetrahedra count by their corners, cells of lower
 * dimension do not count. The output is made of the triangles that belong to one tetrahedron alone,
 * counter-clockwise seen from outside, and of their corners, with the grid's point and field data: what
 * vtkReferenceBoundaryConditions and then the first input of vtkFiniteElementGreensFunctions take,
 * whose second is the grid itself.
 */

#ifndef vtkSolidBoundary_h
#define vtkSolidBoundary_h

#include "vtkElastostaticAlgorithm.h"

class PALPATEELASTOSTATICS_EXPORT vtkSolidBoundary : public vtkElastostaticAlgorithm
{
public:
  static vtkSolidBoundary* New();
  vtkTypeMacro(vtkSolidBoundary, vtkElastostaticAlgorithm);

protected:
  vtkSolidBoundary() = default;
  ~vtkSolidBoundary() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkSolidBoundary(const vtkSolidBoundary&) = delete;
  void operator=(const vtkSolidBoundary&) = delete;
};

#endif
