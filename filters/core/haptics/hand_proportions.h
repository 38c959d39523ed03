// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

/// Lengths of the bones of a hand over its length, wrist to tip of the middle finger: B. Buchholz,
/// T. Armstrong, S. Goldstein, "Anthropometric data for describing the kinematics of the human
/// hand", Ergonomics 35(3), 1992. Breadth, radii and the thumb's base are round numbers that look
/// like a hand.
namespace palpate::hand {

/// Metacarpal, proximal, middle, distal of index, middle, ring and little finger.
constexpr double kFingers[4][4] = {{0.463, 0.245, 0.143, 0.097},
                                   {0.446, 0.266, 0.170, 0.108},
                                   {0.421, 0.244, 0.165, 0.107},
                                   {0.414, 0.204, 0.117, 0.093}};
/// Metacarpal, proximal, distal.
constexpr double kThumb[3] = {0.251, 0.196, 0.158};

/// Of the knuckles from the middle of the hand, towards the little finger.
constexpr double kKnuckles[4] = {-0.15, -0.05, 0.05, 0.15};
/// Of the thumb's first joint from the wrist: across towards the little finger, along the fingers.
constexpr double kThumbBase[2] = {-0.16, 0.08};

constexpr double kFingerRadii[4] = {0.055, 0.050, 0.045, 0.040};
constexpr double kThumbRadii[3] = {0.070, 0.058, 0.052};

}  // namespace palpate::hand
