// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkIsotropicRemeshing
 * @brief another mesh of a closed surface, with edges of about one length
 *
 * Edges are split, collapsed and flipped, vertices relaxed and projected onto the old surface (CGAL). Sharp
 * edges, the rims of smooth patches and the rim of the support keep their place: a triangle belongs to
 * the support if all its corners are fixed. `BoundaryType`, a given `SmoothPatch` and the field data of
 * the material are carried over; other point and cell data are dropped, as are Green's functions and what
 * came of them. Stiffnesses of several meshes of one object show what is the mesh's (James & Pai
 * 2001, section 6).
 */

#ifndef vtkIsotropicRemeshing_h
#define vtkIsotropicRemeshing_h

#include "vtkElastostaticAlgorithm.h"

class PALPATEELASTOSTATICS_EXPORT vtkIsotropicRemeshing : public vtkElastostaticAlgorithm
{
public:
  static vtkIsotropicRemeshing* New();
  vtkTypeMacro(vtkIsotropicRemeshing, vtkElastostaticAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The wanted length of edges, in the surface's unit. 0, the default, takes the surface's mean edge.
   */
  vtkSetMacro(EdgeLength, double);
  vtkGetMacro(EdgeLength, double);
  ///@}

  ///@{
  /**
   * How often the mesh is worked over, 1 to 100. Default 3.
   */
  vtkSetClampMacro(NumberOfIterations, int, 1, 100);
  vtkGetMacro(NumberOfIterations, int);
  ///@}

  ///@{
  /**
   * Edges sharper than this, in degrees, are kept where the surface has no SmoothPatch array. Default 30.
   */
  vtkSetClampMacro(SmoothAngle, double, 0, 180);
  vtkGetMacro(SmoothAngle, double);
  ///@}

  ///@{
  /**
   * Keep the input's points and triangles with the output, and where on it each of them is
   * (`OriginalPoints` and the like), so that vtkOriginalSurface can show there what a model of the output
   * does. An original that the input has already stays the original. Default off.
   */
  vtkSetMacro(KeepOriginal, bool);
  vtkGetMacro(KeepOriginal, bool);
  vtkBooleanMacro(KeepOriginal, bool);
  ///@}

protected:
  vtkIsotropicRemeshing() = default;
  ~vtkIsotropicRemeshing() override = default;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkIsotropicRemeshing(const vtkIsotropicRemeshing&) = delete;
  void operator=(const vtkIsotropicRemeshing&) = delete;

  double EdgeLength = 0;
  int NumberOfIterations = 3;
  double SmoothAngle = 30;
  bool KeepOriginal = false;
};

#endif
