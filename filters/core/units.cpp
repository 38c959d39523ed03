// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "units.h"

#include <initializer_list>

#include "sentence.h"

namespace palpate {
namespace {

struct Unit {
  const char* name;
  double value;
};

double unitNamed(const std::string& name, const char* what, std::initializer_list<Unit> units) {
  std::string known;
  for (const Unit& unit : units) {
    if (name == unit.name) return unit.value;
    known += (known.empty() ? "" : ", ") + std::string(unit.name);
  }
  refuse("there is no unit of ", what, " '", name, "': choose one of ", known);
}

}  // namespace

double lengthUnitNamed(const std::string& name) {
  return unitNamed(
      name, "length",
      {{"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"in", 0.0254}, {"ft", 0.3048}});
}

double forceUnitNamed(const std::string& name) {
  return unitNamed(name, "force",
                   {{"N", 1},
                    {"mN", 1e-3},
                    {"kN", 1e3},
                    {"MN", 1e6},
                    {"lbf", 4.4482216152605},
                    {"kgf", 9.80665}});
}

}  // namespace palpate
