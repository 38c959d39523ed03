// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkLoopRefinement
 * @brief subdivides a closed surface by Loop's scheme and carries its data along
 *
 * Each level splits every triangle in four and moves the vertices towards the smooth limit surface (C.
 * Loop 1987; James & Pai 2001, section 3.2; OpenMesh). Old vertices keep their numbers. A new vertex
 * is fixed if both ends of its edge are; other point data are the mean of the ends'. Triangles inherit
 * cell data. Green's functions, vertex areas, stiffnesses, results of contacts and smooth patches that
 * were found, not given, are dropped, as they belong to the coarse mesh.
 */

#ifndef vtkLoopRefinement_h
#define vtkLoopRefinement_h

#include "vtkElastostaticAlgorithm.h"

class PALPATEELASTOSTATICS_EXPORT vtkLoopRefinement : public vtkElastostaticAlgorithm
{
public:
  static vtkLoopRefinement* New();
  vtkTypeMacro(vtkLoopRefinement, vtkElastostaticAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How often every triangle is split in four, 0 to 8. Default 1.
   */
  vtkSetClampMacro(NumberOfLevels, int, 0, 8);
  vtkGetMacro(NumberOfLevels, int);
  ///@}

protected:
  vtkLoopRefinement() = default;
  ~vtkLoopRefinement() override = default;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkLoopRefinement(const vtkLoopRefinement&) = delete;
  void operator=(const vtkLoopRefinement&) = delete;

  int NumberOfLevels = 1;
};

#endif
