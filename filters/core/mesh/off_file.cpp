// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/off_file.h"

#include <CGAL/IO/OFF.h>

#include <fstream>
#include <stdexcept>
#include <vector>

#include "mesh/cgal_surface.h"

namespace palpate {

namespace {

/// A polygon's corners, not more than any mesh has: CGAL makes room for as many as the file says.
struct Corners : std::vector<std::size_t> {
  using value_type = std::size_t;
  void resize(std::size_t count) {
    constexpr std::size_t most = 1 << 20;
    if (count > most) throw std::length_error("too many corners");
    std::vector<std::size_t>::resize(count);
  }
};

/// Each vertex and each polygon takes more than a byte: what has more of them is cut off or wrong.
bool hasPlausibleCounts(std::ifstream& file) {
  file.seekg(0, std::ios::end);
  const auto bytes = static_cast<std::size_t>(file.tellg());
  file.seekg(0);
  const CGAL::File_scanner_OFF header(file);
  const bool isPlausible =
      !file.fail() && header.size_of_vertices() < bytes && header.size_of_facets() < bytes;
  file.clear();
  file.seekg(0);
  return isPlausible;
}

bool read(std::ifstream& file, std::vector<CgalPoint>& points, std::vector<Corners>& polygons) {
  try {
    return hasPlausibleCounts(file) && CGAL::IO::read_OFF(file, points, polygons);
  } catch (const std::length_error&) {
    return false;
  }
}

}  // namespace

PolygonSoup readOffFile(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("the file cannot be opened");
  std::vector<CgalPoint> points;
  std::vector<Corners> polygons;
  if (!read(file, points, polygons))
    throw std::runtime_error("the file is not a readable OFF file");
  PolygonSoup soup;
  soup.points.resize(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    soup.points.col(i) << points[i].x(), points[i].y(), points[i].z();
  for (const Corners& polygon : polygons)
    soup.polygons.emplace_back(polygon.begin(), polygon.end());
  return soup;
}

}  // namespace palpate
