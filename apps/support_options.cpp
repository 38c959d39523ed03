// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support_options.h"

#include <vtkReferenceBoundaryConditions.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>

namespace palpate::app {
namespace {

constexpr const char* kGroup = "Support and material (by default the file's)";

}  // namespace

void SupportOptions::addTo(CLI::App& command) {
  const CLI::Validator isNumber(
      [](const std::string& text) {
        return std::isnan(std::strtod(text.c_str(), nullptr)) ? "not a number: " + text : "";
      },
      "");
  command.add_option("--young", young, "Young's modulus, Pa")->check(isNumber)->group(kGroup);
  command.add_option("--poisson", poisson, "Poisson's ratio, above -1 up to 0.5")
      ->check(isNumber)
      ->group(kGroup);
  addPlacesTo(command, kGroup);
}

void SupportOptions::addPlacesTo(CLI::App& command, const std::string& group) {
  command.add_option("--fix-array", fixedArray, "Fix vertices where this point array is not zero")
      ->group(group);
  command.add_option("--fix-half-space", halfSpace, "Fix vertices behind a plane: point, normal")
      ->expected(6)
      ->group(group);
  command.add_option("--fix-box", box, "Fix vertices in a box: xmin xmax ymin ymax zmin zmax")
      ->expected(6)
      ->group(group);
  command.add_option("--fix-sphere", sphere, "Fix vertices in a ball: centre, radius")
      ->expected(4)
      ->group(group);
}

void SupportOptions::applyTo(vtkReferenceBoundaryConditions* filter) const {
  filter->SetYoungsModulus(young);
  filter->SetPoissonRatio(poisson);
  filter->SetFixedArrayName(fixedArray.c_str());
  if (!halfSpace.empty()) filter->AddFixedHalfSpace(halfSpace.data(), halfSpace.data() + 3);
  if (!box.empty()) filter->AddFixedBox(box.data());
  if (!sphere.empty()) filter->AddFixedSphere(sphere.data(), sphere[3]);
}

bool SupportOptions::fixes() const {
  return !fixedArray.empty() || !halfSpace.empty() || !box.empty() || !sphere.empty();
}

}  // namespace palpate::app
