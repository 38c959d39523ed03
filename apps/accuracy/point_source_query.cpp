// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <map>
#include <numeric>

#include "accuracy/query.h"
#include "bem/kelvin.h"

namespace palpate::app {
namespace {

const Eigen::Vector3d kForce(0.3, -0.5, 1);  // in no special direction

/// Kelvin's field of a force at a place.
struct PointSource {
  Eigen::Vector3d place;
  double shearModulus, poissonRatio;

  Eigen::Vector3d displacement(const Eigen::Vector3d& x) const {
    return bem::kelvinDisplacement(x - place, shearModulus, poissonRatio) * kForce;
  }
  /// @param area  any vector along the normal: the force on it.
  Eigen::Vector3d force(const Eigen::Vector3d& x, const Eigen::Vector3d& area) const {
    return area.norm() *
           (bem::kelvinTraction(x - place, area.normalized(), poissonRatio).transpose() * kForce);
  }
};

class PreparedPointSource final : public PreparedQuery {
 public:
  PreparedPointSource(std::shared_ptr<const GreensFunctions> greens, const ElasticModel& model,
                      const PointSource& source)
      : greens_(std::move(greens)), free_(model.conditions().freeNodes()) {
    const SurfaceMesh& mesh = model.mesh();
    const Eigen::VectorXi& patches = model.smoothPatches();
    given_ = Eigen::Matrix3Xd::Zero(3, mesh.vertexCount());
    std::map<std::pair<int, int>, int> columnOf;
    const std::vector<PatchColumn>& stored = greens_->info().patchColumns;
    for (std::size_t c = 0; c < stored.size(); ++c)
      columnOf[{stored[c].node, stored[c].patch}] = static_cast<int>(c);
    for (int v = 0; v < mesh.vertexCount(); ++v) {
      const Eigen::Vector3d x = mesh.points().col(v);
      if (greens_->isFixed(v)) given_.col(v) = source.displacement(x);
      std::map<int, std::pair<Eigen::Vector3d, double>> areas;  // a patch: as vector, as number
      for (int f : mesh.trianglesOfVertex(v)) {
        auto& area = areas.try_emplace(patches[f], Eigen::Vector3d::Zero(), 0.0).first->second;
        area.first += mesh.triangleAreas()[f] * mesh.triangleNormals().col(f);
        area.second += mesh.triangleAreas()[f];
      }
      for (const auto& [patch, area] : areas) {
        const Eigen::Vector3d traction = source.force(x, area.first) / area.second;
        const auto column = columnOf.find({v, patch});
        if (column != columnOf.end()) {
          patchColumns_.push_back(column->second);
          patchTractions_.insert(patchTractions_.end(), traction.data(), traction.data() + 3);
        } else if (!greens_->isFixed(v)) {
          given_.col(v) = traction;
        }
      }
    }
    setExact(mesh, source);
  }

  void evaluate() override {
    response_ = solveReferenceProblem(*greens_, given_);
    greens_->accumulatePatches(
        nodeList(patchColumns_),
        Eigen::Map<const Eigen::VectorXd>(patchTractions_.data(), patchTractions_.size()),
        response_.reshaped());
  }

  Answer answer() const override {
    Answer answer = exact_;
    answer.values = response_(Eigen::all, free_).reshaped();
    return answer;
  }

 private:
  void setExact(const SurfaceMesh& mesh, const PointSource& source) {
    exact_.exact.resize(3 * free_.size());
    exact_.weights.resize(3 * free_.size());
    exact_.group = static_cast<int>(3 * free_.size());
    for (std::size_t i = 0; i < free_.size(); ++i) {
      exact_.exact.segment<3>(3 * i) = source.displacement(mesh.points().col(free_[i]));
      exact_.weights.segment<3>(3 * i).setConstant(mesh.vertexAreas()[free_[i]]);
    }
  }

  std::shared_ptr<const GreensFunctions> greens_;
  std::vector<int> free_, patchColumns_;
  std::vector<double> patchTractions_;
  Eigen::Matrix3Xd given_, response_;
  Answer exact_;  ///< all but the values
};

class PointSourceQuery final : public Query {
 public:
  PointSourceQuery(const BodyLevels& body, const Eigen::Vector3d& source)
      : body_(body),
        source_{source, body.material().shearModulus(), body.material().poissonRatio()} {}

  std::vector<int> columns(const Setting& setting) const override {
    std::vector<int> nodes(body_.mesh(setting.level).vertexCount());
    std::iota(nodes.begin(), nodes.end(), 0);
    return nodes;
  }
  bool usesPatchColumns() const override { return true; }
  std::unique_ptr<PreparedQuery> prepare(std::shared_ptr<const GreensFunctions> greens,
                                         const Setting& setting) const override {
    return std::make_unique<PreparedPointSource>(
        std::move(greens), body_.model(setting.level, setting.jumps), source_);
  }
  std::string description() const override {
    return "displacement of the free surface in a point source's field, relative L2 norm";
  }

 private:
  const BodyLevels& body_;
  PointSource source_;
};

}  // namespace

std::unique_ptr<const Query> pointSourceQuery(const BodyLevels& body,
                                              const Eigen::Vector3d& source) {
  return std::make_unique<PointSourceQuery>(body, source);
}

}  // namespace palpate::app
