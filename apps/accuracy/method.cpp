// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "accuracy/settings.h"

namespace palpate::app {

Method methodNamed(const std::string& name) {
  return name == "fem"         ? Method::QuadraticTetrahedra
         : name == "shell"     ? Method::ThinShell
         : name == "halfspace" ? Method::HalfSpace
                               : Method::BoundaryElements;
}

std::string nameOf(Method method) {
  switch (method) {
    case Method::BoundaryElements:
      return "boundary elements";
    case Method::QuadraticTetrahedra:
      return "quadratic tetrahedra";
    case Method::LinearTetrahedra:
      return "linear tetrahedra";
    case Method::ThinShell:
      return "thin shell triangles";
    case Method::HalfSpace:
      return "a half-space's integrals";
  }
  return {};
}

}  // namespace palpate::app
