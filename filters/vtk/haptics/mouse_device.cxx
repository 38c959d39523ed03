// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mouse_device.h"

namespace palpate
{
MouseDevice::MouseDevice(double period, double speed)
  : Step(period * speed)
{
  this->Info.name = "mouse";
}

void MouseDevice::Put(const ToolPose& pose) noexcept
{
  this->Goals.put({ pose, this->Start, this->Jumps });
}

void MouseDevice::PutAtOnce(const ToolPose& pose) noexcept
{
  this->Start = pose.position;
  ++this->Jumps;
  this->Put(pose);
}

bool MouseDevice::read(DeviceState& state) noexcept
{
  this->Goals.update();
  const Goal& goal = this->Goals.latest();
  const Eigen::Vector3d from = this->Now.pose.position, way = goal.Pose.position - from;
  const double length = way.norm();
  this->Now.pose = goal.Pose;
  if (goal.Jumps != this->JumpsSeen)
  {
    this->Now.pose.position = goal.Start;
  }
  else if (length > this->Step)
  {
    this->Now.pose.position = from + this->Step / length * way;
  }
  this->JumpsSeen = goal.Jumps;
  ++this->Now.sequence; // a mouse that rests is no silent one
  state = this->Now;
  return true;
}
} // namespace palpate
