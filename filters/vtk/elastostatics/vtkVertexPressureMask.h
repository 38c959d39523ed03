// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkVertexPressureMask
 * @brief the pressure mask of one vertex as a point array
 *
 * Adds the point array `PressureMask` (1/m^2): the density rho of James & Pai 2001, eq. 29 to 31,
 * collocated on the free nodes, with sum of area times rho equal to one. Needs a closed surface with
 * `BoundaryType`, but no Green's functions.
 */

#ifndef vtkVertexPressureMask_h
#define vtkVertexPressureMask_h

#include "vtkMaskedContactAlgorithm.h"

class PALPATEELASTOSTATICS_EXPORT vtkVertexPressureMask : public vtkMaskedContactAlgorithm
{
public:
  static vtkVertexPressureMask* New();
  vtkTypeMacro(vtkVertexPressureMask, vtkMaskedContactAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The vertex at the mask's centre, which must be free. Default 0.
   */
  vtkSetMacro(Vertex, vtkIdType);
  vtkGetMacro(Vertex, vtkIdType);
  ///@}

protected:
  vtkVertexPressureMask() = default;
  ~vtkVertexPressureMask() override = default;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkVertexPressureMask(const vtkVertexPressureMask&) = delete;
  void operator=(const vtkVertexPressureMask&) = delete;

  vtkIdType Vertex = 0;
};

#endif
