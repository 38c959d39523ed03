// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <limits>
#include <string>
#include <vector>

namespace CLI {
class App;
}
class vtkReferenceBoundaryConditions;

namespace palpate::app {

/// Options of a subcommand for support and material, and their way into the filter.
struct SupportOptions {
  double young = std::numeric_limits<double>::quiet_NaN(), poisson = young;
  std::string fixedArray;
  std::vector<double> halfSpace, box, sphere;
  void addTo(CLI::App& command);
  /// Those of the support alone.
  void addPlacesTo(CLI::App& command, const std::string& group = "Support (by default the file's)");
  void applyTo(vtkReferenceBoundaryConditions* filter) const;
  /// Whether any option fixes anything.
  bool fixes() const;
};

}  // namespace palpate::app
