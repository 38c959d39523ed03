// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkShellGreensFunctions
 * @brief computes the Green's functions of plates and thin shells
 *
 * The input is a triangle surface, the middle of the shell, with the field data `YoungsModulus` and
 * `PoissonRatio` and the point array `BoundaryType` (vtkReferenceBoundaryConditions). It may be open or
 * closed, folded, in several pieces; edges of more than two triangles are refused. It is touched from the
 * side that its normals point to.
 *
 * Its thickness is Thickness, or a point array `Thickness`, linear between the points, or a cell array of
 * that name. Fixed points hold their displacements and, with Clamped on, their rotations, too: each piece
 * needs one clamped point or three that are not on one line. An optional point array `HeldComponents`
 * (6 numbers, 0 or 1) holds single displacements (x, y, z) and rotations (about x, y, z) besides, as planes
 * of symmetry and diaphragms do; a point whose whole displacement it holds is fixed, and turns as it says.
 *
 * The output carries the same arrays as that of vtkBoundaryElementGreensFunctions, `Thickness` and
 * `Clamped`. Method: flat triangles with six degrees of freedom a corner, DKT in bending (J.-L. Batoz,
 * K.-J. Bathe, L.-W. Ho, Int. J. Numer. Methods Engrg. 15, 1980) and OPT with drilling rotations in their
 * plane (C. A. Felippa, Comput. Methods Appl. Mech. Engrg. 192, 2003), which are resisted less where
 * triangles are chords of a curved surface, see palpate::shell::shellStiffness. Compliances are symmetric
 * to rounding, which Reciprocal takes away. SmoothAngle plays no part and PatchColumns are refused, for a
 * shell takes one traction a point.
 */

#ifndef vtkShellGreensFunctions_h
#define vtkShellGreensFunctions_h

#include "vtkGreensFunctionsAlgorithm.h"

class PALPATEELASTOSTATICS_EXPORT vtkShellGreensFunctions : public vtkGreensFunctionsAlgorithm
{
public:
  static vtkShellGreensFunctions* New();
  vtkTypeMacro(vtkShellGreensFunctions, vtkGreensFunctionsAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The thickness everywhere, m; 0, the default, for what the array `Thickness` says.
   */
  vtkSetMacro(Thickness, double);
  vtkGetMacro(Thickness, double);
  ///@}

  ///@{
  /**
   * Hold the rotations of fixed points, too (default), or let them turn as on hinges.
   */
  vtkSetMacro(Clamped, bool);
  vtkGetMacro(Clamped, bool);
  vtkBooleanMacro(Clamped, bool);
  ///@}

  ///@{
  /**
   * Nothing holds the shell, and BoundaryType is not read: as Domain UNSUPPORTED of
   * vtkBoundaryElementGreensFunctions. Default off.
   */
  vtkSetMacro(Unsupported, bool);
  vtkGetMacro(Unsupported, bool);
  vtkBooleanMacro(Unsupported, bool);
  ///@}

  ///@{
  /**
   * Estimate the relative error (palpate::estimateShellError) on a mesh of four times the vertices, which
   * takes sixteen times as long as the model itself; of models of up to a thousand vertices. Default off.
   */
  vtkSetMacro(EstimateError, bool);
  vtkGetMacro(EstimateError, bool);
  vtkBooleanMacro(EstimateError, bool);
  ///@}

protected:
  vtkShellGreensFunctions() = default;
  ~vtkShellGreensFunctions() override = default;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkShellGreensFunctions(const vtkShellGreensFunctions&) = delete;
  void operator=(const vtkShellGreensFunctions&) = delete;

  double Thickness = 0;
  bool Clamped = true;
  bool Unsupported = false;
  bool EstimateError = false;
};

#endif
