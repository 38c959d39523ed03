// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <read_files.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "commands.h"
#include "conversion.h"
#include "mesh/mesh_defects.h"
#include "mesh/surface_mesh.h"
#include "terminal.h"

namespace palpate::app {
namespace {

void printDefects(const std::vector<MeshDefect>& defects) {
  printRow("sound", "no; `palpate repair` may mend it");
  for (const MeshDefect& defect : defects) std::cout << "  " << defect.sentence << "\n";
}

void printSurface(vtkPolyData* surface) {
  const double* b = surface->GetBounds();
  const double size[3] = {b[1] - b[0], b[3] - b[2], b[5] - b[4]};
  printRow("vertices", std::to_string(surface->GetNumberOfPoints()));
  printRow("cells", std::to_string(surface->GetNumberOfCells()));
  printRow("size", vectorText(size));
  if (!convert::hasOnlyTriangles(surface)) {
    printRow("sound", "no: not all cells are triangles; `palpate repair` cuts them up");
    return;
  }
  const Eigen::Matrix3Xd points = convert::pointsOf(surface);
  const Eigen::Matrix3Xi triangles = convert::trianglesOf(surface);
  const std::string domain = convert::fieldString(surface, "GreensFunctionDomain");
  const bool isSheet = domain == "halfspace" || domain == "shell" || domain == "given";
  const Rims rims = isSheet ? Rims::Allowed : Rims::Refused;
  const std::vector<MeshDefect> defects = findMeshDefects(points, triangles, 16, rims);
  if (!defects.empty()) {
    printDefects(defects);
    return;
  }
  try {
    const SurfaceMesh mesh(points, triangles, rims);
    printRow(isSheet ? "pieces" : "bodies", std::to_string(mesh.bodyCount()));
    if (!isSheet) printRow("cavities", std::to_string(mesh.shellCount() - mesh.bodyCount()));
    printRow("area", number(mesh.triangleAreas().sum()));
    printRow("mean edge length", number(mesh.meanEdgeLength()));
    const std::vector<MeshDefect> crossings = findSelfIntersections(mesh);
    if (crossings.empty())
      printRow("sound", "yes");
    else
      printDefects(crossings);
  } catch (const std::invalid_argument& inside) {
    printRow("sound", std::string("no: ") + inside.what());
  }
}

void printProblem(vtkPolyData* surface) {
  if (vtkDataArray* types = surface->GetPointData()->GetArray("BoundaryType")) {
    vtkIdType fixed = 0;
    for (vtkIdType i = 0; i < types->GetNumberOfTuples(); ++i)
      fixed += types->GetComponent(i, 0) != 0;
    printRow("fixed vertices", std::to_string(fixed));
    printRow("free vertices", std::to_string(types->GetNumberOfTuples() - fixed));
  }
  const auto printField = [&](const char* name, const std::string& label) {
    const double value = fieldNumber(surface, name, -1);
    if (surface->GetFieldData()->HasArray(name) && value != -1) printRow(label, number(value));
  };
  const bool isGiven = convert::fieldString(surface, "GreensFunctionDomain") == "given";
  printField("YoungsModulus", isGiven ? "Young's modulus for it, Pa" : "Young's modulus, Pa");
  if (!isGiven) printField("PoissonRatio", "Poisson's ratio");
  printField("Density", "density in the mean, kg/m^3");
  if (vtkDataArray* nodes = surface->GetFieldData()->GetArray("GreensFunctionNodes"))
    printRow("Green's functions of", std::to_string(nodes->GetNumberOfTuples()) + " vertices");
  for (const std::string& source : fieldStrings(surface, "GreensFunctionSource"))
    printRow("made by", source);
  printField("ConditionEstimate", "condition number");
  printErrors(surface);
  printField("ReciprocityDefect", "reciprocity defect");
  printField("RotationDefect", "integration defect");
  printField("SolverResidual", "solver residual");
  printField("WallRatio", "edge over wall thickness");
  printField("SupportWidth", "support width, edges");
  printField("RockingCompliance", "rocking compliance, rad/(N m)");
  printField("PeakBytes", "peak bytes");
  for (const std::string& warning : fieldStrings(surface, "Warnings")) printRow("warning", warning);
}

}  // namespace

void addInfo(CLI::App& program) {
  auto path = std::make_shared<std::string>();
  CLI::App* command =
      program.add_subcommand("info", "What a surface or model is, and whether it is sound");
  command->add_option("input", *path, "A .vtp, .stl, .obj, .ply or .off file")->required();
  command->callback([path] {
    const auto surface = readSurface(*path);
    printSurface(surface);
    printProblem(surface);
  });
}

}  // namespace palpate::app
