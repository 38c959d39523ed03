// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkElasticSurfaceReader.h"

#include "file_checks.h"
#include "mesh/polygon_file.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkOBJReader.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSTLReader.h"
#include "vtkXMLPolyDataReader.h"
#include "vtksys/SystemTools.hxx"

#include <iostream>
#include <stdexcept>
#include <string>

vtkStandardNewMacro(vtkElasticSurfaceReader);

vtkElasticSurfaceReader::vtkElasticSurfaceReader()
{
  this->SetNumberOfInputPorts(0);
}

void vtkElasticSurfaceReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "FailureMessage: " << this->FailureMessage << "\n";
}

void vtkElasticSurfaceReader::SetFileName(const char* path)
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
/// VTK's readers print what is wrong and go on; this keeps them quiet and remembers that it was.
class QuietRead
{
public:
  explicit QuietRead(vtkAlgorithm* reader)
    : DisplayBefore(vtkObject::GetGlobalWarningDisplay())
  {
    vtkObject::SetGlobalWarningDisplay(0);
    vtkNew<vtkCallbackCommand> note;
    note->SetClientData(&this->Failed);
    note->SetCallback([](vtkObject*, unsigned long, void* failed, void*)
      { *static_cast<bool*>(failed) = true; });
    reader->AddObserver(vtkCommand::ErrorEvent, note);
  }
  ~QuietRead() { vtkObject::SetGlobalWarningDisplay(this->DisplayBefore); }
  bool HasFailed() const { return this->Failed; }

private:
  vtkTypeBool DisplayBefore;
  bool Failed = false;
};

/// CGAL says what is wrong with a PLY file on std::cerr.
class QuietErrorStream
{
public:
  QuietErrorStream()
    : Before(std::cerr.rdbuf(nullptr))
  {
  }
  ~QuietErrorStream()
  {
    std::cerr.rdbuf(this->Before);
    std::cerr.clear();
  }

private:
  std::streambuf* Before;
};

template <class Reader>
void readWith(const std::string& path, vtkPolyData* output)
{
  vtkNew<Reader> reader;
  const QuietRead quiet(reader);
  reader->SetFileName(path.c_str());
  reader->Update();
  if (quiet.HasFailed() || reader->GetErrorCode() != 0)
  {
    throw std::runtime_error("the file is damaged or not of the kind that its extension says");
  }
  output->ShallowCopy(reader->GetOutput());
}

template <class Reader>
void readWarily(const std::string& path, vtkPolyData* output)
{
  palpate::io::rehearse(path,
    [&]
    {
      vtkNew<vtkPolyData> unused;
      readWith<Reader>(path, unused);
    });
  readWith<Reader>(path, output);
}

void setPolygons(const palpate::PolygonSoup& soup, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (Eigen::Index i = 0; i < soup.points.cols(); ++i)
  {
    points->InsertNextPoint(soup.points.col(i).data());
  }
  vtkNew<vtkCellArray> polys;
  for (const std::vector<int>& polygon : soup.polygons)
  {
    polys->InsertNextCell(static_cast<int>(polygon.size()));
    for (int corner : polygon)
    {
      polys->InsertCellPoint(corner);
    }
  }
  output->SetPoints(points);
  output->SetPolys(polys);
}

void requireConsistentCells(vtkCellArray* cells, vtkIdType pointCount)
{
  if (!cells || cells->GetNumberOfCells() == 0)
  {
    return;
  }
  if (!cells->IsValid())
  {
    throw std::runtime_error("the file's cells are damaged");
  }
  vtkDataArray* corners = cells->GetConnectivityArray();
  for (vtkIdType i = 0; i < corners->GetNumberOfTuples(); ++i)
  {
    const double corner = corners->GetComponent(i, 0);
    if (!(corner >= 0 && corner < pointCount))
    {
      throw std::runtime_error("a cell refers to point " +
        std::to_string(static_cast<long long>(corner)) + ", but there are only " +
        std::to_string(pointCount));
    }
  }
}

void requireConsistentArrays(vtkDataSetAttributes* attributes, vtkIdType count, const char* what)
{
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = attributes->GetAbstractArray(i);
    if (array->GetNumberOfTuples() != count)
    {
      throw std::runtime_error(std::string("the array '") +
        (array->GetName() ? array->GetName() : "") + "' does not have a tuple a " + what);
    }
  }
}

void readFile(const std::string& path, vtkPolyData* output)
{
  palpate::io::requireReadable(path);
  const std::string extension = vtksys::SystemTools::LowerCase(
    vtksys::SystemTools::GetFilenameLastExtension(path));
  if (extension == ".vtp")
  {
    if (palpate::io::requireWholeXml(path))
    {
      readWith<vtkXMLPolyDataReader>(path, output);
    }
    else
    {
      readWarily<vtkXMLPolyDataReader>(path, output);
    }
  }
  else if (extension == ".stl")
  {
    palpate::io::requireWholeStl(path);
    readWarily<vtkSTLReader>(path, output);
  }
  else if (extension == ".obj")
  {
    palpate::io::requireNumbersInObj(path);
    readWarily<vtkOBJReader>(path, output);
  }
  else if (extension == ".ply")
  {
    const QuietErrorStream quiet;
    palpate::io::rehearse(path, [&] { palpate::readPlyFile(path); });
    setPolygons(palpate::readPlyFile(path), output);
  }
  else if (extension == ".off")
  {
    setPolygons(palpate::readOffFile(path), output);
  }
  else
  {
    throw std::runtime_error(
      "files of this kind are not read: choose .vtp, .stl, .obj, .ply or .off");
  }
  const vtkIdType points = output->GetNumberOfPoints();
  for (vtkCellArray* cells :
    { output->GetVerts(), output->GetLines(), output->GetPolys(), output->GetStrips() })
  {
    requireConsistentCells(cells, points);
  }
  if (points == 0 || output->GetNumberOfCells() == 0)
  {
    throw std::runtime_error("the file holds no surface");
  }
  requireConsistentArrays(output->GetPointData(), points, "point");
  requireConsistentArrays(output->GetCellData(), output->GetNumberOfCells(), "cell");
}
} // namespace

int vtkElasticSurfaceReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkPolyData* output = vtkPolyData::GetData(outputs);
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
