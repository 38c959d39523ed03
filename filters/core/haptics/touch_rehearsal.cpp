// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "haptics/touch_rehearsal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

#include "greens/counting_greens.h"
#include "haptics/tool_touch.h"
#include "mesh/surface_locator.h"

namespace palpate {
namespace {

constexpr int kLooks = 10;           ///< ticks from one count of loaded nodes to the next
constexpr double kClearance = 0.02;  ///< mean edges, where a stroke begins above the surface

/// A mean and its standard error.
class Mean {
 public:
  void add(double value) {
    ++count_;
    const double change = value - mean_;
    mean_ += change / count_;
    squares_ += change * (value - mean_);
  }
  double value() const { return mean_; }
  double relativeError() const {
    return mean_ > 0 ? std::sqrt(squares_ / (count_ - 1) / count_) / mean_ : 0;
  }

 private:
  int count_ = 0;
  double mean_ = 0, squares_ = 0;
};

/// Numbers that are the same with every library: std's distributions differ.
class Chance {
 public:
  explicit Chance(unsigned seed) : engine_(seed) {}
  /// From 0 to below 1.
  double share() { return engine_() / 4294967296.0; }
  /// Within the unit ball.
  Eigen::Vector3d inBall() {
    for (;;) {
      const double x = 2 * share() - 1, y = 2 * share() - 1, z = 2 * share() - 1;
      const Eigen::Vector3d place(x, y, z);
      if (place.squaredNorm() < 1) return place;
    }
  }

 private:
  std::mt19937 engine_;
};

/// Where a tool is, its direction along the surface, and how it is held there.
struct Stroke {
  SurfacePoint point{0, Eigen::Vector3d::Zero()};
  Eigen::Vector3d place = Eigen::Vector3d::Zero(), way = place;
  double lift = 0;  ///< m along the normal, of a tool that touches without depth
  double sunk = 0;  ///< share of the depth
};

class Rehearsal {
 public:
  Rehearsal(const Scene& scene, const std::vector<SceneBody>& bodies,
            const std::vector<std::shared_ptr<const SurfaceMesh>>& toolMeshes,
            const RehearsalSettings& settings)
      : scene_(scene), settings_(settings), toolMeshes_(toolMeshes) {
    if (scene.isOfPoints())
      throw std::invalid_argument("points need no rehearsal: what they cost follows without");
    Scene bare = scene;
    bare.effects.deformation = DeformationRows::None;
    bare.effects.probes.clear();
    std::vector<SceneBody> counted = bodies;
    for (SceneBody& body : counted) {
      greens_.push_back(std::make_shared<CountingGreens>(body.greens));
      body.greens = greens_.back();
    }
    session_ = std::make_unique<TouchSession>(bare, counted, toolMeshes);
    touch_ = &static_cast<ToolTouch&>(session_->contact());
    mesh_ = session_->mesh(0);
    locator_ = std::make_unique<SurfaceLocator>(mesh_);
    snapshot_ = touch_->makeSnapshot();
    poses_.resize(scene.tools.size());
    wrenches_.resize(scene.tools.size());
    strokes_.resize(scene.tools.size());
    result_.loaded.assign(bodies.size(), 0);
    result_.loadedSquared.assign(bodies.size(), 0);
    result_.speed = speedOf(scene.tools[0]);
    sumAreas();
  }

  RehearsedTouch run(const Progress& progress) {
    constexpr int least = RehearsalSettings::kLeastStrokes, most = RehearsalSettings::kMostStrokes;
    Mean blocks, work;
    const auto error = [&] { return std::max(blocks.relativeError(), work.relativeError()); };
    while (result_.strokes < least || (result_.strokes < most && error() > settings_.error)) {
      const double wanted = result_.strokes < 2 ? least
                                                : result_.strokes * error() * error() /
                                                      (settings_.error * settings_.error);
      progress.report(result_.strokes / std::clamp<double>(wanted, least, most), "rehearse");
      const RehearsedTouch before = result_;
      stroke();
      ++result_.strokes;
      blocks.add(result_.gatheredBlocks + result_.displacementBlocks - before.gatheredBlocks -
                 before.displacementBlocks);
      work.add(result_.solverMultiplications - before.solverMultiplications);
    }
    result_.error = error();
    finish();
    progress.report(1, "rehearse");
    return result_;
  }

 private:
  static constexpr int kCounted =
      RehearsalSettings::kStrokeTicks - RehearsalSettings::kSinkingTicks;

  double depthOf(const SceneTool& tool) const {
    if (settings_.depth > 0) return settings_.depth;
    const double edge = mesh_->meanEdgeLength();
    return tool.radius > 0 ? std::min(edge, tool.radius) : edge;
  }
  double speedOf(const SceneTool& tool) const {
    return settings_.speed > 0 ? settings_.speed : handSpeed(scene_, tool);
  }
  /// N, in the scene, that the hand of a tool is given at most; a mouse gives none.
  double largestForceOf(const SceneTool& tool) const {
    const SceneDevice& device = scene_.devices[tool.device];
    const double largest = scene_.safety.largestForce;
    return device.type == DeviceType::Mouse || largest == 0
               ? std::numeric_limits<double>::infinity()
               : largest / device.mapping.forceScale;
  }

  /// Of the triangles with a corner that yields.
  void sumAreas() {
    double sum = 0;
    for (int f = 0; f < mesh_->triangleCount(); ++f) {
      bool isFree = false;
      for (int k = 0; k < 3; ++k) {
        const int node = mesh_->triangles()(k, f);
        isFree = isFree || (!greens_[0]->isFixed(node) && greens_[0]->hasColumn(node));
      }
      if (isFree) sum += mesh_->triangleAreas()[f];
      areas_.push_back(sum);
    }
  }

  Eigen::Vector3d normalAt(const SurfacePoint& point) const {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
      normal +=
          point.barycentric[k] * mesh_->vertexNormals().col(mesh_->triangles()(k, point.triangle));
    return normal.stableNormalized();
  }

  void begin(int tool, Chance& chance) {
    Stroke& stroke = strokes_[tool] = {};
    const auto chosen =
        std::upper_bound(areas_.begin(), areas_.end(), chance.share() * areas_.back());
    double a = chance.share(), b = chance.share();
    if (a + b > 1) {
      a = 1 - a;
      b = 1 - b;
    }
    stroke.point = {static_cast<int>(chosen - areas_.begin()), {1 - a - b, a, b}};
    stroke.place = placeOf(*mesh_, stroke.point);
    stroke.way = chance.inBall();
    stroke.lift = liftOf(tool, stroke);
  }

  /// The z axis of capsules points out of the body, that of planes into it; hands are palm down,
  /// meshes as they are.
  Eigen::Quaterniond orientationOf(int tool, const Eigen::Vector3d& normal) const {
    switch (scene_.tools[tool].shape) {
      case ToolShape::Capsule:
        return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal);
      case ToolShape::Plane:
        return Eigen::Quaterniond::FromTwoVectors(-Eigen::Vector3d::UnitZ(), normal);
      case ToolShape::Hand:
        return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitY(), normal);
      default:
        return Eigen::Quaterniond::Identity();
    }
  }

  /// How far a tool is from its place, along the normal, when it just touches the undeformed body.
  double liftOf(int tool, const Stroke& stroke) {
    const SceneTool& described = scene_.tools[tool];
    if (described.radius > 0) return described.radius;
    const Eigen::Vector3d normal = normalAt(stroke.point);
    ToolPose pose;
    pose.orientation = orientationOf(tool, normal);
    pose.jointCount = described.shape == ToolShape::Hand ? HandJointCount : 0;
    double low = -2 * mesh_->diagonal(), high = 2 * mesh_->diagonal();
    if (described.shape == ToolShape::Hand) high += described.length;
    if (described.shape == ToolShape::Mesh) high += toolMeshes_[tool]->diagonal();
    const double fine = 1e-3 * mesh_->meanEdgeLength();
    double lift = high;
    for (double gap; lift > low; lift -= std::max(gap, fine)) {
      pose.position = stroke.place + lift * normal;
      gap = gapOf(tool, pose, stroke.place);
      if (gap <= fine) break;
    }
    return lift;
  }

  /// From a tool to the undeformed surface, m: to its vertices, and a place between them.
  double gapOf(int tool, const ToolPose& pose, const Eigen::Vector3d& place) const {
    const TouchTool& shapes = touch_->tool(tool);
    std::vector<RigidPose> parts(shapes.partCount());
    shapes.place(pose, parts.data());
    double least = std::numeric_limits<double>::infinity();
    for (int part = 0; part < shapes.partCount(); ++part) {
      const auto shape = shapes.shape(part);
      const auto look = [&](const Eigen::Vector3d& at) {
        if ((at - parts[part].position).norm() - shape->reach() < least)
          least = std::min(least, shape->proximity(parts[part].toOwn(at)).distance);
      };
      look(place);
      for (int v = 0; v < mesh_->vertexCount(); ++v) look(mesh_->points().col(v));
    }
    return least;
  }

  /// The next tick of a tool's stroke.
  void move(int tool, int tick) {
    const SceneTool& described = scene_.tools[tool];
    Stroke& stroke = strokes_[tool];
    constexpr double sinking = RehearsalSettings::kSinkingTicks;
    if (tick < sinking) {
      const bool isHard = wrenches_[tool].force.norm() > largestForceOf(described);
      if (!isHard) stroke.sunk = (tick + 1) / sinking;
    } else {
      const Eigen::Vector3d normal = normalAt(stroke.point);
      stroke.way -= stroke.way.dot(normal) * normal;
      stroke.way.stableNormalize();
      stroke.place += speedOf(described) / scene_.servo.rate * stroke.way;
      stroke.point = locator_->nearest(stroke.place);
      stroke.place = placeOf(*mesh_, stroke.point);
    }
    const Eigen::Vector3d normal = normalAt(stroke.point);
    ToolPose& pose = poses_[tool] = {};
    pose.orientation = orientationOf(tool, normal);
    pose.jointCount = described.shape == ToolShape::Hand ? HandJointCount : 0;
    const double above = kClearance * mesh_->meanEdgeLength() * (1 - stroke.sunk);
    pose.position =
        stroke.place + (stroke.lift + above - stroke.sunk * depthOf(described)) * normal;
  }

  void stroke() {
    Chance chance(settings_.seed * 65536u + static_cast<unsigned>(result_.strokes));
    const int tools = static_cast<int>(strokes_.size());
    for (int tool = 0; tool < tools; ++tool) begin(tool, chance);
    touch_->reset();
    std::fill(wrenches_.begin(), wrenches_.end(), kNoWrench);
    ContactWork before;
    for (int tick = 0; tick < RehearsalSettings::kStrokeTicks; ++tick) {
      for (int tool = 0; tool < tools; ++tool) move(tool, tick);
      if (tick == RehearsalSettings::kSinkingTicks) {
        for (const auto& greens : greens_) greens->clearCounts();
        before = touch_->contact().solver().work();
      }
      touch_->step(poses_.data(), wrenches_.data());
      if (tick < RehearsalSettings::kSinkingTicks) continue;
      result_.watched += touch_->contact().watchedCount();
      result_.depth += strokes_[0].sunk * depthOf(scene_.tools[0]);
      if (tick % kLooks == 0) countLoads();
    }
    const ContactWork after = touch_->contact().solver().work();
    result_.solverMultiplications += after.multiplications - before.multiplications;
    result_.solverBytes += after.bytes - before.bytes;
    for (const auto& greens : greens_) {
      result_.gatheredBlocks += greens->counts().gatheredBlocks;
      result_.displacementBlocks += greens->counts().multiplyAdds / 9;
    }
  }

  void countLoads() {
    touch_->fill(snapshot_);
    for (std::size_t i = 0; i < greens_.size(); ++i) {
      const double loaded = static_cast<double>(
          snapshotTractions(*greens_[i], snapshot_, static_cast<int>(i),
                            Eigen::Matrix3d::Identity(), scene_.effects.stiffnessScale)
              .nodes.size());
      result_.loaded[i] += kLooks * loaded;
      result_.loadedSquared[i] += kLooks * loaded * loaded;
    }
  }

  /// From sums to means.
  void finish() {
    const double ticks = double(kCounted) * result_.strokes;
    for (double* sum :
         {&result_.depth, &result_.watched, &result_.gatheredBlocks, &result_.displacementBlocks,
          &result_.solverMultiplications, &result_.solverBytes})
      *sum /= ticks;
    for (std::vector<double>* sums : {&result_.loaded, &result_.loadedSquared})
      for (double& sum : *sums) sum /= ticks;
  }

  const Scene& scene_;
  RehearsalSettings settings_;
  const std::vector<std::shared_ptr<const SurfaceMesh>>& toolMeshes_;
  std::vector<std::shared_ptr<const CountingGreens>> greens_;
  std::unique_ptr<TouchSession> session_;
  ToolTouch* touch_;
  std::shared_ptr<const SurfaceMesh> mesh_;
  std::unique_ptr<SurfaceLocator> locator_;
  std::vector<double> areas_;  ///< up to and with a triangle, of those that can be touched
  ContactSnapshot snapshot_;
  std::vector<ToolPose> poses_;
  std::vector<Wrench> wrenches_;
  std::vector<Stroke> strokes_;
  RehearsedTouch result_;
};

}  // namespace

double handSpeed(const Scene& scene, const SceneTool& tool) {
  constexpr double hand = 0.1;  // m/s
  return hand * scene.devices[tool.device].mapping.scale;
}

RehearsedTouch rehearse(const Scene& scene, const std::vector<SceneBody>& bodies,
                        const std::vector<std::shared_ptr<const SurfaceMesh>>& toolMeshes,
                        const RehearsalSettings& settings, const Progress& progress) {
  return Rehearsal(scene, bodies, toolMeshes, settings).run(progress);
}

}  // namespace palpate
