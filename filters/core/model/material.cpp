// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/material.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace palpate {

Material::Material(double youngsModulus, double poissonRatio)
    : youngsModulus_(youngsModulus), poissonRatio_(poissonRatio) {
  std::ostringstream text;
  if (!(youngsModulus > 0) || !std::isfinite(youngsModulus))
    text << "Young's modulus must be a positive number, not " << youngsModulus;
  else if (!(poissonRatio > -1 && poissonRatio <= 0.5))
    text << "Poisson's ratio must be above -1 and at most 0.5, not " << poissonRatio;
  if (!text.str().empty()) throw std::invalid_argument(text.str());
}

}  // namespace palpate
