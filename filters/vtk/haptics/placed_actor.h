// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_placed_actor_h
#define palpate_placed_actor_h

#include "vtkNew.h"

#include <Eigen/Geometry>

class vtkActor;
class vtkAlgorithmOutput;
class vtkPolyData;
class vtkTransform;

namespace palpate
{
/// Of a plain colour, without scalars.
void setSurface(vtkActor* actor, vtkAlgorithmOutput* surface);
void setColour(vtkActor* actor, const double colour[3]);

/// A surface that is drawn in one colour and moved about. It cannot be picked.
class PlacedActor
{
public:
  explicit PlacedActor(const double colour[3]);
  ~PlacedActor();
  void SetSurface(vtkPolyData* surface);
  void MoveTo(const Eigen::Vector3d& place,
    const Eigen::Quaterniond& orientation = Eigen::Quaterniond::Identity(),
    const Eigen::Vector3d& scale = Eigen::Vector3d::Ones());
  vtkActor* Actor() const { return this->Drawn; }

private:
  vtkNew<vtkActor> Drawn;
  vtkNew<vtkTransform> Transform;
};
} // namespace palpate

#endif
