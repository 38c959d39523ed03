// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <array>
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "contact/contact_work.h"
#include "greens/greens_functions.h"
#include "linear_algebra/aligned_buffer.h"

namespace palpate {

/// Where a contact acts: weights on up to four nodes of one or two bodies. Its displacement is the
/// weighted sum of theirs, and a force on it acts on them by the same weights: +1 at the node of a
/// body that meets a rigid tool, or barycentric coordinates at the corners of a triangle; +1 at a
/// node and minus the barycentric coordinates at the corners of the triangle of another elastic
/// body that it meets.
struct ContactSite {
  struct Part {
    int body, node;
    double weight;
  };
  int count = 0;
  std::array<Part, 4> parts;
  /// By how much of the way its compliance is raised to the mean of its nodes' own: nodes share a
  /// force between them, a place on the body cannot. Above 0 no number of contacts on few nodes
  /// contradict each other.
  double spread = 0;

  static ContactSite atNode(int body, int node) { return {1, {{{body, node, 1.0}}}}; }
  static constexpr double kSpread = 0.005;
  static ContactSite inTriangle(int body, const Eigen::Vector3i& nodes,
                                const Eigen::Vector3d& barycentric) {
    return {3,
            {{{body, nodes[0], barycentric[0]},
              {body, nodes[1], barycentric[1]},
              {body, nodes[2], barycentric[2]}}},
            kSpread};
  }
};

/// The compliance between contacts, W ij = displacement (m) of contact i per force (N) at contact
/// j: what the complementarity problem of contact mechanics calls the Delassus operator, here
/// -C of [JP01] eq. 19 with forces for tractions, over whole nodes of one or several bodies.
///
/// Contacts enter and leave at O(s). All memory is reserved by the constructor: nothing else
/// allocates or throws.
class ContactCompliance {
 public:
  /// @param bodies          Green's functions of each elastic body.
  /// @param rigidStiffness  N/m, k_Rigid of [JP01] eq. 33: what a fixed node yields by, alone,
  ///                        to all contacts that it bears.
  /// @param capacity        most contacts there will be.
  /// @throws std::invalid_argument without a body, or for a stiffness or capacity that is not
  ///         positive.
  ContactCompliance(std::vector<std::shared_ptr<const GreensFunctions>> bodies,
                    double rigidStiffness, int capacity);

  /// Turns a body: its Green's functions are those of its own frame, contacts are in a common one.
  /// Costs O(s^2).
  void turn(int body, const Eigen::Matrix3d& orientation) noexcept;

  /// Lets fixed nodes yield by another stiffness, N/m, positive.
  void setRigidStiffness(double rigidStiffness) noexcept;
  /// Whether any of a contact's nodes is fixed.
  bool isOnFixed(int contact) const noexcept;

  int count() const { return count_; }
  int capacity() const { return capacity_; }
  const GreensFunctions& body(int body) const { return *bodies_[body]; }
  int bodyCount() const { return static_cast<int>(bodies_.size()); }
  const ContactSite& site(int contact) const { return sites_[contact]; }

  /// Appends a contact. @return false, with nothing changed, beyond the capacity or at a free node
  /// without column.
  bool add(const ContactSite& site) noexcept;

  /// Moves a contact to another site, of nodes that have columns.
  void move(int contact, const ContactSite& site) noexcept;

  /// Removes a contact; the last one takes its number.
  void remove(int contact) noexcept;

  /// out = W forces.
  /// @param forces  3 count(), N.
  /// @param out     stride() numbers, m.
  void multiply(const double* forces, double* out) const noexcept;
  /// out += W of one contact's force.
  void addColumn(int contact, const Eigen::Vector3d& force, double* out) const noexcept;

  /// W ij, m/N.
  Eigen::Matrix3d block(int i, int j) const {
    return Eigen::Map<const Eigen::Matrix3d, 0, Eigen::OuterStride<>>(
        column(3 * j) + 3 * i, Eigen::OuterStride<>(stride_));
  }
  /// Column k of W, padded with zeros to stride().
  const double* column(int k) const { return matrix_.data() + std::size_t(k) * stride_; }
  int stride() const { return stride_; }
  /// Of multiply and addColumn.
  const ContactWork& work() const { return work_; }

 private:
  bool hasColumns(const ContactSite& site) const noexcept;
  void gatherBorder(const ContactSite& site) noexcept;
  void addSharedYield(const ContactSite::Part& part) noexcept;
  Eigen::Matrix3d ownBlock(const ContactSite& site) const noexcept;
  double* mutableColumn(int k) { return matrix_.data() + std::size_t(k) * stride_; }

  std::vector<std::shared_ptr<const GreensFunctions>> bodies_;
  std::vector<Eigen::Matrix3d> orientations_;
  double rigidStiffness_;
  int capacity_, stride_, count_ = 0;
  bool symmetric_ = true;  ///< whether W is
  std::vector<ContactSite> sites_;
  AlignedBuffer<double> matrix_;
  mutable ContactWork work_;
  std::vector<int> nodes_, owners_;  ///< scratch: parts of present contacts in one body
  std::vector<double> weights_, blocks_, rowBorder_, columnBorder_;
};

}  // namespace palpate
