// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/off_file.h"

#include <CGAL/IO/OFF.h>

#include <fstream>
#include <limits>
#include <stdexcept>

#include "mesh/cgal_surface.h"

namespace palpate {

PolygonSoup readOffFile(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("the file cannot be opened");
  std::vector<CgalPoint> points;
  std::vector<std::vector<std::size_t>> polygons;
  if (!CGAL::IO::read_OFF(file, points, polygons))
    throw std::runtime_error("the file is not a readable OFF file");
  PolygonSoup soup;
  soup.points.resize(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    soup.points.col(i) << points[i].x(), points[i].y(), points[i].z();
  for (const std::vector<std::size_t>& polygon : polygons) {
    soup.polygons.emplace_back();
    for (std::size_t corner : polygon) {
      if (corner >= points.size())
        throw std::runtime_error("polygon " + std::to_string(soup.polygons.size() - 1) +
                                 " refers to vertex " + std::to_string(corner) +
                                 ", but there are only " + std::to_string(points.size()));
      soup.polygons.back().push_back(static_cast<int>(corner));
    }
  }
  return soup;
}

}  // namespace palpate
