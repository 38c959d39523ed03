// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <functional>

#include "identification/measurements.h"
#include "identification/registration.h"

namespace palpate {

/// A registration with a further motion: a turn about the places' centre, rad, on a shift, m.
Registration moved(const Registration& registration, const Eigen::Matrix<double, 6, 1>& motion);

/// What residuals change by what a registration leaves open, by central differences: by a standard
/// deviation of each of its motions, and of the place of each contact and marker along each axis,
/// which the surface tells only across it. Places are left out where there are so many that to fit
/// them would take long: then they matter little.
/// @param measurements  in the surface's frame, to which the registration brought them.
/// @param residuals     of measurements in that frame, 3 #displacements; where these are refused
///                      (std::invalid_argument), as they leave the surface, smaller steps are
///                      tried.
/// @return 3 #displacements by any.
Eigen::MatrixXd changesByRegistration(
    const Measurements& measurements, const Registration& registration,
    const std::function<Eigen::VectorXd(const Measurements& moved)>& residuals);

}  // namespace palpate
