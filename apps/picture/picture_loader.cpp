// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "picture/picture.h"

#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <stdexcept>

#include "library.h"

namespace palpate::app {
void drawPicture(const Picture& picture, const std::string& path) {
  static const auto draw = reinterpret_cast<DrawFunction>(
      loadFunction("libpalpate_picture.so", kDrawFunction, "pictures cannot be drawn"));
  const std::string failure = draw(picture, path);
  if (!failure.empty()) throw std::runtime_error(failure);
}

std::array<double, 3> directionOntoFreeSurface(vtkPolyData* surface) {
  vtkDataArray* types = surface->GetPointData()->GetArray("BoundaryType");
  Eigen::Vector3d free = Eigen::Vector3d::Zero(), mean = free;
  const double count = static_cast<double>(surface->GetNumberOfPoints());
  for (vtkIdType f = 0; f < surface->GetNumberOfCells(); ++f) {
    vtkIdType corners;
    const vtkIdType* ids;
    surface->GetCellPoints(f, corners, ids);
    if (corners != 3) continue;
    bool isFree = true;
    Eigen::Vector3d x[3];
    for (int k = 0; k < 3; ++k) {
      surface->GetPoint(ids[k], x[k].data());
      isFree = isFree && !(types && types->GetComponent(ids[k], 0) != 0);
    }
    if (isFree) free += (x[1] - x[0]).cross(x[2] - x[0]);
  }
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
    mean += Eigen::Vector3d(surface->GetPoint(i)) / count;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i) {
    const Eigen::Vector3d x = Eigen::Vector3d(surface->GetPoint(i)) - mean;
    scatter += x * x.transpose();
  }
  // A flat thing is looked at from its broad side, anything else from the middle of what is free; a
  // little from the front and above either way.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(scatter);
  Eigen::Vector3d direction = free.norm() > 0 ? free.normalized() : Eigen::Vector3d(0, 0, 0);
  if (axes.eigenvalues()[0] < 0.3 * axes.eigenvalues()[1]) {
    const Eigen::Vector3d broad = axes.eigenvectors().col(0);
    const double side = broad.dot(direction) + 1e-3 * broad.z();
    direction = side < 0 ? Eigen::Vector3d(-broad) : broad;
  }
  direction += Eigen::Vector3d(0.3, -0.5, 0.25);
  return {direction.x(), direction.y(), direction.z()};
}

}  // namespace palpate::app
