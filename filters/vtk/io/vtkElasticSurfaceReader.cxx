// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkElasticSurfaceReader.h"

#include "checked_read.h"
#include "file_checks.h"
#include "mesh/polygon_file.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
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

namespace
{
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

} // namespace

void vtkElasticSurfaceReader::Read(const std::string& path, vtkPolyData* output)
{
  palpate::io::requireReadable(path);
  const std::string extension = vtksys::SystemTools::LowerCase(
    vtksys::SystemTools::GetFilenameLastExtension(path));
  if (extension == ".vtp")
  {
    palpate::io::readXml<vtkXMLPolyDataReader>(path, output);
  }
  else if (extension == ".stl")
  {
    palpate::io::requireWholeStl(path);
    palpate::io::readWarily<vtkSTLReader>(path, output);
  }
  else if (extension == ".obj")
  {
    palpate::io::requireNumbersInObj(path);
    palpate::io::readWarily<vtkOBJReader>(path, output);
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
      "files of this kind are not read: choose .vtp, .stl, .obj, .ply or .off, of volume meshes .vtu or "
      ".vtk, which `meshio convert` makes of Gmsh's .msh and others");
  }
  const vtkIdType points = output->GetNumberOfPoints();
  for (vtkCellArray* cells :
    { output->GetVerts(), output->GetLines(), output->GetPolys(), output->GetStrips() })
  {
    palpate::io::requireConsistentCells(cells, points);
  }
  if (points == 0 || output->GetNumberOfCells() == 0)
  {
    throw std::runtime_error("the file holds no surface");
  }
  palpate::io::requireConsistentArrays(output->GetPointData(), points, "point");
  palpate::io::requireConsistentArrays(output->GetCellData(), output->GetNumberOfCells(), "cell");
}
