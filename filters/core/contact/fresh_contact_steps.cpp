// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The steps of FrictionalContactSolver by an inverse made afresh.

#include "contact/frictional_contact_solver.h"

namespace palpate {
namespace {

constexpr double kArmijo = 1e-4;  ///< share of the foreseen gain that a damped step must make
constexpr int kHalvings = 8;      ///< of a step, at most

// Multiplications, as they are written below, a contact.
constexpr double kLinearised = 18;
constexpr double kHalving = 6;

}  // namespace

/// Newton's step by the matrix as it is at the last evaluation.
/// @return false, with nothing changed, if that is too much work for what is left of it.
bool FrictionalContactSolver::freshStep(Stage stage) noexcept {
  double active = 0;
  for (int i = 0; i < count(); ++i) active += status_[i] != ContactStatus::Open;
  if (!hasWorkFor(ContactNewtonInverse::workOfRebuild(active) + passes(4))) return false;
  inverse_.rebuild(wanted_);
  const int size = 3 * count();
  const double before = residual_.head(size).norm();
  start_.head(size) = forces_.head(size);
  linearStep();
  if (stage == Stage::Damped) damp(before);
  return true;
}

/// Newton's step as it is written: what opened contacts change for the others is linearised.
void FrictionalContactSolver::linearStep() noexcept {
  const int size = 3 * count();
  isCurrent_ = false;
  own_.add(kLinearised * count(), 0);
  step_.head(size) = displacement_.head(size);
  for (int i = 0; i < count(); ++i) {
    if (!inverse_.share(i).isZero(0)) continue;
    compliance_->addColumn(i, -force(i), displacement_.data());
    forces_.segment<3>(3 * i).setZero();
    residual_.segment<3>(3 * i).setZero();
  }
  for (int i = 0; i < count(); ++i)
    residual_.segment<3>(3 * i) += inverse_.scale(i) * inverse_.share(i) *
                                   (displacement_.segment<3>(3 * i) - step_.segment<3>(3 * i));
  inverse_.apply(residual_.data());
  forces_.head(size) -= residual_.head(size);
}

/// Halves the step from the start to the present forces until it gains.
void FrictionalContactSolver::damp(double before) noexcept {
  const int size = 3 * count();
  step_.head(size) = forces_.head(size) - start_.head(size);
  double share = 1;
  for (int k = 0; k < kHalvings && hasWorkFor(passes(3)); ++k) {
    evaluate();
    own_.add(kHalving * count(), 0);
    if (residual_.head(size).norm() <= (1 - kArmijo * share) * before) return;
    share /= 2;
    isCurrent_ = false;
    forces_.head(size) = start_.head(size) + share * step_.head(size);
  }
}

}  // namespace palpate
