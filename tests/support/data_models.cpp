// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "support/data_models.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace palpate::test {
namespace {

/// The numbers of the array with this name.
std::vector<double> readArray(const std::string& text, const std::string& name) {
  const std::size_t tag = text.find(" Name=\"" + name + "\"");
  if (tag == std::string::npos) throw std::runtime_error("no array " + name);
  const std::size_t begin = text.find('>', tag) + 1;
  std::istringstream numbers(text.substr(begin, text.find('<', begin) - begin));
  std::vector<double> values;
  for (double value; numbers >> value;) values.push_back(value);
  return values;
}

}  // namespace

DataModel readDataModel(const std::string& name) {
  std::ifstream file(std::string(PALPATE_DATA_DIRECTORY) + "/" + name + ".vtp");
  std::stringstream content;
  content << file.rdbuf();
  const std::string text = content.str();
  const std::vector<double> points = readArray(text, "Points"),
                            corners = readArray(text.substr(text.find("<Polys>")), "connectivity"),
                            types = readArray(text, "BoundaryType");
  DataModel model;
  model.shape.points = Eigen::Map<const Eigen::Matrix3Xd>(points.data(), 3, points.size() / 3);
  model.shape.triangles =
      Eigen::Map<const Eigen::Matrix3Xd>(corners.data(), 3, corners.size() / 3).cast<int>();
  model.boundaryTypes.assign(types.begin(), types.end());
  model.youngsModulus = readArray(text, "YoungsModulus").at(0);
  model.poissonRatio = readArray(text, "PoissonRatio").at(0);
  return model;
}

}  // namespace palpate::test
