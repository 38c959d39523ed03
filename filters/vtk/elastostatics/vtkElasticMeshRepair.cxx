// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkElasticMeshRepair.h"

#include "array_names.h"
#include "conversion.h"
#include "mesh/repair.h"

#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkElasticMeshRepair);

void vtkElasticMeshRepair::Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector**)
{
  namespace convert = palpate::convert;
  const Eigen::Matrix3Xi triangles = convert::triangulatedCellsOf(input);
  const bool onlyTriangles = convert::hasOnlyTriangles(input);
  output->GetFieldData()->RemoveArray(palpate::arrays::RepairChanges); // of an earlier repair
  const palpate::RepairedSurface repaired = palpate::repairSurface(convert::pointsOf(input),
    triangles,
    [this](double fraction, const char* stage) { return this->ReportProgress(fraction, stage); });
  std::vector<std::string> changes = repaired.changes;
  if (!onlyTriangles)
  {
    changes.insert(changes.begin(), "cut polygons and strips into triangles, dropped other cells");
  }
  if (changes.empty())
  {
    return; // the output is the input
  }

  output->Initialize();
  output->GetFieldData()->ShallowCopy(input->GetFieldData());
  convert::setSurface(output, repaired.points, repaired.triangles);
  // Data of new points and cells are zero: free, and on smooth patch 0.
  const auto copy = [](vtkDataSetAttributes* from, vtkDataSetAttributes* to,
                      const std::vector<int>& origin)
  {
    to->CopyAllocate(from, static_cast<vtkIdType>(origin.size()));
    for (std::size_t i = 0; i < origin.size(); ++i)
    {
      origin[i] >= 0 ? to->CopyData(from, origin[i], i) : to->NullData(i);
    }
  };
  copy(input->GetPointData(), output->GetPointData(), repaired.originalVertex);
  if (onlyTriangles)
  {
    copy(input->GetCellData(), output->GetCellData(), repaired.originalTriangle);
  }
  convert::removeMeshResults(output);
  if (convert::hasField(input, palpate::arrays::SmoothAngle))
  {
    output->GetFieldData()->RemoveArray(palpate::arrays::SmoothAngle);
    output->GetCellData()->RemoveArray(palpate::arrays::SmoothPatch);
  }
  convert::setFieldStrings(output, palpate::arrays::RepairChanges, changes);
}
