// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/polygon_file.h"

#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "mesh/cgal_surface.h"
#include "mesh/number_text.h"

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

/// CGAL's reader takes for a coordinate what of a word is a number. A text file has but one word,
/// its first, that is none.
bool hasNumbersAlone(std::ifstream& file) {
  const bool isBinary = CGAL::File_scanner_OFF(file).binary();
  file.clear();
  file.seekg(0);
  bool hasKeyword = false, isSound = true;
  for (std::string line, word; !isBinary && isSound && std::getline(file, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    for (; isSound && words >> word; hasKeyword = true) isSound = !hasKeyword || isNumber(word);
  }
  file.clear();
  file.seekg(0);
  return isSound;
}

/// Reads with one of CGAL's readers, all of whose failures are one.
template <class Read>
PolygonSoup readWith(const std::string& path, const char* format, const Read& read) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("the file cannot be opened");
  std::vector<CgalPoint> points;
  std::vector<Corners> polygons;
  bool isRead = false;
  try {
    isRead = read(file, points, polygons);
  } catch (const std::exception&) {  // such as a length that no memory holds
  }
  if (!isRead)
    throw std::runtime_error(std::string("the file is not a readable ") + format + " file");
  PolygonSoup soup;
  soup.points.resize(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    soup.points.col(i) << points[i].x(), points[i].y(), points[i].z();
  for (const Corners& polygon : polygons)
    soup.polygons.emplace_back(polygon.begin(), polygon.end());
  return soup;
}

}  // namespace

PolygonSoup readOffFile(const std::string& path) {
  return readWith(path, "OFF", [](std::ifstream& file, auto& points, auto& polygons) {
    return hasPlausibleCounts(file) && hasNumbersAlone(file) &&
           CGAL::IO::read_OFF(file, points, polygons);
  });
}

PolygonSoup readPlyFile(const std::string& path) {
  return readWith(path, "PLY", [](std::ifstream& file, auto& points, auto& polygons) {
    return CGAL::IO::read_PLY(file, points, polygons);
  });
}

}  // namespace palpate
