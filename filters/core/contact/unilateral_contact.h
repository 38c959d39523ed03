// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "contact/frictional_contact_solver.h"
#include "contact/rigid_shape.h"
#include "contact/wrench.h"
#include "mesh/surface_mesh.h"

namespace palpate {

/// What an elastic surface meets.
struct Obstacle {
  std::shared_ptr<const RigidShape> shape;
  double friction = 0;  ///< Coulomb's mu between the two
  /// Of a second elastic body, whose undeformed surface is `shape` in its own frame, with the
  /// proximity's triangles those of `mesh`: both null for a rigid tool.
  std::shared_ptr<const GreensFunctions> greens = nullptr;
  std::shared_ptr<const SurfaceMesh> mesh = nullptr;
  /// Obstacles of the same number, >= 0, are parts of one tool and may overlap: a vertex meets the
  /// nearest of them only. -1: by itself.
  int tool = -1;
};

struct UnilateralContactSettings {
  int capacity = 128;  ///< most vertices watched at a time, over all obstacles
  /// m: a vertex is watched from this distance of its undeformed place to an obstacle on, and no
  /// longer beyond twice that; 0 for half the mean edge.
  double margin = 0;
  double rigidStiffness = 0;  ///< N/m, what fixed vertices yield by; 0 for 10 E times the mean edge
  int linearisations = 1;     ///< of the gaps at the deformed place, a step
  ContactSolverSettings solver;
};

/// Contact of an elastic surface with rigid tools and other elastic bodies: vertices may not enter
/// an obstacle, press on it alone, and slip by Coulomb's law. The contact forces of all obstacles
/// follow together, from the rows of watched vertices alone ([JP01] sections 4.3 and 5.3).
///
/// A step finds the vertices near each obstacle, undeformed and as the last forces deform them (by
/// conservative advancement: a vertex is looked at again only when its obstacle can have come near
/// and, of those that the obstacle has pressed away from itself, when it has come half as far,
/// because they move too), linearises their gaps at the deformed place of
/// the last step, and solves for the forces from the last ones on. Steps are quasi-static; sticking
/// vertices keep the place on the obstacle where they stuck, and move with it.
///
/// Of two elastic bodies the vertices of the first meet the surface of the second: the finer mesh
/// should be the first.
///
/// All memory is reserved by the constructor: nothing else allocates or throws.
class UnilateralContact {
 public:
  /// @throws std::invalid_argument for another surface's Green's functions, without obstacle or
  ///         shape, for negative friction or settings without sense.
  UnilateralContact(std::shared_ptr<const GreensFunctions> greens,
                    std::shared_ptr<const SurfaceMesh> mesh, std::vector<Obstacle> obstacles,
                    const UnilateralContactSettings& settings = {});

  int obstacleCount() const { return static_cast<int>(obstacles_.size()); }

  /// Moves the obstacles and solves. Turning an elastic obstacle costs gathering the compliance of
  /// all contacts afresh.
  /// @param poses  obstacleCount() of them, finite, in the frame of the surface.
  ContactCertificate step(const RigidPose* poses) noexcept;

  /// Forgets all contact.
  void reset() noexcept;

  /// What the surface does to an obstacle, about its position. N, N m.
  Wrench wrench(int obstacle) const noexcept;
  /// Its force alone, N.
  Eigen::Vector3d force(int obstacle) const noexcept;

  int capacity() const { return solver_.compliance().capacity(); }
  /// Vertices watched, numbered in no order that lasts beyond a step.
  int watchedCount() const { return solver_.count(); }
  struct Watched {
    int obstacle, vertex;
    ContactStatus status;
    Eigen::Vector3d force;         ///< on the surface, N
    Eigen::Vector3d displacement;  ///< relative to an elastic obstacle's, m
    double gap;                    ///< to the obstacle as it is after the step, m
  };
  Watched watched(int contact) const noexcept;
  /// Where a watched vertex lies undeformed, m.
  Eigen::Vector3d restPlace(int contact) const noexcept {
    return mesh_->points().col(anchors_[contact].vertex);
  }
  /// The nodes that its force acts on, and by what share.
  const ContactSite& site(int contact) const { return solver_.compliance().site(contact); }

  /// Coulomb's mu of an obstacle, from the next step on.
  /// @throws std::invalid_argument if it is negative or NaN.
  void setFriction(int obstacle, double friction);
  /// Scales all forces, as if Young's moduli and the rigid stiffness were scaled.
  /// @throws std::invalid_argument if it is not positive.
  void setStiffnessScale(double scale);
  double stiffnessScale() const { return stiffnessScale_; }

  /// The solver, for its counts.
  const FrictionalContactSolver& solver() const { return solver_; }
  /// Largest penetration of a watched vertex after the last step, m.
  double penetration() const { return penetration_; }
  /// Vertices that have entered or left the watch so far.
  long transitions() const { return transitions_; }
  /// Whether a vertex was turned away for want of capacity in the last step.
  bool overflowed() const { return overflowed_; }

 private:
  void advance(const RigidPose* poses) noexcept;
  double wayOf(int obstacle, const RigidPose& pose) const noexcept;
  void turnBodies(const RigidPose* poses) noexcept;
  void look(int obstacle, int vertex) noexcept;
  Eigen::Vector3d displacementOf(int vertex) const noexcept;
  bool isNearestPart(int obstacle, int vertex, double distance) noexcept;
  void watch(int obstacle, int vertex, const Proximity& near) noexcept;
  void unwatch(int contact) noexcept;
  void dismiss() noexcept;
  void moveSites() noexcept;
  void linearise() noexcept;
  void settle() noexcept;
  Eigen::Vector3d placeOf(int contact) const noexcept;
  Proximity proximity(int obstacle, const Eigen::Vector3d& place) const noexcept;
  ContactSite siteAt(int obstacle, int vertex, const Proximity& near) const noexcept;

  /// One obstacle as it moves.
  struct Moving {
    Obstacle obstacle;
    int body = 0;  ///< number of an elastic obstacle among the bodies
    RigidPose pose;
    bool placed = false;
    std::vector<double> lookAt;   ///< a vertex: travelled_ at which to look again
    std::vector<char> isWatched;  ///< a vertex
  };
  /// What is known of a watched vertex beyond the solver.
  struct Anchor {
    int obstacle, vertex;
    Eigen::Vector3d place;  ///< in the obstacle's frame, where it is or sticks
    double gap;
  };

  std::shared_ptr<const SurfaceMesh> mesh_;
  UnilateralContactSettings settings_;
  std::vector<Moving> obstacles_;
  FrictionalContactSolver solver_;
  std::vector<Anchor> anchors_;
  std::vector<std::vector<int>> partOf_;  ///< a tool and vertex: the part that it is watched with
  Eigen::Vector3d centre_;                ///< of a ball that holds the surface
  double travelled_ = 0;  ///< m, no point of an obstacle near the surface has moved farther
  double radius_ = 0, margin_ = 0, stiffnessScale_ = 1, penetration_ = 0;
  long transitions_ = 0;
  bool overflowed_ = false;
};

}  // namespace palpate
