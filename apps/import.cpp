// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <read_files.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkImportedGreensFunctions.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkReferenceBoundaryConditions.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>

#include "commands.h"
#include "support_options.h"
#include "terminal.h"

namespace palpate::app {
namespace {

struct Options {
  std::string input, output, compliance, stiffness, nodes, mapping, matrix;
  std::string order = "by-node", lengthUnit = "m", forceUnit = "N";
  SupportOptions support;
  double nodeTolerance = 1e-5, young = 0;
  bool raw = false, unsupported = false;
  std::vector<vtkIdType> columns;
};

void addMatrixOptions(CLI::App& command, Options& o) {
  const char* const group = "Matrix (one of the two)";
  CLI::Option* compliance = command.add_option(
      "--compliance", o.compliance,
      "Displacements per force: .npy, text, Matrix Market, Harwell-Boeing, DMIG");
  compliance->group(group);
  command
      .add_option("--stiffness", o.stiffness,
                  "Forces per displacement, of a held body or a loose one: the same formats")
      ->excludes(compliance)
      ->group(group);
  command.add_option("--nodes", o.nodes,
                     "Places of the matrix' nodes: x y z or number x y z a line, .npy, GRID cards; "
                     "else the file's, else the vertices in their order");
  command.add_option("--mapping", o.mapping,
                     "What the rows are, as Ansys' HBMAT writes it: equation, node, UX");
  command.add_option("--matrix", o.matrix, "Which of several DMIG matrices");
  command
      .add_option(
          "--order", o.order,
          "Rows of x, y, z of each node, or of all x, all y, all z, where the file does not "
          "say")
      ->check(CLI::IsMember({"by-node", "by-component"}))
      ->capture_default_str();
  command
      .add_option("--length-unit", o.lengthUnit,
                  "Of matrix and nodes, the surface's being m: m, cm, mm, um, in or ft")
      ->capture_default_str();
  command.add_option("--force-unit", o.forceUnit, "Of the matrix: N, mN, kN, MN, lbf or kgf")
      ->capture_default_str();
  command
      .add_option("--node-tolerance", o.nodeTolerance,
                  "How near a node is to its vertex, over the surface's diagonal")
      ->capture_default_str();
}

void addOptions(CLI::App& command, Options& o) {
  command.add_option("input", o.input, "A triangle surface of the matrix' nodes, closed or not")
      ->required();
  requireWritable(
      command
          .add_option("output", o.output, "The model: the surface with its Green's functions, .vtp")
          ->required(),
      "models", ".vtp");
  addMatrixOptions(command, o);
  o.support.addPlacesTo(command);
  command.add_option(
      "--young", o.young,
      "Young's modulus that the matrix holds for, Pa, to scale it by; by default that "
      "of a body of this size and compliance");
  command.add_option("--columns", o.columns, "Keep only these vertices' Green's functions");
  command.add_flag("--raw", o.raw, "Do not symmetrise a compliance");
  command.add_flag("--unsupported", o.unsupported,
                   "A loose body's stiffness is of a body that nothing holds");
  command.footer(
      "Vertices that are fixed but that the matrix does not have are held where it is from: they "
      "do\n"
      "not move, and no force can act on them. Others that are fixed are held by their reactions.\n"
      "  palpate import part.vtp part_model.vtp --stiffness part.pch --length-unit mm \\\n"
      "      --fix-half-space 0 0 0.001  0 0 1");
}

vtkSmartPointer<vtkPolyData> posed(const Options& o) {
  vtkNew<vtkReferenceBoundaryConditions> conditions;
  conditions->SetInputData(readSurface(o.input));
  o.support.applyTo(conditions);
  conditions->SetYoungsModulus(1);  // the matrix' own takes its place
  conditions->SetPoissonRatio(0);
  return run(conditions);
}

void set(vtkImportedGreensFunctions* filter, const Options& o) {
  filter->SetKind(!o.stiffness.empty());
  filter->SetMatrixFileName((o.stiffness.empty() ? o.compliance : o.stiffness).c_str());
  filter->SetNodeFileName(o.nodes.c_str());
  filter->SetMappingFileName(o.mapping.c_str());
  filter->SetMatrixName(o.matrix.c_str());
  filter->SetDofOrder(o.order == "by-component");
  filter->SetLengthUnit(o.lengthUnit.c_str());
  filter->SetForceUnit(o.forceUnit.c_str());
  filter->SetNodeTolerance(o.nodeTolerance);
  filter->SetYoungsModulus(o.young);
  filter->SetReciprocal(!o.raw);
  filter->SetUnsupported(o.unsupported);
  if (o.columns.empty()) return;
  vtkNew<vtkIdTypeArray> nodes;
  for (vtkIdType node : o.columns) nodes->InsertNextValue(node);
  filter->SetColumnNodes(nodes);
}

void printModel(vtkPolyData* model) {
  for (const std::string& source : fieldStrings(model, "GreensFunctionSource"))
    printRow("made by", source);
  printRow("vertices", std::to_string(model->GetNumberOfPoints()));
  vtkDataArray* nodes = model->GetFieldData()->GetArray("GreensFunctionNodes");
  printRow("Green's functions", std::to_string(nodes->GetNumberOfTuples()));
  printRow("Young's modulus for it, Pa", number(fieldNumber(model, "YoungsModulus", -1), 3));
  printRow("reciprocity defect", number(fieldNumber(model, "ReciprocityDefect", -1), 3));
}

}  // namespace

void addImport(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "import", "Make Green's functions of a compliance or stiffness matrix made elsewhere");
  addOptions(*command, *options);
  command->callback([options] {
    if (options->compliance.empty() && options->stiffness.empty())
      throw std::invalid_argument(
          "there is no matrix to import: give a file with --compliance or --stiffness");
    vtkNew<vtkImportedGreensFunctions> filter;
    set(filter, *options);
    filter->SetInputData(posed(*options));
    const auto model = run(filter);
    writeSurface(model, options->output);
    printModel(model);
    printWarnings(model);
  });
}

}  // namespace palpate::app
