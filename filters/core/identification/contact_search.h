// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "identification/cone_least_squares.h"
#include "identification/observed_response.h"

namespace palpate {

/// What may have happened: contacts about some sites, on a support that may yield.
struct ContactHypothesis {
  std::vector<int> seeds;  ///< sites, ascending: forces act on them and those beside them
  bool yields = false;     ///< whether the support is taken to
  SupportYield yield;
  std::vector<ConeRay> rays;  ///< of sites
  double squares = 0;         ///< of what is not explained, over the deviations
  int freedom = 0;            ///< numbers that were fitted
  double score = std::numeric_limits<double>::infinity();  ///< the less, the better

  Eigen::Matrix<double, 6, 1> wrench(const LoadResponses& responses) const;
};

/// Looks for the fewest contacts that explain what was observed. A hypothesis is judged by
/// Schwarz's criterion (1978): squared residuals over the noise's variance, plus the numbers fitted
/// times the logarithm of how many values there are. It grows by the contact that would lower
/// the squares most, each followed by fits in the cones of the sites about all contacts, which may
/// move, until no further one pays; no penalty shrinks its forces.
///
/// Where the support gives way more or less than the model's, as clamps do and coarse meshes of
/// them, forces by displacements that it dominates would be as wrong. Two further numbers describe
/// that (SupportYield), where they pay.
class ContactSearch {
 public:
  struct Settings {
    double friction = 0;   ///< largest tangential over normal force of a site
    double scale = 1;      ///< standard deviation of the noise, in units of the response's
    bool mayYield = true;  ///< the support, if the response can tell
  };

  /// @param rings  sites beside each, itself among them.
  ContactSearch(const std::vector<LoadSite>& sites, const std::vector<LoadPatch>& rings,
                const ObservedResponse& response, const Settings& settings);

  /// The best hypothesis for patches of one radius.
  ContactHypothesis search(const LoadResponses& responses) const;

  /// A hypothesis fitted to values.
  /// @param data  #rows.
  ContactHypothesis fitted(const LoadResponses& responses, ContactHypothesis hypothesis,
                           const Eigen::VectorXd& data) const;

  /// What a hypothesis explains, #rows.
  Eigen::VectorXd explained(const LoadResponses& responses,
                            const ContactHypothesis& hypothesis) const;

 private:
  void fit(const LoadResponses& responses, ContactHypothesis& hypothesis,
           const Eigen::VectorXd& data) const;
  bool improveYield(const LoadResponses& responses, ContactHypothesis& hypothesis,
                    const Eigen::VectorXd& data) const;
  std::vector<int> movedSeeds(const ContactHypothesis& hypothesis) const;
  int nextSeed(const LoadResponses& responses, const ContactHypothesis& hypothesis) const;
  ContactHypothesis thinned(const LoadResponses& responses, ContactHypothesis hypothesis) const;
  double gainOf(const Eigen::MatrixXd& columns, const Eigen::VectorXd& residual, int site) const;

  const std::vector<LoadSite>& sites_;
  const std::vector<LoadPatch>& rings_;
  const ObservedResponse& response_;
  double friction_, scale_;
  bool mayYield_;
};

/// Standard deviation of the noise over that assumed, by the residuals of forces at any sites, each
/// of which lowers their squares by more than twice the noise's: nothing that pushes explains the
/// rest. Negative where the values are too few to tell.
double noiseScale(const LoadResponses& single, const std::vector<LoadSite>& sites,
                  const ObservedResponse& response, double friction);

}  // namespace palpate
