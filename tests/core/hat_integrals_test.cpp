// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "halfspace/hat_integrals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Geometry>
#include <functional>
#include <random>

#include "support/shapes.h"

namespace palpate::test {
namespace {

using Real = long double;
using Point = Eigen::Matrix<Real, 2, 1>;
using Sums = Eigen::Matrix<Real, 5, 1>;  // in the order of HatMoments

constexpr Real kPi = 3.14159265358979323846264338327950288L;

/// Gauss-Legendre on [0, 1] of 20 points, by Newton's method on the Legendre polynomial.
struct Gauss {
  Real places[20], weights[20];
  Gauss() {
    for (int i = 0; i < 20; ++i) {
      Real x = std::cos(kPi * (i + 0.75L) / 20.5L), slope = 1;
      for (int step = 0; step < 20; ++step) {
        Real last = 1, value = x;
        for (int k = 2; k <= 20; ++k) {
          const Real next = ((2 * k - 1) * x * value - (k - 1) * last) / k;
          last = value;
          value = next;
        }
        slope = 20 * (x * value - last) / (x * x - 1);
        x -= value / slope;
      }
      places[i] = (1 + x) / 2;
      weights[i] = 1 / ((1 - x * x) * slope * slope);
    }
  }
};
const Gauss& gauss() {
  static const Gauss rule;
  return rule;
}

Sums integral(const std::function<Sums(Real)>& f, Real from, Real to) {
  Sums sum = Sums::Zero();
  for (int i = 0; i < 20; ++i)
    sum += (to - from) * gauss().weights[i] * f(from + (to - from) * gauss().places[i]);
  return sum;
}

/// Halves the interval until that changes nothing that matters: 1e-16 of the first estimate, a
/// share of it to each half.
Sums adaptiveIntegral(const std::function<Sums(Real)>& f, Real from, Real to, Real scale = 0,
                      int depth = 0) {
  const Real middle = (from + to) / 2;
  const Sums whole = integral(f, from, to),
             halves = integral(f, from, middle) + integral(f, middle, to);
  if (depth == 0) scale = halves.norm();
  if ((whole - halves).norm() <= 1e-16L * scale || depth == 10) return halves;
  return adaptiveIntegral(f, from, middle, scale, depth + 1) +
         adaptiveIntegral(f, middle, to, scale, depth + 1);
}

/// The kernels at d = x - y.
Sums kernels(const Point& d) {
  const Real r = d.norm();
  Sums k;
  k << 1 / r, d.x() * d.x() / (r * r * r), d.x() * d.y() / (r * r * r), d.x() / (r * r),
      d.y() / (r * r);
  return k;
}

/// A triangle of a hat: 1 at a, 0 at b and c, counter-clockwise. Round x, in polar coordinates:
/// along a ray the integrals are those of a linear function, over the angle they are adaptive.
Sums nearTriangle(const Point& x, const Point& a, const Point& b, const Point& c) {
  const auto cross = [](const Point& p, const Point& q) { return p.x() * q.y() - p.y() * q.x(); };
  const Point outer = c - b;
  const Real doubleArea = cross(b - a, c - a);
  const Point slope(-outer.y() / doubleArea, outer.x() / doubleArea);
  const Real atX = 1 + slope.dot(x - a);
  const Point corners[] = {a, b, c};
  Sums sum = Sums::Zero();
  for (int k = 0; k < 3; ++k) {
    const Point p = corners[k] - x, q = corners[(k + 1) % 3] - x;
    const Real distance = cross(p, q) / (q - p).norm();
    if (std::abs(distance) < 1e-18L) continue;
    const Real sign = distance > 0 ? 1 : -1, height = sign * distance;
    const Point along = (q - p).normalized(), away = sign * Point(along.y(), -along.x());
    // The angle by s = height sinh t, which holds for points beside an edge: d angle = height / r
    // dt.
    sum += sign * adaptiveIntegral(
                      [&](Real t) -> Sums {
                        const Point way = height * (away + std::sinh(t) * along);
                        return kernels(-way.normalized()) * (atX + slope.dot(way) / 2) * height;
                      },
                      std::asinh(p.dot(along) / height), std::asinh(q.dot(along) / height));
  }
  return sum;
}

/// The same by a product rule, for points far off.
Sums farTriangle(const Point& x, const Point& a, const Point& b, const Point& c) {
  const Real doubleArea = (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  return integral(
      [&](Real u) -> Sums {
        return integral(
            [&](Real v) -> Sums {
              return (1 - u) * u * doubleArea *
                     kernels(x - a - u * ((1 - v) * (b - a) + v * (c - a)));
            },
            0, 1);
      },
      0, 1);
}

struct Flat {
  Eigen::Matrix2Xd points;
  Eigen::Matrix3Xi triangles;
  HatIntegrals hats;
  explicit Flat(const Shape& shape)
      : points(shape.points.topRows<2>()), triangles(shape.triangles), hats(points, triangles) {}

  double radius(int hat) const {
    double largest = 0;
    for (int f = 0; f < triangles.cols(); ++f)
      for (int k = 0; k < 3; ++k)
        if (triangles(k, f) == hat)
          for (int other : triangles.col(f))
            largest = std::max(largest, (points.col(other) - points.col(hat)).norm());
    return largest;
  }

  /// Largest error of the moments, relative to that of 1/r.
  double error(const Eigen::Vector2d& x, int hat) const {
    const bool isFar = (x - points.col(hat)).norm() > 5 * radius(hat);
    Sums exact = Sums::Zero();
    for (int f = 0; f < triangles.cols(); ++f)
      for (int k = 0; k < 3; ++k) {
        if (triangles(k, f) != hat) continue;
        const auto corner = [&](int j) -> Point {
          return points.col(triangles((k + j) % 3, f)).cast<Real>();
        };
        exact +=
            (isFar ? farTriangle : nearTriangle)(x.cast<Real>(), corner(0), corner(1), corner(2));
      }
    const HatMoments m = hats.at(x, hat);
    Sums got;
    got << m.inverse, m.xx, m.xy, m.x, m.y;
    const double largest = static_cast<double>((got - exact).cwiseAbs().maxCoeff() / exact[0]);
    return std::isfinite(largest) ? largest : 1e300;
  }
};

Shape squeezed(const Shape& shape, double factor) {
  return shape.mapped(
      [=](const Eigen::Vector3d& x) { return Eigen::Vector3d(x.x(), factor * x.y(), 0); });
}

/// Of points all round the hat of the middle and that of a corner of the rim.
double largestError(const Flat& flat, int hat, double distance, std::mt19937& random) {
  std::uniform_real_distribution<double> angle(0, 6.283185307179586);
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    const double a = angle(random), r = distance * flat.radius(hat);
    largest = std::max(
        largest,
        flat.error(flat.points.col(hat) + r * Eigen::Vector2d(std::cos(a), std::sin(a)), hat));
  }
  return largest;
}

// What the header promises: 5e-12. Adaptive integration itself is good to 1e-14.
constexpr double kPromised = 5e-12;

TEST(HatIntegrals, AreThoseOfAdaptiveIntegrationAtAnyDistance) {
  std::mt19937 random(1);
  for (const Shape& shape : {disc(1, 1), disc(1, 2), jitteredPlate(1, 4, 0.3), plate(1, 2)}) {
    const Flat flat(shape);
    for (int hat : {0, 2, static_cast<int>(shape.points.cols()) / 2})
      for (double distance :
           {1e-6, 1e-3, 0.1, 0.5, 0.9, 1.1, 2., 4., 8., 13.9, 14.1, 20., 59., 61., 200., 1e3, 1e4})
        EXPECT_LE(largestError(flat, hat, distance, random), distance < 2 ? 1e-13 : kPromised)
            << shape.points.cols() << " vertices, hat " << hat << ", distance " << distance;
  }
}

TEST(HatIntegrals, HoldAtCornersAndOnEdgesAndBesideThem) {
  const Flat flat(jitteredPlate(1, 4, 0.3));
  for (int hat : {0, 3, 12})
    for (int f = 0; f < flat.triangles.cols(); ++f)
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector2d a = flat.points.col(flat.triangles(k, f)),
                              b = flat.points.col(flat.triangles((k + 1) % 3, f));
        const Eigen::Vector2d across = Eigen::Vector2d(b.y() - a.y(), a.x() - b.x());
        EXPECT_LE(flat.error(a, hat), 1e-12);
        for (double along : {1e-9, 0.3, 0.5, 1.2, 2.})
          for (double off : {0., 1e-15, -1e-12, 1e-8, -1e-5, 1e-3})
            EXPECT_LE(flat.error(a + along * (b - a) + off * across, hat), 1e-12)
                << "hat " << hat << ", along " << along << ", off " << off;
      }
}

TEST(HatIntegrals, HoldForNeedles) {
  std::mt19937 random(2);
  for (double height : {0.1, 1e-2, 1e-4, 1e-6}) {
    const Flat flat(squeezed(jitteredPlate(1, 4, 0.3), height));
    for (int hat : {0, 3, 12}) {
      for (double distance : {1e-3, 0.1, 0.5, 1., 2., 5., 13., 15., 100.})
        EXPECT_LE(largestError(flat, hat, distance, random),
                  1e-10 + 2e-12 / height * distance * distance)
            << "height " << height << ", hat " << hat << ", distance " << distance;
      for (int v = 0; v < flat.points.cols(); ++v)
        EXPECT_LE(flat.error(flat.points.col(v), hat), 1e-9) << "height " << height << ", at " << v;
    }
  }
}

TEST(HatIntegrals, AddUpToThePotentialOfAUniformlyLoadedSquare) {
  // All hats together are 1: over a square of side 1 the integral of 1/r at its centre is
  // 4 ln(1 + sqrt 2), at a corner half as much; dx^2 / r^3 is half of that by symmetry.
  const Flat flat(jitteredPlate(1, 10, 0.3));
  double centre = 0, corner = 0, half = 0, aside = 0;
  for (int hat = 0; hat < flat.hats.vertexCount(); ++hat) {
    const HatMoments m = flat.hats.at(Eigen::Vector2d(0, 0), hat);
    centre += m.inverse;
    half += m.xx;
    aside += m.x;
    corner += flat.hats.at(Eigen::Vector2d(-0.5, -0.5), hat).inverse;
  }
  const double exact = 4 * std::log(1 + std::sqrt(2.));
  EXPECT_NEAR(centre / exact, 1, 1e-13);
  EXPECT_NEAR(corner / (exact / 2), 1, 1e-13);
  EXPECT_NEAR(half / (exact / 2), 1, 1e-13);
  EXPECT_NEAR(aside, 0, 1e-13);
}

}  // namespace
}  // namespace palpate::test
