// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/field_pictures.h"

#include <vtkCellData.h>
#include <vtkCutter.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTetra.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Core>

#include "report/html.h"
#include "report/identification_tables.h"
#include "report/page_parts.h"
#include "terminal.h"

namespace palpate::app {
namespace {

constexpr double kBlind = 0.9;  ///< of the deviation expected: the data add little
constexpr const char *kModulus = "YoungsModulus", *kDeviation = "LogModulusDeviation";

/// What is told of each tetrahedron.
struct Cells {
  Eigen::Matrix3Xd centres;
  Eigen::VectorXd volumes, modulus, deviation;
};

Cells cellsOf(vtkUnstructuredGrid* field) {
  const vtkIdType count = field->GetNumberOfCells();
  Cells cells{Eigen::Matrix3Xd(3, count), Eigen::VectorXd(count), Eigen::VectorXd(count),
              Eigen::VectorXd(count)};
  for (vtkIdType i = 0; i < count; ++i) {
    Eigen::Vector3d x[4];
    for (int k = 0; k < 4; ++k) field->GetPoint(field->GetCell(i)->GetPointId(k), x[k].data());
    cells.centres.col(i) = (x[0] + x[1] + x[2] + x[3]) / 4;
    cells.volumes[i] =
        std::abs(vtkTetra::ComputeVolume(x[0].data(), x[1].data(), x[2].data(), x[3].data()));
    cells.modulus[i] = field->GetCellData()->GetArray(kModulus)->GetComponent(i, 0);
    cells.deviation[i] = field->GetCellData()->GetArray(kDeviation)->GetComponent(i, 0);
  }
  return cells;
}

/// The median of the modulus by volume.
double medianOf(const Cells& cells) {
  std::vector<Eigen::Index> order(cells.modulus.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Eigen::Index>(i);
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return cells.modulus[a] < cells.modulus[b]; });
  double sum = 0;
  for (Eigen::Index i : order)
    if ((sum += cells.volumes[i]) >= 0.5 * cells.volumes.sum()) return cells.modulus[i];
  return cells.modulus[order.back()];
}

/// The cell whose stiffness differs most surely from the median.
Eigen::Index mostDifferent(const Cells& cells) {
  Eigen::Index most;
  ((cells.modulus.array() / medianOf(cells)).log().abs() / cells.deviation.array().max(1e-12))
      .maxCoeff(&most);
  return most;
}

vtkSmartPointer<vtkPolyData> slice(vtkUnstructuredGrid* field, const Eigen::Vector3d& at,
                                   int axis) {
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(const_cast<double*>(at.data()));
  const Eigen::Vector3d normal = Eigen::Vector3d::Unit(axis);
  plane->SetNormal(normal.x(), normal.y(), normal.z());
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(field);
  cutter->SetCutFunction(plane);
  cutter->Update();
  return cutter->GetOutput();
}

/// Three slices through a place, coloured alike.
std::string slicePicture(const std::array<vtkSmartPointer<vtkPolyData>, 3>& slices,
                         const Eigen::Vector3d& at, const char* array, const std::string& barTitle,
                         std::array<double, 2> range, bool isLogarithmic) {
  // Along x and z one looks onto them, along y from the front.
  constexpr std::array<double, 3> kDirections[] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  Picture picture;
  for (int axis = 0; axis < 3; ++axis) {
    View view{slices[axis], std::string(1, "xyz"[axis]) + " = " + number(at[axis], 3) + " m",
              array,        barTitle,
              false,        range,
              isLogarithmic};
    view.hasEdges = false;
    view.towardsViewer = kDirections[axis];
    picture.views.push_back(view);
  }
  picture.width = 1200;
  picture.height = 420;
  picture.sharesBar = true;
  return drawn(picture, std::string(array) + " in three slices");
}

/// Where the data see least, and the free vertex nearest to it.
std::string blindText(vtkPolyData* model, const Cells& cells, double expected) {
  Eigen::Index least;
  const double deviation = cells.deviation.maxCoeff(&least);
  const Eigen::Vector3d place = cells.centres.col(least);
  vtkDataArray* types = model->GetPointData()->GetArray("BoundaryType");
  double nearest = 1e300;
  Eigen::Vector3d vertex = place;
  for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i) {
    const Eigen::Vector3d x(model->GetPoint(i));
    if (types->GetComponent(i, 0) != 0 || (x - place).norm() >= nearest) continue;
    nearest = (x - place).norm();
    vertex = x;
  }
  const double blind =
      (cells.deviation.array() > kBlind * expected).select(cells.volumes.array(), 0).sum();
  const std::string silent =
      blind > 0 ? "In <b>" + percent(blind / cells.volumes.sum()) +
                      "</b> of the volume the data say next to nothing: there the deviation of ln "
                      "E is above " +
                      number(kBlind * expected, 2) + ", where "
                : std::string("The data say something everywhere, where a deviation of ");
  return "<p>" + silent + number(expected, 2) +
         " was expected before anything was measured. They see least at " + vectorIn(place) +
         " m (deviation " + number(deviation, 2) + "); the free surface is nearest to that at " +
         vectorIn(vertex) + " m: a probe there, with markers around it, would tell more.</p>\n";
}

}  // namespace

std::string fieldText(vtkPolyData* model, vtkUnstructuredGrid* field, double expected) {
  const Cells cells = cellsOf(field);
  const Eigen::Index most = mostDifferent(cells);
  const Eigen::Vector3d at = cells.centres.col(most);
  std::array<vtkSmartPointer<vtkPolyData>, 3> slices;
  for (int axis = 0; axis < 3; ++axis) slices[axis] = slice(field, at, axis);
  const double low = cells.modulus.minCoeff(), high = cells.modulus.maxCoeff();
  const std::string pictures = slicePicture(slices, at, kModulus, "E (Pa)", {low, high}, true) +
                               slicePicture(slices, at, kDeviation, "deviation\nof ln E",
                                            {0, cells.deviation.maxCoeff()}, false);
  return "<h2>Stiffness inside</h2>\n<p>Young's modulus is from " + number(low, 3) + " to " +
         number(high, 3) + " Pa, in the median " + number(medianOf(cells), 3) +
         " Pa; the standard deviation of its logarithm from " +
         number(cells.deviation.minCoeff(), 2) + " to " + number(cells.deviation.maxCoeff(), 2) +
         " (0.1 is about 10 %).</p>\n" +
         figure(pictures, "Slices through " + vectorIn(at) +
                              " m, where Young's modulus differs from its median by most of its "
                              "deviations; below, how well it is known. To the right and upwards "
                              "are y and z, x and z, x and y.") +
         blindText(model, cells, expected);
}

}  // namespace palpate::app
