// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>

#include "haptics/device_recording.h"
#include "haptics/hand_model.h"
#include "haptics/touch_session.h"

namespace palpate::app {

/// From which side a hand comes to a body.
struct GraspApproach {
  Eigen::Vector3d from;     ///< the way that the back of the hand looks, an axis
  Eigen::Vector3d fingers;  ///< the way that they point, an axis: the body's longer one
  double extent;            ///< of the body along it, m
};
/// @param freeSide  the way that the free part of the surface looks.
GraspApproach approachTo(const SceneBody& body, const Eigen::Vector3d& freeSide);

constexpr double kMomentsASecond = 125;  ///< of the motion below: as many as a glove reports

/// A hand that comes down on a body, closes around it, strokes it in five rounds of an ellipse with
/// all its fingers, and lets go and grasps it again twice: four seconds at the pace of hands (a
/// kidney of 11 cm is stroked at 0.25 m/s). How far each joint closes follows from the body's shape.
DeviceRecording graspMotion(const SceneBody& body, const GraspApproach& approach,
                            const HandModel& hand);

}  // namespace palpate::app
