// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkOriginalSurface
 * @brief shows on the original surface what a model of a coarser mesh does
 *
 * Input: polydata that came of vtkIsotropicRemeshing with KeepOriginal on, through any filters that leave
 * its points and triangles alone: a model that was pressed, say. Output: the original's points and
 * triangles with the input's results. Point data of real numbers are interpolated between the corners of
 * the triangle that each point lies on, `BoundaryType` follows the larger part of the weights, and each
 * triangle has the cell data of the nearest one that does not face the other way. Field data stay but for the Green's functions, which are
 * of the coarse mesh, so that the output is no model: contacts belong upstream.
 */

#ifndef vtkOriginalSurface_h
#define vtkOriginalSurface_h

#include "vtkElastostaticAlgorithm.h"

class PALPATEELASTOSTATICS_EXPORT vtkOriginalSurface : public vtkElastostaticAlgorithm
{
public:
  static vtkOriginalSurface* New();
  vtkTypeMacro(vtkOriginalSurface, vtkElastostaticAlgorithm);

protected:
  vtkOriginalSurface() = default;
  ~vtkOriginalSurface() override = default;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkOriginalSurface(const vtkOriginalSurface&) = delete;
  void operator=(const vtkOriginalSurface&) = delete;
};

#endif
