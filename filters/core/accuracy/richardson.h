// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace palpate {

/// What a sequence of answers tends to as the mesh is refined.
struct RichardsonExtrapolation {
  Eigen::VectorXd values;
  double order = 0;         ///< p of the error c h^p
  bool isObserved = false;  ///< whether p was found from the answers, or stated
  /// How far the truth may be from `values`, in the norm.
  double uncertainty = 0;
};

/// Richardson's extrapolation of answers u_h = u + c h^p whose mesh size h is halved from one to
/// the next (L. F. Richardson, Phil. Trans. R. Soc. A 210, 1911):
///   u = u_fine + (u_fine - u_coarse) / (2^p - 1).
/// The order is observed on the last three answers,
///   p = log2(|u_1 - u_2| / |u_2 - u_3|),
/// where it lies between 1/2 and 4, so that they look like a sequence that tends somewhere; it is
/// `statedOrder` of two answers, and 1 of three that do not.
///
/// The uncertainty is the larger of two: what the extrapolations of both pairs leave to expect, as
/// if they tended to the truth no faster than the answers, |u_23 - u_12| / (2^p - 1); and a quarter
/// of the last step, |u_23 - u_3| / 4, by which P. J. Roache (J. Fluids Eng. 116, 1994) widens it.
/// Of two answers it is the last step, of three that show no order the last difference.
/// @param answers  two or more of equal size, the coarsest first; more than three are not used.
/// @param norm     of differences, in the unit of the uncertainty.
/// @throws std::invalid_argument for fewer answers or other sizes.
RichardsonExtrapolation extrapolate(const std::vector<Eigen::VectorXd>& answers,
                                    const std::function<double(const Eigen::VectorXd&)>& norm,
                                    double statedOrder = 2);

}  // namespace palpate
