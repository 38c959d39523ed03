// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/material.h"

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>

namespace palpate {
namespace {

/// As few digits as tell the number apart from all others: one just beyond 0.5 does not read "0.5".
std::string withAllDigits(double x) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, x).ptr);
}

}  // namespace

Material::Material(double youngsModulus, double poissonRatio)
    : youngsModulus_(youngsModulus), poissonRatio_(poissonRatio) {
  if (!(youngsModulus > 0) || !std::isfinite(youngsModulus))
    throw std::invalid_argument("Young's modulus must be a positive number, not " +
                                withAllDigits(youngsModulus));
  // Far beyond any unit; stiffness and compliance stay finite.
  if (youngsModulus < 1e-60 || youngsModulus > 1e60)
    throw std::invalid_argument("Young's modulus must be between 1e-60 and 1e60, not " +
                                withAllDigits(youngsModulus));
  if (!(poissonRatio > -1 && poissonRatio <= 0.5))
    throw std::invalid_argument("Poisson's ratio must be above -1 and at most 0.5, not " +
                                withAllDigits(poissonRatio));
}

}  // namespace palpate
