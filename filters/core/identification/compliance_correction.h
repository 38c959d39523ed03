// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include "greens/computed_greens_functions.h"
#include "identification/material_identification.h"
#include "identification/measured_response.h"
#include "identification/measurements.h"
#include "model/elastic_model.h"
#include "progress.h"

namespace palpate {

struct CorrectionOptions {
  /// The correction's space: so many leading modes of the prior's compliance, by its work on
  /// tractions; 0 for all.
  int modes = 0;
  /// Noise over what is corrected, variances of measured components; 0 to choose it by
  /// cross-validation.
  double smoothing = 0;
  bool leaveOutOutliers = true;
  int folds = 5;  ///< of the cross-validation, by probes; below 2 for none, with a smoothing given
};

struct CorrectedGreensFunctions {
  ElasticModel model;  ///< of domain Given: no material is known to have this compliance
  ComputedGreensFunctions greens;
  double smoothing = 0;
  double share = 1;  ///< of the correction, 1 unless more of it were not positive definite
  /// The factor on the prior's compliance; residuals, outliers, probes, warnings. Its holdOutError
  /// has probes that were left out predicted by what the others corrected.
  MaterialIdentification fit;
  double priorHoldOutError = -1;  ///< the same by the prior, with the factor that fits best
};

/// Corrects the compliance C of the free vertices by measured displacements, without any model of
/// the inside:
///     C = c C_0 + B X B^T
/// with the prior C_0, a factor c, the modes B of C_0 = B B^T or the leading ones of them, and of
/// all symmetric X the one that is most probable if its entries are independent normal, those on
/// its diagonal, each mode's own factor, of a larger variance (ComplianceKernel): a Gaussian
/// process on pairs of places, whose covariance are products of elastic responses (Rasmussen and
/// Williams, Gaussian Processes for Machine Learning, 2006, 2.2 and 9.1). What was measured is kept
/// but for noise, its mirror image by reciprocity likewise; between and beyond, C goes over to c
/// C_0 smoothly. The factor is the most probable one beside X, by generalised least squares (2.7
/// there). The equations, one a measured component, are solved by conjugate gradients.
///
/// Reactions of the support to forces stay the prior's, which are in balance with the forces.
/// @param prior  reciprocal, with the columns of all free vertices.
/// @throws std::invalid_argument for options out of range, a prior without these columns or not
///         reciprocal, displacements against the forces, fewer than two measured displacements;
///         Aborted; std::bad_alloc; std::runtime_error if no part of the correction leaves a
///         positive definite compliance.
CorrectedGreensFunctions correctCompliance(const GreensFunctions& prior, const ElasticModel& model,
                                           const MeasuredSetup& setup,
                                           const Measurements& measurements,
                                           const CorrectionOptions& options,
                                           const ProgressCallback& progress = {});

}  // namespace palpate
