// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "halfspace/point_loads.h"

#include <cmath>
#include <complex>

#include "halfspace/hat_integrals_kernel.h"

namespace palpate {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Gauss-Legendre on [0, 1], exact to degree 11 (Abramowitz & Stegun, table 25.4).
struct GaussPoint {
  double place, weight;
};
constexpr GaussPoint kGauss[] = {{0.5 - 0.9324695142031521 / 2, 0.1713244923791704 / 2},
                                 {0.5 - 0.6612093864662645 / 2, 0.3607615730481386 / 2},
                                 {0.5 - 0.2386191860831969 / 2, 0.4679139345726910 / 2},
                                 {0.5 + 0.2386191860831969 / 2, 0.4679139345726910 / 2},
                                 {0.5 + 0.6612093864662645 / 2, 0.3607615730481386 / 2},
                                 {0.5 + 0.9324695142031521 / 2, 0.1713244923791704 / 2}};

int monomialCount(int degree) {
  return (degree + 1) * (degree + 2) / 2;
}

/// Adds weight times all |z|^2k Re z^m and |z|^2k Im z^m, 2 k + m <= degree.
void addMonomials(const Eigen::Vector2d& place, int degree, double weight, double* sums) {
  const std::complex<double> z(place.x(), place.y());
  std::complex<double> power = weight;
  for (int m = 0; m <= degree; ++m, power *= z) {
    double size = 1;
    for (int k = 0; 2 * k + m <= degree; ++k, size *= std::norm(z)) {
      *sums++ += size * power.real();
      if (m > 0) *sums++ += size * power.imag();
    }
  }
}

}  // namespace

PointLoads::PointLoads(int degree, const std::vector<double>& radii) : degree_(degree) {
  std::vector<Eigen::Vector2d> places;
  int count = 2 * degree + 1;
  for (double radius : radii) {
    // Turned against each other, so that no direction is preferred.
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * kPi * i / count + radius;
      places.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    count -= 4;
  }
  Eigen::MatrixXd monomials = Eigen::MatrixXd::Zero(monomialCount(degree), places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    addMonomials(places[i], degree, 1, monomials.col(i).data());
  momentsOfLoads_.compute(monomials);
  const std::size_t groups = (places.size() + kHatGroup - 1) / kHatGroup;
  places_.assign(2 * kHatGroup * groups, 0);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (int axis = 0; axis < 2; ++axis)
      places_[(2 * (i / kHatGroup) + axis) * kHatGroup + i % kHatGroup] = places[i][axis];
}

Eigen::VectorXd PointLoads::loadsOf(const std::vector<HatSector>& sectors) const {
  Eigen::VectorXd moments = Eigen::VectorXd::Zero(monomialCount(degree_));
  for (const HatSector& sector : sectors) {
    const double doubleArea = sector.doubleArea();
    for (const GaussPoint& outwards : kGauss)
      for (const GaussPoint& across : kGauss) {
        const double u = outwards.place;  // the hat is 1 - u, the area element u doubleArea du dv
        addMonomials(u * (sector.a + across.place * (sector.b - sector.a)), degree_,
                     outwards.weight * across.weight * (1 - u) * u * doubleArea, moments.data());
      }
  }
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(size());
  loads.head(moments.size()) = momentsOfLoads_.solve(moments);
  return loads;
}

}  // namespace palpate
