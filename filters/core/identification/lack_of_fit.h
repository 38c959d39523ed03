// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <array>
#include <Eigen/Core>
#include <vector>

#include "identification/material_identification.h"
#include "identification/measurements.h"

namespace palpate {

/// Places of markers, each once however many probes saw it, and which of them are neighbours: a
/// place and the six nearest to it among those that one probe saw. Of more than some thousands of
/// markers under a probe a part is taken.
class MarkerNeighbours {
 public:
  /// @param places  3 by #displacements, of the markers at rest, m.
  MarkerNeighbours(const Measurements& measurements, const Eigen::Matrix3Xd& places);

  int placeCount() const { return static_cast<int>(sights_.size()); }
  const std::vector<std::array<int, 2>>& pairs() const { return pairs_; }

  /// Sums of products of residuals of both places of each pair, over the probes that saw both.
  /// @param residuals  over their standard deviations, 3 #displacements; 0 where none counts.
  /// @param size       set to the sum of the products of their norms.
  Eigen::VectorXd products(const Eigen::VectorXd& residuals, double& size) const;

 private:
  struct Sight {
    int probe, row;
  };
  std::vector<std::vector<Sight>> sights_;  // of a place, by probes
  std::vector<std::array<int, 2>> pairs_;
};

/// Whether residuals of neighbours go together, as they do where the model differs from the body.
/// Where all is noise, that of a place could as well have the other sign, under all probes at once:
/// so the sum of the products is compared with those after so many such changes by chance (a
/// randomisation test). It asks nothing of the noise's size, which may differ from place to place,
/// and where markers are given inexactly that is noise of the same kind. Of few places the changes
/// are few, and no sum is beyond theirs.
/// @param residuals  as MarkerNeighbours::products.
NeighbourCorrelation neighbourCorrelation(const MarkerNeighbours& neighbours,
                                          const Eigen::VectorXd& residuals);

/// Warns if chance would have them go together as much in less than one table of noise in a
/// thousand, unless residuals are as small as what the response is interpolated to.
void warnOfLackOfFit(MaterialIdentification& result);

}  // namespace palpate
