// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "contact/frictional_contact_solver.h"
#include "contact/unilateral_contact_settings.h"
#include "contact/unilateral_contact_state.h"
#include "contact/wrench.h"
#include "mesh/surface_locator.h"
#include "mesh/surface_mesh.h"

namespace palpate {

/// Contact of an elastic surface with rigid tools and other elastic bodies: its points may not
/// enter an obstacle, press on it alone, and slip by Coulomb's law. The contact forces of all
/// obstacles follow together, from the rows of watched points alone ([JP01] sections 4.3 and 5.3).
///
/// The points are the vertices, and in each triangle with an edge longer than about a third of the
/// smallest radius of a rigid tool (one and a half times that of a mesh or a hand), which would
/// sink in between vertices, the one that lies deepest in it as the surface is deformed: the centre
/// of pressure, whose force acts on the corners by its barycentric coordinates. It follows the tool
/// from step to step. On tools of facets the triangle's normal is that of the contact. Of slivers
/// side by side some are left out: between the others the tool sinks in no deeper than between
/// vertices. Its force goes on without jumps, but that a ball slips off an edge or vertex at which
/// its force over its radius is more than their stiffness to the side: that is no equilibrium.
///
/// A step finds the vertices near each obstacle, undeformed and as the last forces deform them (by
/// conservative advancement: a vertex is looked at again only when an obstacle or the surface has
/// moved so far that they can be near each other: half as far, of those that are pressed away,
/// because both may move; the surface moves most where it is watched), linearises their gaps at the
/// deformed place of the last step, and solves for the forces from the last ones on. Steps are
/// quasi-static; sticking vertices keep the place on the obstacle where they stuck, and move with
/// it.
///
/// An obstacle can hold what it touches (setHeld): its contacts then neither part nor slip, points
/// inside triangles stay where they are, and it pulls. What comes to bear a force meanwhile is held
/// as well. A surface that is held cannot yield: no obstacle touches a vertex that another holds or
/// has a held point beside, nor the inside of a triangle with such a corner; and a point inside a
/// triangle is held only as long as it has a corner of its own.
///
/// Of two elastic bodies the vertices of the first meet the surface of the second: the finer mesh
/// should be the first.
///
/// What is deep in the body when contact begins, by half its radius or, of tools of facets and
/// other bodies, half an edge, tells nothing of where it came from: the surface would be pressed to
/// any side. It is taken to have come from the nearest place outside, and brought in from there by
/// and by, so that forces grow from zero; the certificate of the first step says startedInside.
///
/// Where there is no room for all, those stay that bear a force, then those that lie deepest, so
/// that the force goes on without a jump; the certificate says truncated while any that was left
/// out lies in an obstacle. What enters after that is let out little by little. It says failed if
/// one lies there that has no Green's functions.
///
/// All memory is reserved by the constructor: nothing else allocates or throws.
class UnilateralContact {
 public:
  /// Of a tool's smallest radius, the edge beyond which triangles are touched inside. A ball
  /// between the corners of an equilateral triangle with edges h lies h^2 / 6 R below them, with
  /// edges so long a fiftieth of its radius. Where the triangles are smaller than that, points
  /// inside them would be more contacts than the surface has nodes, and tell nothing new.
  static constexpr double kLargeEdge = 0.35;
  /// The same for tools of facets, to which a point inside a triangle costs a search, and of
  /// several parts, which share the points of a triangle between them: a ball between corners so
  /// far apart is half its radius below them.
  static constexpr double kLargeEdgeOfMany = 1.5;
  static constexpr double kNear = 1.0 / 4;  ///< of the margin, from where these are watched

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

  /// Whether an obstacle holds what it touches, from the next step on; or lets go of it.
  void setHeld(int obstacle, bool held) noexcept;
  bool isHeld(int obstacle) const { return obstacles_[obstacle].isHeld; }

  /// What the surface does to an obstacle, about its position. N, N m.
  Wrench wrench(int obstacle) const noexcept;
  /// Its force alone, N.
  Eigen::Vector3d force(int obstacle) const noexcept;

  int capacity() const { return solver_.compliance().capacity(); }
  /// Points watched, numbered in no order that lasts beyond a step.
  int watchedCount() const { return solver_.count(); }
  struct Watched {
    int obstacle;
    int vertex;    ///< -1 for a point inside a triangle
    int triangle;  ///< -1 for a vertex
    ContactStatus status;
    Eigen::Vector3d force;         ///< on the surface, N
    Eigen::Vector3d displacement;  ///< relative to an elastic obstacle's, m
    double gap;                    ///< to the obstacle as it is after the step, m
    bool held;                     ///< neither parts nor slips
  };
  Watched watched(int contact) const noexcept;
  /// Where a watched point lies undeformed, m.
  Eigen::Vector3d restPlace(int contact) const noexcept;
  /// The nodes that its force acts on, and by what share.
  const ContactSite& site(int contact) const { return solver_.compliance().site(contact); }

  /// Coulomb's mu of an obstacle, from the next step on.
  /// @throws std::invalid_argument if it is negative or NaN.
  void setFriction(int obstacle, double friction);
  /// What fixed vertices yield by, as UnilateralContactSettings::rigidStiffness, from the next step
  /// on.
  /// @throws std::invalid_argument if it is negative or not finite.
  void setRigidStiffness(double stiffness);
  double rigidStiffness() const { return settings_.rigidStiffness; }
  /// Scales all forces, as if Young's moduli and the rigid stiffness were scaled.
  /// @throws std::invalid_argument if it is not positive.
  void setStiffnessScale(double scale);
  double stiffnessScale() const { return stiffnessScale_; }

  /// The solver, for its counts.
  const FrictionalContactSolver& solver() const { return solver_; }
  /// Largest penetration of a watched point after the last step, m.
  double penetration() const { return penetration_; }
  /// Points that have entered or left the watch so far.
  long transitions() const { return transitions_; }

 private:
  /// A point cannot be touched from where its own body is: of the cosine between the surface's
  /// normal and the way out of the obstacle. Corners look aside.
  static constexpr double kLargestCosine = 0.5;

  struct Depth {
    double depth = 0;                                ///< m, negative or 0: outside
    Eigen::Vector3d way = Eigen::Vector3d::UnitZ();  ///< out
  };
  Depth depthOf(int obstacle, const RigidPose& pose) const noexcept;
  Eigen::Vector3d wayOut(int obstacle, const RigidPose& pose) const noexcept;
  const RigidPose* broughtIn(const RigidPose* poses) noexcept;

  void advance(const RigidPose* poses) noexcept;
  double wayOf(int obstacle, const RigidPose& pose) const noexcept;
  void turnBodies(const RigidPose* poses) noexcept;
  void look(int obstacle, int vertex) noexcept;
  double wayLeft(double gap, double nearness) const noexcept;
  void gatherLoads() noexcept;
  Eigen::Vector3d displacementOf(int vertex) const noexcept;
  bool isNearestPart(int obstacle, int vertex, double distance) noexcept;
  void watch(int obstacle, int vertex, const Proximity& near, double gap) noexcept;
  bool makeRoom(double gap) noexcept;
  double slackOf(double gap) const noexcept;
  bool enter(const ContactSite& site, double gap) noexcept;
  void unwatch(int contact) noexcept;
  void lookAgain(int contact) noexcept;
  void dismiss() noexcept;

  struct FacePoint;
  void findLargeTriangles();
  Eigen::Matrix3d restCorners(int triangle) const noexcept;
  Eigen::Matrix3d cornersOf(int triangle) const noexcept;
  Eigen::Vector3d deepestIn(int obstacle, const Eigen::Matrix3d& corners) const noexcept;
  FacePoint facePoint(int obstacle, const Eigen::Matrix3d& corners,
                      const Eigen::Vector3d& barycentric) const noexcept;
  Eigen::Vector3d balance(int contact, const Eigen::Matrix3d& corners) const noexcept;
  bool isDeepestPart(int obstacle, const FacePoint& point) const noexcept;
  void lookInside(int obstacle, int slot) noexcept;
  bool watchInside(int obstacle, int slot, const FacePoint& point) noexcept;
  bool moveInside(int contact, const Eigen::Matrix3d& corners, const FacePoint& point) noexcept;
  Eigen::Vector3d placeByNodes(int contact) const noexcept;
  void inheritSlip(int contact, const Eigen::Vector3d& place) noexcept;
  bool followInside(bool betweenSteps) noexcept;

  void hold() noexcept;
  void setHeldAt(int contact, bool held) noexcept;
  void letGo(int contact) noexcept;
  bool canHold(int contact) const noexcept;
  bool isHeldBeside(int triangle) const noexcept;
  bool isHeldFrom(int obstacle, int vertex) const noexcept;
  bool isDetermined(int contact) const noexcept;

  void linearise() noexcept;
  void settle() noexcept;
  void moveSites() noexcept;
  Eigen::Vector3d placeOf(int contact) const noexcept;
  Proximity proximity(int obstacle, const Eigen::Vector3d& place) const noexcept;
  Eigen::Vector3d normalOf(const ContactAnchor& anchor, const Proximity& near) const noexcept;
  ContactSite siteAt(int obstacle, int vertex, const Proximity& near) const noexcept;

  std::shared_ptr<const SurfaceMesh> mesh_;
  SurfaceLocator locator_;
  UnilateralContactSettings settings_;
  std::vector<MovingObstacle> obstacles_;
  std::vector<RigidPose> taken_;  ///< of each obstacle, with its `away`
  bool startedInside_ = false;    ///< in this step
  FrictionalContactSolver solver_;
  std::vector<ContactAnchor> anchors_;
  std::vector<int> loadedNodes_;  ///< free ones of the first body, of all forces
  Eigen::VectorXd tractions_;     ///< on them, Pa
  int loadCount_ = 0;
  std::vector<char> isHeldVertex_;        ///< a vertex
  std::vector<int> holders_;              ///< a vertex: held points that move with it,
  std::vector<int> holderOf_;             ///< and the obstacle that holds them
  std::vector<std::vector<int>> partOf_;  ///< a tool and vertex: the part that it is watched with
  Eigen::Vector3d centre_;                ///< of a ball that holds the surface
  double travelled_ = 0;  ///< m, no point of the surface, or an obstacle near it, moved farther
  double yielded_ = 0;    ///< m, the way of the watched points in the last step's solves
  double radius_ = 0, margin_ = 0, stiffnessScale_ = 1, penetration_ = 0;
  long transitions_ = 0;
  bool isTruncated_ = false, isUnserved_ = false;  ///< in this step
  bool wasTruncated_ = false;                      ///< in the last one
};

}  // namespace palpate
