// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "measurement_options.h"

#include <CLI/CLI.hpp>
#include <filesystem>

#include "finite_check.h"

namespace palpate::app {

bool isPolydata(const std::string& table) {
  return std::filesystem::path(table).extension() == ".vtp";
}

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
      .add_option("--measurements", table,
                  "Displacements under known forces: a table (.csv), or a .vtp that carries it")
      ->required();
  reading.addTo(command);
  command.add_option("--force-unit", forceUnit, "Of the table's forces: N, mN, kN, MN, lbf or kgf")
      ->capture_default_str();
}

}  // namespace palpate::app
