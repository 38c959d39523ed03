// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkElasticVolumeReader.h"

#include "checked_read.h"
#include "file_checks.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkUnstructuredGridReader.h"
#include "vtkXMLUnstructuredGridReader.h"
#include "vtksys/SystemTools.hxx"

#include <stdexcept>
#include <string>

vtkStandardNewMacro(vtkElasticVolumeReader);

vtkElasticVolumeReader::vtkElasticVolumeReader()
{
  this->SetNumberOfInputPorts(0);
}

void vtkElasticVolumeReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "FailureMessage: " << this->FailureMessage << "\n";
}

void vtkElasticVolumeReader::SetFileName(const char* path)
{
  const std::string value = path ? path : "";
  if (value != this->FileName)
  {
    this->FileName = value;
    this->Modified();
  }
}

namespace
{
/// Corners of the cells that Palpate has a use for, -1 for others.
vtkIdType cornersOf(int type)
{
  switch (type)
  {
    case VTK_TETRA:
      return 4;
    case VTK_QUADRATIC_TETRA:
      return 10;
    default:
      return -1;
  }
}

void requireConsistentTypes(vtkUnstructuredGrid* grid)
{
  const vtkIdType count = grid->GetNumberOfCells();
  vtkUnsignedCharArray* types = grid->GetCellTypesArray();
  if (!types || types->GetNumberOfTuples() != count)
  {
    throw std::runtime_error("the file's cells do not have a type each");
  }
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    const int type = types->GetValue(cell);
    const vtkIdType corners = cornersOf(type);
    if (type >= VTK_NUMBER_OF_CELL_TYPES ||
      (corners >= 0 && grid->GetCells()->GetCellSize(cell) != corners))
    {
      throw std::runtime_error(
        "cell " + std::to_string(cell) + " has not the corners that its type has");
    }
  }
}

void readFile(const std::string& path, vtkUnstructuredGrid* output)
{
  palpate::io::requireReadable(path);
  const std::string extension =
    vtksys::SystemTools::LowerCase(vtksys::SystemTools::GetFilenameLastExtension(path));
  if (extension == ".vtu")
  {
    palpate::io::requireWholeXml(path);
    palpate::io::readWarily<vtkXMLUnstructuredGridReader>(path, output);
  }
  else if (extension == ".vtk")
  {
    palpate::io::readWarily<vtkUnstructuredGridReader>(path, output);
  }
  else
  {
    throw std::runtime_error("volume meshes of this kind are not read: choose .vtu or .vtk, which "
                             "'meshio convert' makes of Gmsh's .msh and others");
  }
  const vtkIdType points = output->GetNumberOfPoints();
  palpate::io::requireConsistentCells(output->GetCells(), points);
  if (points == 0 || output->GetNumberOfCells() == 0)
  {
    throw std::runtime_error("the file holds no volume mesh");
  }
  requireConsistentTypes(output);
  palpate::io::requireConsistentArrays(output->GetPointData(), points, "point");
  palpate::io::requireConsistentArrays(output->GetCellData(), output->GetNumberOfCells(), "cell");
}
} // namespace

int vtkElasticVolumeReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputs);
  this->FailureMessage.clear();
  try
  {
    readFile(this->FileName, output);
    return 1;
  }
  catch (const std::exception& failure)
  {
    this->FailureMessage = this->FileName + ": " + failure.what();
  }
  output->Initialize();
  vtkErrorMacro(<< this->FailureMessage);
  return 0;
}
