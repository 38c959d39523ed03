// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/paper_models.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <stdexcept>

#include "mesh/loop_subdivision.h"

namespace palpate::bench {

ElasticModel paperModel(const std::string& name, int steps) {
  const std::string path = std::string(PALPATE_DATA_DIRECTORY) + "/" + name + ".vtp";
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData* surface = reader->GetOutput();
  vtkDataArray* boundary = surface->GetPointData()->GetArray("BoundaryType");
  if (!boundary) throw std::runtime_error("cannot read " + path);

  LoopLevel level;
  level.points.resize(3, surface->GetNumberOfPoints());
  std::vector<unsigned char> types;
  for (int v = 0; v < level.points.cols(); ++v) {
    surface->GetPoint(v, level.points.col(v).data());
    types.push_back(static_cast<unsigned char>(boundary->GetComponent(v, 0)));
  }
  level.triangles.resize(3, surface->GetNumberOfCells());
  for (int f = 0; f < level.triangles.cols(); ++f) {
    vtkIdType count;
    const vtkIdType* corners;
    surface->GetPolys()->GetCellAtId(f, count, corners);
    for (int k = 0; k < 3; ++k) level.triangles(k, f) = static_cast<int>(corners[k]);
  }
  for (int step = 0; step < steps; ++step) {
    level = subdivideLoop(level.points, level.triangles);
    types = refineBoundaryTypes(level, types);
  }

  const auto number = [&](const char* field) {
    return surface->GetFieldData()->GetArray(field)->GetComponent(0, 0);
  };
  const int triangles = static_cast<int>(level.triangles.cols());
  return ElasticModel(std::make_shared<SurfaceMesh>(level.points, level.triangles),
                      Material(number("YoungsModulus"), number("PoissonRatio")),
                      BoundaryConditions(types), Eigen::VectorXi::Zero(triangles));
}

}  // namespace palpate::bench
