// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "contact/frictional_contact_solver.h"

#include <algorithm>
#include <cmath>
#include <Eigen/LU>
#include <limits>
#include <stdexcept>

#include "contact/inverse_updates.h"
#include "greens/weighted_columns.h"
#include "linear_algebra/lapack.h"

namespace palpate {
namespace {

constexpr double kRegularisation = 1e-6;  ///< of r W, where contacts depend on each other
constexpr double kStaleShare = 0.25;      ///< |D - D of the inverse| from which rows are replaced
constexpr double kEnoughGain = 0.5;       ///< of the residual, by which a step is worth repeating
constexpr int kPatience = 4;              ///< Newton steps without gain before sweeps
constexpr int kSweeps = 8;                ///< at a time

}  // namespace

FrictionalContactSolver::FrictionalContactSolver(
    std::vector<std::shared_ptr<const GreensFunctions>> bodies, double rigidStiffness, int capacity,
    ContactSolverSettings settings)
    : compliance_(std::move(bodies), rigidStiffness, capacity),
      settings_(settings),
      stride_(compliance_.stride()) {
  if (!(settings.tolerance > 0) || settings.largestIterations < 1 || settings.largestUpdates < 0)
    throw std::invalid_argument(
        "a contact solve needs a positive tolerance, at least one iteration and no negative number "
        "of updates");
  conditions_.resize(capacity);
  status_.resize(capacity, ContactStatus::Open);
  share_.resize(capacity);
  wanted_.resize(capacity);
  scale_.resize(capacity);
  for (Eigen::VectorXd* vector : {&forces_, &displacement_, &residual_, &best_, &step_})
    vector->setZero(stride_);
  const std::size_t size = std::size_t(stride_) * 3 * capacity;
  inverse_ = AlignedBuffer<double>(size);
  factor_ = AlignedBuffer<double>(size);
  std::fill_n(inverse_.data(), size, 0);
  for (AlignedBuffer<double>* buffer : {&left_, &right_, &scratch_}) {
    *buffer = AlignedBuffer<double>(3 * std::size_t(stride_));
    std::fill_n(buffer->data(), buffer->size(), 0);
  }
  pivots_.resize(3 * capacity);
}

bool FrictionalContactSolver::add(const ContactSite& site) noexcept {
  if (!compliance_.add(site)) return false;
  const int n = count() - 1;
  scale_[n] = 3 / compliance_.block(n, n).trace();
  share_[n] = wanted_[n].setZero();
  status_[n] = ContactStatus::Open;
  conditions_[n] = {};
  forces_.segment<3>(3 * n).setZero();
  displacement_.segment<3>(3 * n).setZero();
  // The new rows of the Newton matrix are those of the identity; its new columns reach the contacts
  // that are not open: b = r D W. The inverse's new columns are -H b.
  double *b = left_.data(), *x = scratch_.data(), *unused = right_.data();
  std::fill_n(b, 3 * stride_, 0);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < n; ++i)
      Eigen::Map<Eigen::Vector3d>(b + j * stride_ + 3 * i) =
          scale_[i] * share_[i] *
          Eigen::Map<const Eigen::Vector3d>(compliance_.column(3 * n + j) + 3 * i);
  multiplyBothSides(inverse_.data(), 3 * n, stride_, b, b, 3, x, unused);
  for (int j = 0; j < 3; ++j) {
    double* newColumn = column(3 * n + j);
    std::fill_n(newColumn, stride_, 0);
    for (int i = 0; i < 3 * n; ++i) newColumn[i] = -x[j * stride_ + i];
    newColumn[3 * n + j] = 1;
  }
  return true;
}

void FrictionalContactSolver::remove(int contact) noexcept {
  if (!share_[contact].isZero(0)) replaceRows(contact, Eigen::Matrix3d::Zero());
  const int last = count() - 1;
  compliance_.remove(contact);
  if (contact != last) {
    conditions_[contact] = conditions_[last];
    status_[contact] = status_[last];
    share_[contact] = share_[last];
    wanted_[contact] = wanted_[last];
    scale_[contact] = scale_[last];
    for (Eigen::VectorXd* vector : {&forces_, &displacement_, &residual_})
      vector->segment<3>(3 * contact) = vector->segment<3>(3 * last);
    for (int j = 0; j < 3; ++j)
      std::copy_n(column(3 * last + j), 3 * (last + 1), column(3 * contact + j));
    for (int k = 0; k < 3 * last; ++k)
      std::copy_n(column(k) + 3 * last, 3, column(k) + 3 * contact);
  }
  for (int k = 0; k < 3 * last; ++k) std::fill_n(column(k) + 3 * last, 3, 0);
  for (Eigen::VectorXd* vector : {&forces_, &displacement_, &residual_, &step_})
    vector->segment<3>(3 * last).setZero();
}

void FrictionalContactSolver::clear() noexcept {
  for (int i = 0; i < count(); ++i) {
    share_[i].setZero();
    for (int j = 0; j < 3; ++j) {
      std::fill_n(column(3 * i + j), stride_, 0);
      column(3 * i + j)[3 * i + j] = 1;
    }
  }
  while (count() > 0) remove(count() - 1);
}

/// P(f - r v) of one contact and its derivative D by f - r v.
struct FrictionalContactSolver::Projection {
  Eigen::Vector3d force;
  Eigen::Matrix3d share;
  ContactStatus status;
};

FrictionalContactSolver::Projection FrictionalContactSolver::project(int contact) const noexcept {
  const ContactConditions& conditions = conditions_[contact];
  const Eigen::Vector3d z =
      force(contact) - scale_[contact] * (displacement(contact) + conditions.offset);
  if (conditions.bilateral) return {z, Eigen::Matrix3d::Identity(), ContactStatus::Stick};
  const Eigen::Vector3d& n = conditions.normal;
  const double pressure = n.dot(z);
  if (!(pressure > 0))
    return {Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), ContactStatus::Open};
  const Eigen::Vector3d shear = z - pressure * n;
  const double length = shear.norm(), limit = conditions.friction * pressure;
  if (length <= limit && limit > 0) return {z, Eigen::Matrix3d::Identity(), ContactStatus::Stick};
  Projection slip;
  slip.status = ContactStatus::Slip;
  const Eigen::Vector3d direction = length > 0 ? (shear / length).eval() : Eigen::Vector3d::Zero();
  slip.force = pressure * n + limit * direction;
  slip.share = (n + conditions.friction * direction) * n.transpose();
  if (length > 0)
    slip.share +=
        limit / length *
        (Eigen::Matrix3d::Identity() - n * n.transpose() - direction * direction.transpose());
  return slip;
}

double FrictionalContactSolver::largestForce() const noexcept {
  double largest = 0;
  for (int i = 0; i < count(); ++i) largest = std::max(largest, force(i).squaredNorm());
  return std::sqrt(largest);
}

void FrictionalContactSolver::updateDisplacements() noexcept {
  compliance_.multiply(forces_.data(), displacement_.data());
}

/// Displacements, the residual f - P(f - r v) and the shares; returns the largest residual over
/// the largest force.
double FrictionalContactSolver::evaluate() noexcept {
  updateDisplacements();
  double worst = 0, largest = 0;
  for (int i = 0; i < count(); ++i) {
    const Projection projection = project(i);
    wanted_[i] = projection.share;
    status_[i] = projection.status;
    residual_.segment<3>(3 * i) = force(i) - projection.force;
    worst = std::max(worst, residual_.segment<3>(3 * i).squaredNorm());
    largest = std::max({largest, force(i).squaredNorm(), projection.force.squaredNorm()});
  }
  return worst > 0 ? std::sqrt(worst / largest) : worst == 0 ? 0 : worst;  // NaN stays NaN
}

bool FrictionalContactSolver::isStale(int contact) const noexcept {
  return (wanted_[contact] - share_[contact]).squaredNorm() > kStaleShare * kStaleShare;
}

int FrictionalContactSolver::staleCount() const noexcept {
  int stale = 0;
  for (int i = 0; i < count(); ++i) stale += isStale(i);
  return stale;
}

/// Brings the inverse up to the shares wanted, at most so many. @return how many it did.
int FrictionalContactSolver::renew(int mostUpdates) noexcept {
  const int stale = staleCount();
  // An update reads and writes the inverse once; factoring afresh costs as much as s/6 of them.
  if (settings_.largestUpdates == 0 && stale > 4 && stale > count() / 6 && factor()) return 0;
  int done = 0;
  for (int looked = 0; looked < count() && done < std::min(stale, mostUpdates); ++looked) {
    cursor_ = (cursor_ + 1) % count();  // on from the last, so that none waits for ever
    if (!isStale(cursor_)) continue;
    replaceRows(cursor_, wanted_[cursor_]);
    ++done;
  }
  return done;
}

/// Transposed rows of the Newton matrix (1 - D) + D (r W + regularisation), stride by 3.
void FrictionalContactSolver::setRows(int contact, const Eigen::Matrix3d& share,
                                      double* rows) const noexcept {
  const Eigen::Matrix3d weight = scale_[contact] * share;
  for (int k = 0; k < 3 * count(); ++k) {
    const Eigen::Map<const Eigen::Vector3d> entry(compliance_.column(k) + 3 * contact);
    const Eigen::Vector3d row = weight * entry;
    for (int j = 0; j < 3; ++j) rows[j * stride_ + k] = row[j];
  }
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k < 3; ++k)
      rows[j * stride_ + 3 * contact + k] += (j == k ? 1 : 0) - (1 - kRegularisation) * share(j, k);
    std::fill(rows + j * stride_ + 3 * count(), rows + j * stride_ + padded(3 * count()), 0);
  }
}

/// Gives three rows R of the Newton matrix new values: H -= H_i (R H)_ii^-1 (R H - E_i^T), after
/// which R H = E_i^T whatever H was.
void FrictionalContactSolver::replaceRows(int contact, const Eigen::Matrix3d& share) noexcept {
  const int size = 3 * count();
  double *rows = left_.data(), *product = right_.data(), *x = scratch_.data();
  setRows(contact, share, rows);
  multiplyBothSides(inverse_.data(), size, stride_, rows, rows, 3, x, product);
  Eigen::Matrix3d pivot;
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 3; ++k) pivot(j, k) = product[j * stride_ + 3 * contact + k];
  const Eigen::Matrix3d pivotInverse = pivot.inverse();
  if (!pivotInverse.allFinite()) return;  // the regularised matrix is regular: rounding ran away
  for (int j = 0; j < 3; ++j) product[j * stride_ + 3 * contact + j] -= 1;
  for (int j = 0; j < 3; ++j) {
    double* scaled = x + j * stride_;
    for (int k = 0; k < size; ++k)
      scaled[k] = -(column(3 * contact)[k] * pivotInverse(0, j) +
                    column(3 * contact + 1)[k] * pivotInverse(1, j) +
                    column(3 * contact + 2)[k] * pivotInverse(2, j));
    std::fill(scaled + size, scaled + padded(size), 0);
  }
  addOuterProduct(inverse_.data(), size, stride_, x, product, 3);
  share_[contact] = share;
  ++updates_;
}

/// The inverse of the Newton matrix at the shares wanted (LAPACK). @return false, with the inverse
/// as it was, if it is singular.
bool FrictionalContactSolver::factor() noexcept {
  const int size = 3 * count();
  double* lu = factor_.data();
  for (int i = 0; i < count(); ++i) {
    setRows(i, wanted_[i], left_.data());
    for (int k = 0; k < size; ++k)
      for (int j = 0; j < 3; ++j)
        lu[std::size_t(k) * stride_ + 3 * i + j] = left_.data()[j * stride_ + k];
  }
  if (lapack::getrf(size, size, lu, stride_, pivots_.data()) != 0 ||
      lapack::getri(size, lu, stride_, pivots_.data(), scratch_.data(), 3 * stride_) != 0)
    return false;
  for (int k = 0; k < size; ++k) {
    std::copy_n(lu + std::size_t(k) * stride_, size, column(k));
    std::fill(column(k) + size, column(k) + stride_, 0);
  }
  std::copy_n(wanted_.begin(), count(), share_.begin());
  ++factorisations_;
  return true;
}

/// f -= H (f - P).
void FrictionalContactSolver::newtonStep() noexcept {
  std::fill_n(step_.data(), stride_, 0);
  const int size = 3 * count();
  const double* columns[kColumnGroup];
  for (int first = 0; first < size; first += kColumnGroup) {
    const int group = std::min(kColumnGroup, size - first);
    for (int k = 0; k < group; ++k) columns[k] = column(first + k);
    addWeightedColumns(columns, residual_.data() + first, group, padded(size), step_.data());
  }
  forces_.head(size) -= step_.head(size);
}

/// One round of nonlinear Gauss-Seidel: each contact in turn is projected, the others held.
void FrictionalContactSolver::sweep() noexcept {
  for (int i = 0; i < count(); ++i) {
    const Eigen::Vector3d before = force(i);
    const Eigen::Vector3d after = project(i).force;
    forces_.segment<3>(3 * i) = after;
    compliance_.addColumn(i, after - before, displacement_.data());
  }
}

/// Puts every force into its cone. @return the largest excess there was over the largest force.
double FrictionalContactSolver::clipped() noexcept {
  double excess = 0;
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

ContactCertificate FrictionalContactSolver::solve() noexcept {
  ContactCertificate certificate;
  const int size = 3 * count();
  if (size == 0) return certificate;
  int updatesLeft =
      settings_.largestUpdates > 0 ? settings_.largestUpdates : std::numeric_limits<int>::max();
  constexpr double none = std::numeric_limits<double>::infinity();
  double best = none, goal = none, last = none;  // goal: best since the last sweeps
  int withoutGain = unsettled_ ? kPatience + 1 : 0;
  best_.head(size).setZero();
  for (;; ++certificate.iterations) {
    const double residual = evaluate();
    if (residual < best) {
      best = residual;
      best_.head(size) = forces_.head(size);
    }
    if (certificate.iterations > 0)
      withoutGain = residual < kEnoughGain * goal ? 0 : withoutGain + 1;
    goal = std::min(goal, residual);
    if (best <= settings_.tolerance) break;
    certificate.budgetCut = certificate.iterations == settings_.largestIterations;
    if (certificate.budgetCut) break;
    if (withoutGain > kPatience || !std::isfinite(residual)) {
      forces_.head(size) = best_.head(size);
      evaluate();
      for (int k = 0; k < kSweeps; ++k) sweep();
      withoutGain = 0;
      goal = last = none;
      continue;
    }
    updatesLeft -= renew(updatesLeft);
    // Where the steps gain little, rows that hardly changed or have drifted are worth a refresh.
    if (residual > kEnoughGain * last && updatesLeft > 0) {
      cursor_ = (cursor_ + 1) % count();
      replaceRows(cursor_, wanted_[cursor_]);
      --updatesLeft;
    }
    last = residual;
    newtonStep();
  }
  forces_.head(size) = best_.head(size);
  certificate.coneViolation = clipped();
  certificate.residual = evaluate();
  for (int i = 0; i < count(); ++i) certificate.contactCount += status_[i] != ContactStatus::Open;
  unsettled_ = certificate.budgetCut;
  certificate.failed = !std::isfinite(certificate.residual) || !forces_.head(size).allFinite();
  return certificate;
}

}  // namespace palpate
