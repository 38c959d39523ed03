// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkSolidBoundary.h"

#include "volume_arrays.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

vtkStandardNewMacro(vtkSolidBoundary);

int vtkSolidBoundary::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  return 1;
}

void vtkSolidBoundary::Compute(vtkPolyData*, vtkPolyData* output, vtkInformationVector** inputs)
{
  output->ShallowCopy(palpate::convert::boundaryOf(vtkUnstructuredGrid::GetData(inputs[0])));
}
