// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/soups.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <numeric>
#include <random>
#include <set>

namespace palpate::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

Shape makeShape(int vertexCount, int triangleCount) {
  return {Eigen::Matrix3Xd(3, vertexCount), Eigen::Matrix3Xi(3, triangleCount)};
}

}  // namespace

Shape tetrahedron() {
  Shape shape = makeShape(4, 4);
  shape.points << 0, 1, 0, 0,  //
      0, 0, 1, 0,              //
      0, 0, 0, 1;
  shape.triangles << 0, 0, 0, 1,  //
      2, 1, 3, 2,                 //
      1, 3, 2, 3;
  return shape;
}

Shape bipyramid(int valence) {
  Shape shape = makeShape(2 + valence, 2 * valence);
  shape.points.col(0) << 0, 0, 1;
  shape.points.col(1) << 0, 0, -1;
  for (int i = 0; i < valence; ++i) {
    const double turn = 2 * kPi * i / valence;
    shape.points.col(2 + i) << std::cos(turn), std::sin(turn), 0;
    const int a = 2 + i, b = 2 + (i + 1) % valence;
    shape.triangles.col(2 * i) << 0, a, b;
    shape.triangles.col(2 * i + 1) << 1, b, a;
  }
  return shape;
}

Shape hollowSphere(int levels, double cavityRadius) {
  return icosphere(levels).with(icosphere(levels).scaled(cavityRadius).flipped());
}

Shape twoConesAtAPoint() {
  const Shape up = tetrahedron();
  Shape both =
      up.with(up.mapped([](const Eigen::Vector3d& x) { return Eigen::Vector3d(-x); }).flipped());
  // The second one's tip, vertex 4, becomes the first one's, and numbers above move down.
  for (int& v : both.triangles.reshaped()) v = v == 4 ? 0 : v > 4 ? v - 1 : v;
  Shape out = makeShape(7, 8);
  out.points << both.points.leftCols(4), both.points.rightCols(3);
  out.triangles = both.triangles;
  return out;
}

Shape twoCubesAtAnEdge() {
  const Shape cube = box({1, 1, 1}, {1, 1, 1});
  return cube.with(cube.moved({1, 1, 0})).welded();
}

Shape cubeWithSpikeThroughItsBase() {
  return box({1, 1, 1}, {2, 2, 2}).mapped([](const Eigen::Vector3d& x) {
    const bool topCentre = (x - Eigen::Vector3d(0.5, 0.5, 1)).norm() < 1e-9;
    return topCentre ? Eigen::Vector3d(0.6, 0.55, -0.5) : x;
  });
}

Shape moebiusStrip(int count) {
  Shape shape = makeShape(2 * count, 2 * count);
  for (int i = 0; i < count; ++i) {
    const double turn = 2 * kPi * i / count;
    for (int side = 0; side < 2; ++side) {
      const double across = 0.4 * (2 * side - 1), radius = 2 + across * std::cos(turn / 2);
      shape.points.col(2 * i + side) << radius * std::cos(turn), radius * std::sin(turn),
          across * std::sin(turn / 2);
    }
    // After the last step the strip has turned over: its two sides change places.
    const bool last = i + 1 == count;
    const int a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    shape.triangles.col(2 * i) << a, c, b;
    shape.triangles.col(2 * i + 1) << b, c, d;
  }
  return shape;
}

Shape kleinBottle(int around, int along) {
  Shape shape = makeShape(around * along, 2 * around * along);
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < around; ++j) {
      const double u = 2 * kPi * i / along, w = 2 * kPi * (j + 0.5) / around;
      // The figure-eight immersion.
      const double radius = 3 + std::cos(u / 2) * std::sin(w) - std::sin(u / 2) * std::sin(2 * w);
      shape.points.col(i * around + j) << radius * std::cos(u), radius * std::sin(u),
          std::sin(u / 2) * std::sin(w) + std::cos(u / 2) * std::sin(2 * w);
    }
  // One turn along maps w to -w.
  const auto at = [&](int i, int j) {
    j = (j + around) % around;
    return i < along ? i * around + j : around - 1 - j;
  };
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < around; ++j) {
      const int f = 2 * (i * around + j);
      shape.triangles.col(f) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
      shape.triangles.col(f + 1) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
    }
  return shape;
}

Shape withVertex(const Shape& shape, const Eigen::Vector3d& x) {
  Shape out = shape;
  out.points.conservativeResize(3, shape.points.cols() + 1);
  out.points.rightCols(1) = x;
  return out;
}

Shape withTriangle(const Shape& shape, const Eigen::Vector3i& triangle) {
  Shape out = shape;
  out.triangles.conservativeResize(3, shape.triangles.cols() + 1);
  out.triangles.rightCols(1) = triangle;
  return out;
}

Shape withoutTriangle(const Shape& shape, int triangle) {
  const int rest = static_cast<int>(shape.triangles.cols()) - triangle - 1;
  Shape out = shape;
  out.triangles.resize(3, shape.triangles.cols() - 1);
  out.triangles << shape.triangles.leftCols(triangle), shape.triangles.rightCols(rest);
  return out;
}

Shape withTriangleFlipped(const Shape& shape, int triangle) {
  Shape out = shape;
  std::swap(out.triangles(1, triangle), out.triangles(2, triangle));
  return out;
}

Shape tornApart(const Shape& shape) {
  const int count = static_cast<int>(shape.triangles.cols());
  Shape out = makeShape(3 * count, count);
  for (int f = 0; f < count; ++f)
    for (int k = 0; k < 3; ++k) {
      out.points.col(3 * f + k) = shape.points.col(shape.triangles(k, f));
      out.triangles(k, f) = 3 * f + k;
    }
  return out;
}

Shape renumbered(const Shape& shape, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<int> vertex(shape.points.cols()), triangle(shape.triangles.cols());
  std::iota(vertex.begin(), vertex.end(), 0);
  std::iota(triangle.begin(), triangle.end(), 0);
  std::shuffle(vertex.begin(), vertex.end(), random);
  std::shuffle(triangle.begin(), triangle.end(), random);
  Shape out = shape;
  for (int v = 0; v < shape.points.cols(); ++v) out.points.col(vertex[v]) = shape.points.col(v);
  for (int f = 0; f < shape.triangles.cols(); ++f)
    for (int k = 0; k < 3; ++k)
      out.triangles((k + f) % 3, triangle[f]) = vertex[shape.triangles(k, f)];
  return out;
}

double signedVolume(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles) {
  const Eigen::Vector3d origin = points.rowwise().mean();
  double volume = 0;
  for (const auto& t : triangles.colwise()) {
    const Eigen::Vector3d a = points.col(t[0]) - origin, b = points.col(t[1]) - origin,
                          c = points.col(t[2]) - origin;
    volume += a.dot(b.cross(c)) / 6;
  }
  return volume;
}

int eulerCharacteristic(const Eigen::Matrix3Xi& triangles) {
  std::set<std::pair<int, int>> edges;
  for (const auto& t : triangles.colwise())
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
  const std::set<int> vertices(triangles.reshaped().begin(), triangles.reshaped().end());
  return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) +
         static_cast<int>(triangles.cols());
}

}  // namespace palpate::test
