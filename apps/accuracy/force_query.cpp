// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <cmath>
#include <stdexcept>

#include "accuracy/query.h"
#include "contact/unilateral_contact.h"

namespace palpate::app {
namespace {

constexpr int kMostSteps = 50;
constexpr double kSettled = 1e-10;  ///< relative change of the force from step to step

Eigen::Vector3d normalAt(const SurfaceMesh& mesh, const SurfacePoint& point) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k)
    normal += point.barycentric[k] * mesh.vertexNormals().col(mesh.triangles()(k, point.triangle));
  return normal.normalized();
}

/// A ball without friction, at one place after the other.
class PreparedPress final : public PreparedQuery {
 public:
  PreparedPress(std::shared_ptr<const GreensFunctions> greens,
                std::shared_ptr<const SurfaceMesh> mesh, double ballRadius,
                const UnilateralContactSettings& settings, std::vector<RigidPose> poses)
      : contact_(std::move(greens), std::move(mesh), {{std::make_shared<SphereShape>(ballRadius)}},
                 settings),
        poses_(std::move(poses)),
        forces_(3 * poses_.size()) {}

  void evaluate() override {
    for (std::size_t i = 0; i < poses_.size(); ++i) forces_.segment<3>(3 * i) = press(poses_[i]);
  }

  Answer answer() const override {
    Answer answer;
    answer.values = forces_;
    answer.weights.setOnes(forces_.size());
    answer.group = 3;
    return answer;
  }

 private:
  /// Steps at one pose until the linearised gaps are those of the deformed place.
  Eigen::Vector3d press(const RigidPose& pose) {
    contact_.reset();
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    for (int step = 0; step < kMostSteps; ++step) {
      const ContactCertificate certificate = contact_.step(&pose);
      if (certificate.failed) throw std::runtime_error("a contact could not be solved");
      if (certificate.truncated)
        throw std::runtime_error("the ball touches more than the query has room for");
      const Eigen::Vector3d before = force;
      force = contact_.force(0);
      if (step > 0 && (force - before).norm() <= kSettled * force.norm()) break;
    }
    return force;
  }

  UnilateralContact contact_;
  std::vector<RigidPose> poses_;
  Eigen::VectorXd forces_;
};

class ForceQuery final : public Query {
 public:
  ForceQuery(const BodyLevels& body, std::vector<LevelledPoint> points, double ballRadius,
             double depth)
      : body_(body), points_(std::move(points)), ballRadius_(ballRadius), depth_(depth) {}

  /// Twice the radius of the circle in which the ball would cut a plane, and what is watched
  /// beyond.
  std::vector<int> columns(const Setting& setting) const override {
    const BoundaryConditions& conditions = body_.conditions(setting.level);
    if (setting.allColumns) return conditions.freeNodes();
    const SurfaceMesh& mesh = body_.mesh(setting.level);
    const double reach =
        2 * std::sqrt(2 * ballRadius_ * depth_) + 4 * mesh.meanEdgeLength() + depth_;
    std::vector<int> nodes;
    for (int v = 0; v < mesh.vertexCount(); ++v) {
      bool isNear = false;
      for (const LevelledPoint& point : points_)
        isNear = isNear ||
                 (mesh.points().col(v) - placeOf(mesh, point[setting.level - 1])).norm() < reach;
      if (isNear && !conditions.isFixed(v)) nodes.push_back(v);
    }
    return nodes;
  }

  std::unique_ptr<PreparedQuery> prepare(std::shared_ptr<const GreensFunctions> greens,
                                         const Setting& setting) const override {
    const SurfaceMesh& mesh = body_.mesh(setting.level);
    std::vector<RigidPose> poses;
    for (const LevelledPoint& point : points_) {
      const SurfacePoint& at = point[setting.level - 1];
      RigidPose pose;
      pose.position = placeOf(mesh, at) + (ballRadius_ - depth_) * normalAt(mesh, at);
      poses.push_back(pose);
    }
    UnilateralContactSettings settings;
    settings.capacity = 512;
    settings.solver = ContactSolverSettings::unhurried();
    settings.solver.tolerance = setting.contactTolerance;
    return std::make_unique<PreparedPress>(std::move(greens), body_.sharedMesh(setting.level),
                                           ballRadius_, settings, poses);
  }

  std::string description() const override {
    return "force on a ball that is pressed in, relative, the worst of the points";
  }

 private:
  const BodyLevels& body_;
  std::vector<LevelledPoint> points_;
  double ballRadius_, depth_;
};

}  // namespace

std::unique_ptr<const Query> forceQuery(const BodyLevels& body,
                                        const std::vector<LevelledPoint>& points, double ballRadius,
                                        double depth) {
  return std::make_unique<ForceQuery>(body, points, ballRadius, depth);
}

}  // namespace palpate::app
