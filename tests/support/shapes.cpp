// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/shapes.h"

#include <cmath>
#include <Eigen/Geometry>
#include <map>
#include <random>

#include "mesh/mesh_defects.h"

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

}  // namespace

Shape fromLists(const std::vector<Eigen::Vector3d>& points,
                const std::vector<Eigen::Vector3i>& triangles) {
  Shape shape{Eigen::Matrix3Xd(3, points.size()), Eigen::Matrix3Xi(3, triangles.size())};
  for (std::size_t v = 0; v < points.size(); ++v) shape.points.col(v) = points[v];
  for (std::size_t f = 0; f < triangles.size(); ++f) shape.triangles.col(f) = triangles[f];
  return shape;
}

Shape Shape::flipped() const {
  Shape out = *this;
  out.triangles.row(1).swap(out.triangles.row(2));
  return out;
}

Shape Shape::with(const Shape& other) const {
  Shape out{Eigen::Matrix3Xd(3, points.cols() + other.points.cols()),
            Eigen::Matrix3Xi(3, triangles.cols() + other.triangles.cols())};
  out.points << points, other.points;
  out.triangles << triangles, (other.triangles.array() + int(points.cols())).matrix();
  return out;
}

Shape Shape::welded(double tolerance) const {
  const std::vector<int> twin = nearestDuplicates(points, tolerance);
  std::vector<int> number(points.cols(), -1);
  std::vector<Eigen::Vector3d> kept;
  for (int v = 0; v < points.cols(); ++v) {
    if (twin[v] != v) continue;
    number[v] = static_cast<int>(kept.size());
    kept.push_back(points.col(v));
  }
  std::vector<Eigen::Vector3i> faces;
  for (int f = 0; f < triangles.cols(); ++f)
    faces.emplace_back(number[twin[triangles(0, f)]], number[twin[triangles(1, f)]],
                       number[twin[triangles(2, f)]]);
  return fromLists(kept, faces);
}

Shape Shape::mapped(const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map) const {
  Shape out = *this;
  for (int v = 0; v < points.cols(); ++v) out.points.col(v) = map(points.col(v));
  return out;
}

Shape icosphere(int levels) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const double corners[12][3] = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                 {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                 {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  const int faces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                            {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                            {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                            {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  const auto corner = [&](int i) {
    return Eigen::Vector3d(corners[i][0], corners[i][1], corners[i][2]).normalized();
  };
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(corner(0), Eigen::Vector3d::UnitZ());
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 12; ++i) points.push_back(turn * corner(i));
  points[0] = Eigen::Vector3d::UnitZ();
  std::vector<Eigen::Vector3i> triangles;
  for (const auto& face : faces) triangles.emplace_back(face[0], face[1], face[2]);

  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [entry, isNew] = middles.insert({std::minmax(a, b), int(points.size())});
      if (isNew) points.push_back((points[a] + points[b]).normalized());
      return entry->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const Eigen::Vector3i& t : triangles) {
      const int ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], ab, ca}, {t[1], bc, ab}, {t[2], ca, bc}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  return fromLists(points, triangles);
}

Shape jitteredSphere(int levels, double amount, unsigned seed) {
  Shape shape = icosphere(levels);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double edge = 1.1 / (1 << levels);
  for (int v = 0; v < shape.points.cols(); ++v) {
    const Eigen::Vector3d shift(uniform(random), uniform(random), uniform(random));
    shape.points.col(v) = (shape.points.col(v) + amount * edge * shift).normalized();
  }
  return shape;
}

Shape box(const Eigen::Vector3d& size, const Eigen::Vector3i& divisions) {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3i> triangles;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const int u = (axis + 1) % 3, w = (axis + 2) % 3;
      const int base = static_cast<int>(points.size());
      for (int i = 0; i <= divisions[u]; ++i)
        for (int j = 0; j <= divisions[w]; ++j) {
          Eigen::Vector3d x;
          x[axis] = side * size[axis];
          x[u] = size[u] * i / divisions[u];
          x[w] = size[w] * j / divisions[w];
          points.push_back(x);
        }
      const auto at = [&](int i, int j) { return base + i * (divisions[w] + 1) + j; };
      for (int i = 0; i < divisions[u]; ++i)
        for (int j = 0; j < divisions[w]; ++j) {
          int a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
          if (side == 0) std::swap(b, d);
          if ((i + j) % 2) {
            triangles.emplace_back(a, b, c);
            triangles.emplace_back(a, c, d);
          } else {
            triangles.emplace_back(a, b, d);
            triangles.emplace_back(b, c, d);
          }
        }
    }
  return fromLists(points, triangles).welded(1e-9 * size.norm());
}

Shape disc(double radius, int rings) {
  std::vector<Eigen::Vector3d> points{{0, 0, 0}};
  std::vector<Eigen::Vector3i> triangles;
  for (int k = 1; k <= rings; ++k)
    for (int i = 0; i < 6 * k; ++i) {
      const double angle = 2 * kPi * i / (6 * k), r = radius * k / rings;
      points.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
    }
  const auto number = [](int k, int i) { return k == 0 ? 0 : 1 + 3 * k * (k - 1) + i % (6 * k); };
  for (int k = 1; k <= rings; ++k)
    for (int sector = 0; sector < 6; ++sector)
      for (int i = 0; i < k; ++i) {
        const int outer = sector * k + i, inner = sector * (k - 1) + i;
        triangles.emplace_back(number(k, outer), number(k, outer + 1), number(k - 1, inner));
        if (i < k - 1)
          triangles.emplace_back(number(k - 1, inner), number(k, outer + 1),
                                 number(k - 1, inner + 1));
      }
  return fromLists(points, triangles);
}

Shape plate(double side, int divisions) {
  return jitteredPlate(side, divisions, 0);
}

std::vector<Eigen::Vector3i> alternatingSquares(int alongX, int alongY) {
  std::vector<Eigen::Vector3i> triangles;
  for (int j = 0; j < alongY; ++j)
    for (int i = 0; i < alongX; ++i) {
      const int a = j * (alongX + 1) + i, b = a + 1, c = a + alongX + 1, d = c + 1;
      if ((i + j) % 2 == 0) {
        triangles.emplace_back(a, b, d);
        triangles.emplace_back(a, d, c);
      } else {
        triangles.emplace_back(a, b, c);
        triangles.emplace_back(b, d, c);
      }
    }
  return triangles;
}

Shape jitteredPlate(double side, int divisions, double amount, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> move(-amount, amount);
  std::vector<Eigen::Vector3d> points;
  for (int j = 0; j <= divisions; ++j)
    for (int i = 0; i <= divisions; ++i) {
      const bool isInner = i > 0 && j > 0 && i < divisions && j < divisions;
      const double x = isInner ? move(random) : 0, y = isInner ? move(random) : 0;
      points.emplace_back(side * ((i + x) / divisions - 0.5), side * ((j + y) / divisions - 0.5),
                          0);
    }
  return fromLists(points, alternatingSquares(divisions, divisions));
}

Shape boxWithNeedles(double width) {
  return box({1, 1, 1}, {4, 4, 4}).mapped([&](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x.x() == 0.5 ? 0.25 + width : x.x(), x.y(), x.z());
  });
}

Shape torus(double majorRadius, double minorRadius, int aroundMajor, int aroundMinor) {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3i> triangles;
  for (int i = 0; i < aroundMajor; ++i)
    for (int j = 0; j < aroundMinor; ++j) {
      const double a = 2 * kPi * i / aroundMajor, b = 2 * kPi * j / aroundMinor;
      const double r = majorRadius + minorRadius * std::cos(b);
      points.emplace_back(r * std::cos(a), r * std::sin(a), minorRadius * std::sin(b));
    }
  const auto at = [&](int i, int j) { return (i % aroundMajor) * aroundMinor + j % aroundMinor; };
  for (int i = 0; i < aroundMajor; ++i)
    for (int j = 0; j < aroundMinor; ++j) {
      triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return fromLists(points, triangles);
}

Shape ringedSphere(const std::function<double(double)>& edgeLength,
                   const std::vector<double>& lines) {
  std::vector<double> stops = lines;
  stops.insert(stops.begin(), 0);
  stops.push_back(kPi);
  std::vector<double> angles;  // of the rings between the poles
  for (std::size_t s = 0; s + 1 < stops.size(); ++s) {
    // Steps in proportion to the wanted length, stretched to end on the next stop.
    std::vector<double> steps{0};
    while (stops[s] + steps.back() < stops[s + 1])
      steps.push_back(steps.back() + edgeLength(stops[s] + steps.back()) * std::sqrt(3.0) / 2);
    const double stretch = (stops[s + 1] - stops[s]) / steps.back();
    for (std::size_t k = 1; k < steps.size(); ++k) angles.push_back(stops[s] + stretch * steps[k]);
  }
  angles.pop_back();

  std::vector<Eigen::Vector3d> points{Eigen::Vector3d::UnitZ()};
  std::vector<std::vector<int>> rings{{0}};
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const double radius = std::sin(angles[k]);
    const int count =
        std::max(5, static_cast<int>(std::lround(2 * kPi * radius / edgeLength(angles[k]))));
    rings.emplace_back();
    for (int i = 0; i < count; ++i) {
      const double turn = 2 * kPi * (i + (k % 2) * 0.5) / count;
      rings.back().push_back(static_cast<int>(points.size()));
      points.emplace_back(radius * std::cos(turn), radius * std::sin(turn), std::cos(angles[k]));
    }
  }
  rings.push_back({static_cast<int>(points.size())});
  points.push_back(-Eigen::Vector3d::UnitZ());

  std::vector<Eigen::Vector3i> triangles;
  for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
    const std::vector<int>&a = rings[k], &b = rings[k + 1];
    const auto turnOf = [&](const std::vector<int>& ring, int i, std::size_t which) {
      return ring.size() == 1 ? 1e9 * (i > 0)
                              : 2 * kPi * (i + ((which - 1) % 2) * 0.5) / double(ring.size());
    };
    // Zip the two rings together, always stepping on the one that is behind.
    std::size_t i = 0, j = 0;
    const std::size_t stepsA = a.size() == 1 ? 0 : a.size(), stepsB = b.size() == 1 ? 0 : b.size();
    while (i < stepsA || j < stepsB) {
      const bool stepA =
          j == stepsB ||
          (i < stepsA && turnOf(a, int(i) + 1, k) + turnOf(a, int(i), k) <
                             turnOf(b, int(j) + 1, k + 1) + turnOf(b, int(j), k + 1));
      if (stepA) {
        triangles.emplace_back(a[i], b[j % b.size()], a[(i + 1) % a.size()]);
        ++i;
      } else {
        triangles.emplace_back(a[i % a.size()], b[j], b[(j + 1) % b.size()]);
        ++j;
      }
    }
  }
  return fromLists(points, triangles);
}

std::vector<unsigned char> fixedWhere(
    const Shape& shape, const std::function<bool(const Eigen::Vector3d&)>& predicate) {
  std::vector<unsigned char> types;
  for (int v = 0; v < shape.points.cols(); ++v) types.push_back(predicate(shape.points.col(v)));
  return types;
}

}  // namespace palpate::test
