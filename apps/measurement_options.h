// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <read_files.h>
#include <vtkPolyData.h>

#include <string>

#include "file_kinds.h"

namespace CLI {
class App;
}

namespace palpate::app {

/// Options of a subcommand for a table of displacements: how it is read.
struct TableOptions {
  std::string lengthUnit = "m";
  double placeTolerance = 0.02;
  void addTo(CLI::App& command);
};

/// The same with the table itself, of displacements under known forces.
struct MeasurementOptions {
  std::string table, forceUnit = "N";
  TableOptions reading;
  void addTo(CLI::App& command);

  /// @param port  of the filter's input that takes a table.
  template <class Filter>
  void applyTo(Filter* filter, int port) const {
    if (isTableInArrays(table))
      filter->SetInputData(port, readTable(table));
    else
      filter->SetMeasurementFileName(table.c_str());
    filter->SetLengthUnit(reading.lengthUnit.c_str());
    filter->SetForceUnit(forceUnit.c_str());
    filter->SetPlaceTolerance(reading.placeTolerance);
  }

  /// Which displacements of its table a model that was found from it left out, by their lines.
  std::string outliersOf(vtkPolyData* model) const;
};

}  // namespace palpate::app
