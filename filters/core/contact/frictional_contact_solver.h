// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "contact/contact_certificate.h"
#include "contact/contact_compliance.h"
#include "contact/contact_newton_inverse.h"

namespace palpate {

/// What is known of one contact before a solve.
struct ContactConditions {
  /// Unit, out of the obstacle: the way the surface can leave.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  /// Position relative to the obstacle without any contact force, m: its normal component is the
  /// gap, its tangential part the slip.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  double friction = 0;     ///< Coulomb's mu, >= 0; infinite: it never slips
  bool bilateral = false;  ///< held: neither gap nor slip, whatever the force
};

enum class ContactStatus { Open, Stick, Slip };

/// Limits of one solve. As they are by default a servo loop can wait for it; a solve that is cut is
/// certified so, and the next one goes on from it.
struct ContactSolverSettings {
  /// Of |f - P(f - r v)|, the residual of the projection form, over the largest force.
  double tolerance = 1e-9;
  int largestIterations = 100;
  /// Rank-three updates of the inverse in one solve while it is kept; 0 for no limit, then it may
  /// also be factored by LAPACK, which allocates and locks: not for a servo loop.
  int largestUpdates = 12;
  /// Flops of one solve, counted, so that equal input is cut at equal places whatever the machine;
  /// 0 for no limit. One iteration with one update is always made, and what ends the solve.
  double largestWork = 2e7;

  /// Those of whoever can wait for the last digit, in batch.
  static ContactSolverSettings unhurried() { return {1e-9, 100, 0, 0}; }
};

/// Unilateral contact with Coulomb friction between elastic bodies and obstacles (Signorini and
/// Coulomb, quasi-static): forces f and relative positions v = W f + offset such that in each
/// contact
///   v_n >= 0, f_n >= 0, v_n f_n = 0,  |f_t| <= mu f_n,  v_t = 0 or f_t = -mu f_n v_t / |v_t|.
///
/// Solved by the semismooth Newton method on the projection form f = P(f - r v) of P. Alart and
/// A. Curnier, "A mixed formulation for frictional contact problems prone to Newton like solution
/// methods", Comput. Methods Appl. Mech. Eng. 92 (1991); without friction it is the primal-dual
/// active set method of M. Hintermueller, K. Ito and K. Kunisch, SIAM J. Optim. 13 (2002). The
/// inverse of the Newton matrix stays from one solve to the next: a contact that enters, leaves or
/// changes between open, stick and slip costs an update of O(s^2), as in [JP01] section 4.3, and
/// what has changed little since is left to the iteration. Where such steps do not gain, others go
/// on from the best point so far, in turn, as in the hybrids that V. Acary, M. Bremond and O. Huber
/// found the most robust ("On solving contact problems with Coulomb friction: formulations and
/// numerical comparisons", in: Advanced Topics in Nonsmooth Dynamics, 2018): sweeps of nonlinear
/// Gauss-Seidel (M. Jean, Comput. Methods Appl. Mech. Eng. 177 (1999)), and, where the work
/// left allows it, Newton's steps with the inverse made afresh for each, whole at first, then
/// damped by Armijo's rule on the norm of the residual. With a limit to updates a solve ends as
/// well, cut, when they are used up and a round of sweeps no longer halves the residual. Contacts
/// may depend on each other: the matrix is regularised, the residual is not.
///
/// All memory is reserved by the constructor; nothing else allocates or throws. The work of a solve
/// is bounded by its settings alone, so that equal input gives equal output bit by bit.
class FrictionalContactSolver {
 public:
  /// @throws as ContactCompliance; std::invalid_argument for a tolerance that is not positive or
  ///         limits below one (updates and work: below zero).
  FrictionalContactSolver(std::vector<std::shared_ptr<const GreensFunctions>> bodies,
                          double rigidStiffness, int capacity, ContactSolverSettings settings = {});

  const ContactCompliance& compliance() const { return *compliance_; }
  int count() const { return compliance_->count(); }

  /// Appends an open contact; its conditions are to be set before the next solve.
  /// @return false as ContactCompliance::add.
  bool add(const ContactSite& site) noexcept;
  /// Removes a contact and its force; the last one takes its number.
  void remove(int contact) noexcept;
  void clear() noexcept;

  /// As ContactCompliance's. Newton's matrix follows as its rows are refreshed, and at once for a
  /// contact that has moved by more than a few hundredths of its triangle.
  void turn(int body, const Eigen::Matrix3d& orientation) noexcept;
  void move(int contact, const ContactSite& site) noexcept;
  /// As ContactCompliance's; Newton's matrix follows at once.
  void setRigidStiffness(double rigidStiffness) noexcept;

  ContactConditions& conditions(int contact) { return conditions_[contact]; }

  /// Solves for all forces from those of the last solve on.
  ContactCertificate solve() noexcept;
  /// Brings displacements up to the present forces, as after contacts have entered.
  void updateDisplacements() noexcept;

  /// On the body of the site's first part, N.
  Eigen::Vector3d force(int contact) const { return forces_.segment<3>(3 * contact); }
  void setForce(int contact, const Eigen::Vector3d& force) noexcept;
  /// W f: the displacement of a contact under all forces of the last solve or update, m.
  Eigen::Vector3d displacement(int contact) const { return displacement_.segment<3>(3 * contact); }
  ContactStatus status(int contact) const { return status_[contact]; }
  /// The inverse that is kept, for its counts.
  const ContactNewtonInverse& inverse() const { return inverse_; }
  /// All that solves and updates of displacements have computed so far, but for what comes of
  /// Green's functions.
  ContactWork work() const noexcept;

 private:
  struct Projection;
  Projection project(int contact) const noexcept;
  Eigen::Matrix3d shareOf(int contact, const Projection& projection) const noexcept;
  double evaluate() noexcept;
  double clipped() noexcept;
  bool isStale(int contact) const noexcept;
  int renew(int mostUpdates) noexcept;
  int mostOutdated() noexcept;
  void newtonStep() noexcept;
  /// How Newton's steps are made: by the inverse that is kept, by a fresh one, and damped.
  enum class Stage { Kept, Whole, Damped };
  Stage next(Stage stage) noexcept;
  bool freshStep(Stage stage) noexcept;
  void linearStep() noexcept;
  void damp(double before) noexcept;
  void sweep() noexcept;
  double largestForce() const noexcept;
  double passes(double count) const noexcept;
  bool hasWorkFor(double flops) const noexcept;

  std::unique_ptr<ContactCompliance> compliance_;  ///< stays where it is when this moves
  ContactSolverSettings settings_;
  ContactNewtonInverse inverse_;
  std::vector<ContactConditions> conditions_;
  std::vector<ContactStatus> status_;
  std::vector<double> drift_;            ///< sums of the weights' changes since rows were made
  std::vector<Eigen::Matrix3d> wanted_;  ///< D at the last evaluation
  Eigen::VectorXd forces_, displacement_, residual_, best_, bestDisplacement_;
  Eigen::VectorXd start_, step_;  ///< of a damped step
  long updatesBefore_ = 0;        ///< of the inverse, before this solve
  double workBefore_ = 0;         ///< flops before this solve
  int cursor_ = 0;                ///< contact whose rows were replaced last because they were stale
  int refreshed_ = 0;             ///< and because steps did not gain
  double largest_ = 0;            ///< force at the last evaluation, N
  mutable ContactWork own_;       ///< of vectors
  bool unsettled_ = false;        ///< whether the last solve was cut
  bool isCurrent_ = false;        ///< whether displacements are those of the forces
};

}  // namespace palpate
