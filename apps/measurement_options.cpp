// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "measurement_options.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>

#include <CLI/CLI.hpp>

#include "finite_check.h"
#include "terminal.h"

namespace palpate::app {

void TableOptions::addTo(CLI::App& command) {
  command
      .add_option("--length-unit", lengthUnit,
                  "Of the table, the surface's being m: m, cm, mm, um, in or ft")
      ->capture_default_str();
  command
      .add_option("--place-tolerance", placeTolerance,
                  "How far a place may be from the surface, over its diagonal")
      ->check(isFinite())
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
}

void MeasurementOptions::addTo(CLI::App& command) {
  command
      .add_option(
          "--measurements", table,
          "Displacements under known forces: a table (.csv), or a .vtp or .vtu that carries it")
      ->required();
  reading.addTo(command);
  command.add_option("--force-unit", forceUnit, "Of the table's forces: N, mN, kN, MN, lbf or kgf")
      ->capture_default_str();
}

std::string MeasurementOptions::outliersOf(vtkPolyData* model) const {
  constexpr int most = 12;
  vtkDataArray* outliers = model->GetFieldData()->GetArray("MeasurementOutlier");
  vtkDataArray* rows = model->GetFieldData()->GetArray("MeasurementRow");
  std::string text;
  int count = 0;
  for (vtkIdType i = 0; i < outliers->GetNumberOfTuples(); ++i)
    if (outliers->GetComponent(i, 0) != 0 && ++count <= most)
      text += (count > 1 ? ", " : "") + number(rows->GetComponent(i, 0), 9);
  if (count == 0) return "none";
  if (count > most) text += " and " + std::to_string(count - most) + " more";
  return std::to_string(count) + " of " + std::to_string(outliers->GetNumberOfTuples()) + ": " +
         (isTableInArrays(table) ? "tuples " : "lines ") + text;
}

}  // namespace palpate::app
