// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/frictional_contact_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace palpate {
namespace {

constexpr double kStaleShare = 0.25;    ///< |D - D of the inverse| from which rows are replaced
constexpr double kEnoughGain = 0.5;     ///< of the residual, by which a step is worth repeating
constexpr int kPatience = 4;            ///< steps by the kept inverse without gain
constexpr int kFreshPatience = 20;      ///< and by fresh ones, which may wander before they arrive
constexpr int kSweeps = 16;             ///< at a time
constexpr double kLargestDrift = 0.05;  ///< of a moving contact's weights, until its rows are old

// Multiplications, as they are written below, a contact.
constexpr double kProjection = 13, kSlip = 12, kSlipShare = 38;  ///< and more if it slips
constexpr double kResidual = 9;                                  ///< three squared lengths
constexpr double kStaleness = 9;
constexpr double kClipping = 21;

/// Sum of the changes of two sites' weights; infinite for other nodes.
double driftBetween(const ContactSite& a, const ContactSite& b) {
  double drift = 0;
  for (int k = 0; k < a.count; ++k) {
    if (a.parts[k].node != b.parts[k].node) return std::numeric_limits<double>::infinity();
    drift += std::abs(a.parts[k].weight - b.parts[k].weight);
  }
  return drift;
}

}  // namespace

FrictionalContactSolver::FrictionalContactSolver(
    std::vector<std::shared_ptr<const GreensFunctions>> bodies, double rigidStiffness, int capacity,
    ContactSolverSettings settings)
    : compliance_(std::make_unique<ContactCompliance>(std::move(bodies), rigidStiffness, capacity)),
      settings_(settings),
      inverse_(*compliance_) {
  if (!(settings.tolerance > 0) || settings.largestIterations < 1 || settings.largestUpdates < 0 ||
      !(settings.largestWork >= 0))
    throw std::invalid_argument(
        "a contact solve needs a positive tolerance, at least one iteration and no negative number "
        "of updates or flops");
  conditions_.resize(capacity);
  status_.resize(capacity, ContactStatus::Open);
  wanted_.resize(capacity);
  drift_.resize(capacity);
  for (Eigen::VectorXd* vector :
       {&forces_, &displacement_, &residual_, &best_, &bestDisplacement_, &start_, &step_})
    vector->setZero(compliance_->stride());
}

bool FrictionalContactSolver::add(const ContactSite& site) noexcept {
  if (!compliance_->add(site)) return false;
  isCurrent_ = false;
  inverse_.append();
  const int n = count() - 1;
  wanted_[n].setZero();
  drift_[n] = 0;
  status_[n] = ContactStatus::Open;
  conditions_[n] = {};
  for (Eigen::VectorXd* vector : {&forces_, &displacement_}) vector->segment<3>(3 * n).setZero();
  return true;
}

void FrictionalContactSolver::remove(int contact) noexcept {
  isCurrent_ = isCurrent_ && force(contact).isZero(0);
  inverse_.remove(contact);
  compliance_->remove(contact);
  const int last = count();
  conditions_[contact] = conditions_[last];
  status_[contact] = status_[last];
  wanted_[contact] = wanted_[last];
  drift_[contact] = drift_[last];
  for (Eigen::VectorXd* vector : {&forces_, &displacement_}) {
    vector->segment<3>(3 * contact) = Eigen::Vector3d(vector->segment<3>(3 * last));
    vector->segment<3>(3 * last).setZero();
  }
}

void FrictionalContactSolver::turn(int body, const Eigen::Matrix3d& orientation) noexcept {
  isCurrent_ = false;
  compliance_->turn(body, orientation);
}

void FrictionalContactSolver::setForce(int contact, const Eigen::Vector3d& force) noexcept {
  isCurrent_ = false;
  forces_.segment<3>(3 * contact) = force;
}

void FrictionalContactSolver::move(int contact, const ContactSite& site) noexcept {
  isCurrent_ = false;
  drift_[contact] += driftBetween(site, compliance_->site(contact));
  compliance_->move(contact, site);
  if (drift_[contact] <= kLargestDrift) return;
  inverse_.moved(contact);
  drift_[contact] = 0;
}

void FrictionalContactSolver::setRigidStiffness(double rigidStiffness) noexcept {
  isCurrent_ = false;
  compliance_->setRigidStiffness(rigidStiffness);
  for (int i = 0; i < count(); ++i)
    if (compliance_->isOnFixed(i)) inverse_.moved(i);
}

void FrictionalContactSolver::clear() noexcept {
  inverse_.clear();
  while (count() > 0) remove(count() - 1);
}

/// P(f - r v) of one contact, and what its derivative by f - r v is made of where it slips.
struct FrictionalContactSolver::Projection {
  Eigen::Vector3d force;
  ContactStatus status;
  Eigen::Vector3d direction;  ///< of the shear, or zero
  double turning;             ///< the limit over the shear
};

FrictionalContactSolver::Projection FrictionalContactSolver::project(int contact) const noexcept {
  own_.add(kProjection, 0);
  const ContactConditions& conditions = conditions_[contact];
  const Eigen::Vector3d z =
      force(contact) - inverse_.scale(contact) * (displacement(contact) + conditions.offset);
  Projection projection;
  projection.force = z;
  projection.status = ContactStatus::Stick;
  if (conditions.bilateral) return projection;
  const Eigen::Vector3d& n = conditions.normal;
  const double pressure = n.dot(z);
  if (!(pressure > 0)) {
    projection.force.setZero();
    projection.status = ContactStatus::Open;
    return projection;
  }
  const Eigen::Vector3d shear = z - pressure * n;
  const double length = shear.norm(), limit = conditions.friction * pressure;
  if (length <= limit && limit > 0) return projection;
  own_.add(kSlip, 0);
  projection.status = ContactStatus::Slip;
  projection.direction = length > 0 ? (shear / length).eval() : Eigen::Vector3d::Zero();
  projection.turning = length > 0 ? limit / length : 0;
  projection.force = pressure * n + limit * projection.direction;
  return projection;
}

/// The derivative D.
Eigen::Matrix3d FrictionalContactSolver::shareOf(int contact,
                                                 const Projection& projection) const noexcept {
  if (projection.status == ContactStatus::Open) return Eigen::Matrix3d::Zero();
  if (projection.status == ContactStatus::Stick) return Eigen::Matrix3d::Identity();
  own_.add(kSlipShare, 0);
  const ContactConditions& conditions = conditions_[contact];
  const Eigen::Vector3d &n = conditions.normal, &direction = projection.direction;
  Eigen::Matrix3d share = (n + conditions.friction * direction) * n.transpose();
  if (projection.turning > 0)
    share += projection.turning *
             (Eigen::Matrix3d::Identity() - n * n.transpose() - direction * direction.transpose());
  return share;
}

double FrictionalContactSolver::largestForce() const noexcept {
  double largest = 0;
  for (int i = 0; i < count(); ++i) largest = std::max(largest, force(i).squaredNorm());
  return std::sqrt(largest);
}

/// Flops of going over the compliance so many times.
double FrictionalContactSolver::passes(double count) const noexcept {
  return 18 * count * this->count() * this->count();
}

bool FrictionalContactSolver::hasWorkFor(double flops) const noexcept {
  return settings_.largestWork == 0 ||
         2 * work().multiplications - workBefore_ + flops <= settings_.largestWork;
}

void FrictionalContactSolver::updateDisplacements() noexcept {
  if (isCurrent_) return;
  compliance_->multiply(forces_.data(), displacement_.data());
  isCurrent_ = true;
}

/// Displacements, the residual f - P(f - r v) and the shares; returns the largest residual, N, and
/// sets the largest force.
double FrictionalContactSolver::evaluate() noexcept {
  updateDisplacements();
  double worst = 0;
  largest_ = 0;  // squared
  for (int i = 0; i < count(); ++i) {
    const Projection projection = project(i);
    wanted_[i] = shareOf(i, projection);
    status_[i] = projection.status;
    residual_.segment<3>(3 * i) = force(i) - projection.force;
    const double size = residual_.segment<3>(3 * i).squaredNorm();
    if (std::isnan(size)) return size;
    worst = std::max(worst, size);
    largest_ = std::max({largest_, force(i).squaredNorm(), projection.force.squaredNorm()});
  }
  own_.add(kResidual * count(), 0);
  largest_ = std::sqrt(largest_);
  return std::sqrt(worst);
}

bool FrictionalContactSolver::isStale(int contact) const noexcept {
  return (wanted_[contact] - inverse_.share(contact)).squaredNorm() > kStaleShare * kStaleShare;
}

/// Brings the inverse up to the shares wanted, at most so many. @return how many it did.
int FrictionalContactSolver::renew(int mostUpdates) noexcept {
  int stale = 0, active = 0;
  own_.add(kStaleness * count(), 0);
  for (int i = 0; i < count(); ++i) {
    stale += isStale(i);
    active += status_[i] != ContactStatus::Open;
  }
  // An update goes over the inverse twice; factoring afresh costs as much as s / 6 of them.
  if (settings_.largestUpdates == 0 && stale > 4 && stale > active / 6 && inverse_.factor(wanted_))
    return 0;
  const int most = std::min(stale, mostUpdates);
  int done = 0;
  for (int looked = 0; looked < count() && done < most; ++looked) {
    if (inverse_.updates() > updatesBefore_ && !hasWorkFor(inverse_.workOfUpdate() + passes(2)))
      break;
    cursor_ = (cursor_ + 1) % count();  // on from the last, so that none waits for ever
    if (!isStale(cursor_)) continue;
    inverse_.update(cursor_, wanted_[cursor_]);
    ++done;
  }
  return done;
}

/// The contact whose share has changed most since its rows were made; if none has, each in turn,
/// because compliances may have.
int FrictionalContactSolver::mostOutdated() noexcept {
  constexpr double fresh = 1e-3;
  int oldest = -1;
  double most = fresh * fresh;
  for (int i = 0; i < count(); ++i)
    if (const double change = (wanted_[i] - inverse_.share(i)).squaredNorm(); change > most) {
      most = change;
      oldest = i;
    }
  if (oldest >= 0) return oldest;
  for (int looked = 0; looked < count(); ++looked) {
    refreshed_ = (refreshed_ + 1) % count();
    if (!wanted_[refreshed_].isZero(0)) break;
  }
  return refreshed_;
}

/// f -= H (f - P). Contacts that open lose their force first, so that the others answer to that.
void FrictionalContactSolver::newtonStep() noexcept {
  bool opened = false;
  isCurrent_ = false;
  for (int i = 0; i < count(); ++i) {
    if (status_[i] != ContactStatus::Open || forces_.segment<3>(3 * i).isZero(0)) continue;
    compliance_->addColumn(i, -force(i), displacement_.data());
    forces_.segment<3>(3 * i).setZero();
    opened = true;
  }
  for (int i = 0; opened && i < count(); ++i) {
    const bool isOpen = status_[i] == ContactStatus::Open && inverse_.share(i).isZero(0);
    residual_.segment<3>(3 * i) =
        isOpen ? Eigen::Vector3d::Zero() : Eigen::Vector3d(force(i) - project(i).force);
  }
  inverse_.apply(residual_.data());
  forces_.head(3 * count()) -= residual_.head(3 * count());
}

/// One round of nonlinear Gauss-Seidel: each contact in turn is projected, the others held.
void FrictionalContactSolver::sweep() noexcept {
  isCurrent_ = false;
  for (int i = 0; i < count(); ++i) {
    const Eigen::Vector3d before = force(i);
    const Eigen::Vector3d after = project(i).force;
    if (after == before) continue;
    forces_.segment<3>(3 * i) = after;
    compliance_->addColumn(i, after - before, displacement_.data());
  }
}

/// What is tried after a stage has not gained; sweeps come before Whole and Kept. They are cheap,
/// and find which contacts bear forces: an inverse made afresh after them is of use.
FrictionalContactSolver::Stage FrictionalContactSolver::next(Stage stage) noexcept {
  if (stage == Stage::Whole) return Stage::Damped;
  sweep();  // at least one, so that solves that are cut get on
  for (int k = 1; k < kSweeps && hasWorkFor(passes(3)); ++k) sweep();
  return stage == Stage::Kept ? Stage::Whole : Stage::Kept;
}

/// Puts every force into its cone. @return the largest excess there was over the largest force.
double FrictionalContactSolver::clipped() noexcept {
  double excess = 0;
  isCurrent_ = false;
  own_.add(kClipping * count(), 0);
  for (int i = 0; i < count(); ++i) {
    const ContactConditions& conditions = conditions_[i];
    if (conditions.bilateral) continue;
    const double pressure = std::max(0.0, conditions.normal.dot(force(i)));
    Eigen::Vector3d shear = force(i) - conditions.normal.dot(force(i)) * conditions.normal;
    const double length = shear.norm(), limit = conditions.friction * pressure;
    if (length > limit) shear *= pressure > 0 ? limit / length : 0;
    const Eigen::Vector3d inside = pressure * conditions.normal + shear;
    excess = std::max(excess, (force(i) - inside).norm());
    forces_.segment<3>(3 * i) = inside;
  }
  const double largest = largestForce();
  return excess > 0 ? excess / std::max(largest, excess) : 0;
}

ContactWork FrictionalContactSolver::work() const noexcept {
  ContactWork work = own_;
  work += compliance_->work();
  return work += inverse_.work();
}

ContactCertificate FrictionalContactSolver::solve() noexcept {
  ContactCertificate certificate;
  const int size = 3 * count();
  if (size == 0) return certificate;
  int updatesLeft =
      settings_.largestUpdates > 0 ? settings_.largestUpdates : std::numeric_limits<int>::max();
  constexpr double none = std::numeric_limits<double>::infinity();
  double best = none, goal = none, last = none;  // goal: best of this stage
  double bestOfRound = none, first = none;
  bool isSpent = false;  // the work
  Stage stage = Stage::Kept;
  int withoutGain = unsettled_ ? kPatience + 1 : 0;
  updatesBefore_ = inverse_.updates();
  workBefore_ = 2 * work().multiplications;
  for (Eigen::VectorXd* vector : {&best_, &bestDisplacement_}) vector->head(size).setZero();
  for (;; ++certificate.iterations) {
    const double residual = evaluate();
    if (certificate.iterations == 0) first = residual;
    if (residual < best) {
      best = residual;
      best_.head(size) = forces_.head(size);
      bestDisplacement_.head(size) = displacement_.head(size);
    }
    if (certificate.iterations > 0)
      withoutGain = residual < kEnoughGain * goal ? 0 : withoutGain + 1;
    goal = std::min(goal, residual);
    if (residual <= settings_.tolerance / 2 * largest_) break;  // the rest is for the cones
    isSpent = certificate.iterations > 0 && !hasWorkFor(passes(3));
    certificate.budgetCut = isSpent || certificate.iterations == settings_.largestIterations;
    if (certificate.budgetCut) break;
    const bool isStuck = withoutGain > (stage == Stage::Kept ? kPatience : kFreshPatience) ||
                         !std::isfinite(residual);
    if (isStuck && stage == Stage::Kept && updatesLeft == 0) {
      // Sweeps are all that is left.
      certificate.budgetCut = best >= kEnoughGain * bestOfRound;
      if (certificate.budgetCut) break;
      bestOfRound = best;
    }
    if (isStuck || (stage != Stage::Kept && !freshStep(stage))) {
      forces_.head(size) = best_.head(size);
      displacement_.head(size) = bestDisplacement_.head(size);
      isCurrent_ = true;
      stage = next(stage);
      withoutGain = 0;
      goal = last = none;
      continue;
    }
    if (stage != Stage::Kept) continue;
    updatesLeft -= renew(updatesLeft);
    // Where the steps gain little, rows that hardly changed or have drifted are worth a refresh.
    if (residual > kEnoughGain * last && updatesLeft > 0 &&
        hasWorkFor(inverse_.workOfUpdate() + passes(2))) {
      const int oldest = mostOutdated();
      inverse_.update(oldest, wanted_[oldest]);
      --updatesLeft;
    }
    last = residual;
    newtonStep();
  }
  // Where there is work for a sweep or two a solve, these may have to lead away first.
  if (!isSpent || !unsettled_ || best < first) forces_.head(size) = best_.head(size);
  certificate.coneViolation = clipped();
  const double residual = evaluate();
  certificate.residual = residual > 0 ? residual / largest_ : residual;
  for (int i = 0; i < count(); ++i) certificate.contactCount += status_[i] != ContactStatus::Open;
  unsettled_ = certificate.budgetCut;
  certificate.failed = !std::isfinite(certificate.residual) || !forces_.head(size).allFinite();
  return certificate;
}

}  // namespace palpate
