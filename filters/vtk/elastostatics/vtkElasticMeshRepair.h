// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkElasticMeshRepair
 * @brief mends a surface so that it bounds elastic bodies
 *
 * Cuts polygons and strips into triangles, welds duplicate vertices, drops degenerate, repeated and
 * unusable triangles, stitches and fills holes, removes self-intersections and turns triangles to
 * point out of the material, with CGAL. Point and cell data of what was kept are carried along. The
 * output is guaranteed to be a surface that the other filters accept. Each kind of change is one
 * sentence of the field array `RepairChanges`; a sound surface passes through unchanged.
 */

#ifndef vtkElasticMeshRepair_h
#define vtkElasticMeshRepair_h

#include "vtkElastostaticAlgorithm.h"

class PALPATEELASTOSTATICS_EXPORT vtkElasticMeshRepair : public vtkElastostaticAlgorithm
{
public:
  static vtkElasticMeshRepair* New();
  vtkTypeMacro(vtkElasticMeshRepair, vtkElastostaticAlgorithm);

protected:
  vtkElasticMeshRepair() = default;
  ~vtkElasticMeshRepair() override = default;
  void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) override;

private:
  vtkElasticMeshRepair(const vtkElasticMeshRepair&) = delete;
  void operator=(const vtkElasticMeshRepair&) = delete;
};

#endif
