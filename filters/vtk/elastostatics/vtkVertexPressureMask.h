// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkVertexPressureMask
 * @brief the pressure mask of one vertex as a point array
 *
 * Adds the point array `PressureMask` (1/m^2): the density rho of James & Pai 2001, eq. 29 to 31,
 * collocated on the free nodes, with sum of area times rho equal to one; and the field arrays
 * `MaskSupportShare` and `MaskBeyondShare`, the shares of the whole mask that would have been on fixed
 * vertices, and on other components or the far side of a wall. Needs a closed surface with
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

  ///@{
  /**
   * Whether to add the point array `TorqueMask` (3 by 3, row by row, 1/m^3): times a torque it gives the
   * traction that spreads the torque over the mask (footnote 7). Default off.
   */
  vtkSetMacro(Tensor, bool);
  vtkGetMacro(Tensor, bool);
  vtkBooleanMacro(Tensor, bool);
  ///@}

protected:
  vtkVertexPressureMask() = default;
  ~vtkVertexPressureMask() override = default;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkVertexPressureMask(const vtkVertexPressureMask&) = delete;
  void operator=(const vtkVertexPressureMask&) = delete;

  vtkIdType Vertex = 0;
  bool Tensor = false;
};

#endif
