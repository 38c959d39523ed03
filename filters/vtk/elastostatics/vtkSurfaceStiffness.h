// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkSurfaceStiffness
 * @brief the stiffness that a point-like contact feels at every vertex
 *
 * Adds the point arrays `Stiffness` (3 by 3, row by row, N/m; symmetric positive definite),
 * `StiffnessNorm` (Frobenius), `StiffnessAsymmetry` (relative, of the vertex's compliance before it is
 * symmetrised: zero for single vertices of reciprocal Green's functions, and otherwise larger the more
 * the surface varies under the mask), `StiffnessLimited` (1 where in some direction it is taken from the
 * mean displacement under the mask, as the vertex's own would be more than twice as stiff or no
 * stiffness at all: on walls that the mesh does not resolve), `MaskSupportShare` and `MaskBeyondShare`
 * (of each vertex's mask, see vtkVertexPressureMask), `HapticRatio` (of K^H to K^E) and `VertexArea`. Fixed vertices show the rigid stiffness; vertices whose mask needs columns that were not
 * computed, or whose compliance is that of no stiffness, show NaN. Input: a surface with its Green's
 * functions. James & Pai 2001, eq. 32, 33 and section 6.4; fig. 7 is this array without and with a mask.
 */

#ifndef vtkSurfaceStiffness_h
#define vtkSurfaceStiffness_h

#include "vtkMaskedContactAlgorithm.h"

class PALPATEELASTOSTATICS_EXPORT vtkSurfaceStiffness : public vtkMaskedContactAlgorithm
{
public:
  static vtkSurfaceStiffness* New();
  vtkTypeMacro(vtkSurfaceStiffness, vtkMaskedContactAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * k_Rigid (N/m): the stiffness of fixed vertices and the most that the haptic stiffness shows. 0,
   * the default, takes the stiffest free vertex.
   */
  vtkSetMacro(RigidStiffness, double);
  vtkGetMacro(RigidStiffness, double);
  ///@}

  ///@{
  /**
   * The displacement that the stiffness goes by: that of the vertex itself (default, eq. 32), or the
   * mean under the mask, on which the mask's force does its work.
   */
  enum MeasureType
  {
    VERTEX = 0,
    MEAN = 1
  };
  vtkSetClampMacro(Measure, int, VERTEX, MEAN);
  vtkGetMacro(Measure, int);
  void SetMeasureToVertex() { this->SetMeasure(VERTEX); }
  void SetMeasureToMean() { this->SetMeasure(MEAN); }
  ///@}

  ///@{
  /**
   * Whether to add the point array `RotationalStiffness` (3 by 3, row by row, N m/rad): the torque per
   * mean rotation under the mask, of a contact that is free to move (footnote 7); NaN where the vertex is
   * fixed or its mask has no three nodes off one line. Default off.
   */
  vtkSetMacro(Rotational, bool);
  vtkGetMacro(Rotational, bool);
  vtkBooleanMacro(Rotational, bool);
  ///@}

protected:
  vtkSurfaceStiffness() = default;
  ~vtkSurfaceStiffness() override = default;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkSurfaceStiffness(const vtkSurfaceStiffness&) = delete;
  void operator=(const vtkSurfaceStiffness&) = delete;

  double RigidStiffness = 0;
  int Measure = VERTEX;
  bool Rotational = false;
};

#endif
