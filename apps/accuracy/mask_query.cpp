// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "accuracy/query.h"
#include "contact/pressure_mask.h"

namespace palpate::app {
namespace {

/// A unit force at a point as tractions on nodes, and where the point's displacement is read.
struct Load {
  std::vector<int> nodes;
  Eigen::VectorXd density;  ///< 1/m^2, a node
  std::vector<int> corners;
  Eigen::VectorXd shares;  ///< barycentric, of free corners alone
};

/// @throws std::invalid_argument where the triangle has no free corner.
Load loadAt(const BodyLevels& body, const SurfacePoint& point, const Setting& setting) {
  const SurfaceMesh& mesh = body.mesh(setting.level);
  const BoundaryConditions& conditions = body.conditions(setting.level);
  const PressureMasks masks(mesh, conditions, MaskShape::Linear, setting.radius);
  std::map<int, double> density;
  Load load;
  std::vector<double> shares;
  for (int k = 0; k < 3; ++k) {
    const int corner = mesh.triangles()(k, point.triangle);
    const double share = point.barycentric[k];
    if (share <= 1e-12 || conditions.isFixed(corner)) continue;
    const VertexMask mask = masks.at(corner);
    for (std::size_t i = 0; i < mask.nodes.size(); ++i)
      density[mask.nodes[i]] += share * mask.density[i];
    load.corners.push_back(corner);
    shares.push_back(share);
  }
  if (load.corners.empty())
    throw std::invalid_argument("a point lies on the support at level " +
                                std::to_string(setting.level) + ": it does not yield there");
  load.shares = Eigen::Map<Eigen::VectorXd>(shares.data(), shares.size());
  load.density.resize(density.size());
  for (const auto& [node, value] : density) {
    load.density[load.nodes.size()] = value;
    load.nodes.push_back(node);
  }
  return load;
}

/// Nodes on the point's side of the body.
std::vector<int> visibleNodes(const SurfaceMesh& mesh, const SurfacePoint& point) {
  const Eigen::Vector3d direction = mesh.triangleNormals().col(point.triangle);
  std::vector<int> nodes;
  for (int v = 0; v < mesh.vertexCount(); ++v)
    if (mesh.vertexNormals().col(v).dot(direction) > 0) nodes.push_back(v);
  return nodes;
}

/// Responses of some rows to unit forces along x, y, z at each point.
class MaskedLoads : public PreparedQuery {
 public:
  /// @param rows  of each load; those of no load: all.
  MaskedLoads(std::shared_ptr<const GreensFunctions> greens, std::vector<Load> loads,
              std::vector<std::vector<int>> rows)
      : greens_(std::move(greens)), loads_(std::move(loads)), rows_(std::move(rows)) {
    responses_.resize(3 * loads_.size());
    for (std::size_t i = 0; i < loads_.size(); ++i) {
      const Eigen::Index rowCount = rows_.empty() ? greens_->nodeCount() : rows_[i].size();
      for (int j = 0; j < 3; ++j) {
        responses_[3 * i + j].resize(3 * rowCount);
        Eigen::VectorXd weights = Eigen::VectorXd::Zero(3 * loads_[i].density.size());
        for (Eigen::Index k = 0; k < loads_[i].density.size(); ++k)
          weights[3 * k + j] = loads_[i].density[k];
        weights_.push_back(weights);
      }
    }
  }

  void evaluate() override {
    for (std::size_t i = 0; i < responses_.size(); ++i) {
      responses_[i].setZero();
      const auto columns = nodeList(loads_[i / 3].nodes);
      if (rows_.empty())
        greens_->accumulate(columns, weights_[i], responses_[i]);
      else
        greens_->accumulate(columns, weights_[i], nodeList(rows_[i / 3]), responses_[i]);
    }
  }

 protected:
  /// Where a node stands among a load's rows.
  int rowOf(std::size_t load, int node) const {
    if (rows_.empty()) return node;
    return static_cast<int>(std::find(rows_[load].begin(), rows_[load].end(), node) -
                            rows_[load].begin());
  }

  std::shared_ptr<const GreensFunctions> greens_;
  std::vector<Load> loads_;
  std::vector<std::vector<int>> rows_;
  std::vector<Eigen::VectorXd> weights_, responses_;  ///< three a load
};

class PreparedCompliance final : public MaskedLoads {
 public:
  using MaskedLoads::MaskedLoads;
  Answer answer() const override {
    Answer answer;
    answer.group = 9;
    answer.values = Eigen::VectorXd::Zero(9 * loads_.size());
    for (std::size_t i = 0; i < responses_.size(); ++i)
      for (std::size_t k = 0; k < loads_[i / 3].corners.size(); ++k)
        answer.values.segment<3>(3 * i) +=
            loads_[i / 3].shares[k] *
            responses_[i].segment<3>(3 * rowOf(i / 3, loads_[i / 3].corners[k]));
    answer.weights.setOnes(answer.values.size());
    return answer;
  }
};

class PreparedSurface final : public MaskedLoads {
 public:
  PreparedSurface(std::shared_ptr<const GreensFunctions> greens, std::vector<Load> loads,
                  std::vector<int> sampled, const Eigen::VectorXd& areas)
      : MaskedLoads(std::move(greens), std::move(loads), {}),
        sampled_(std::move(sampled)),
        areas_(areas) {}
  Answer answer() const override {
    Answer answer;
    const auto perLoad = 3 * static_cast<Eigen::Index>(sampled_.size());
    answer.values.resize(perLoad * responses_.size());
    answer.weights.resize(answer.values.size());
    answer.group = static_cast<int>(answer.values.size());
    Eigen::Index next = 0;
    for (const Eigen::VectorXd& response : responses_)
      for (int v : sampled_) {
        answer.values.segment<3>(next) = response.segment<3>(3 * v);
        answer.weights.segment<3>(next).setConstant(areas_[v]);
        next += 3;
      }
    return answer;
  }

 private:
  std::vector<int> sampled_;
  const Eigen::VectorXd& areas_;
};

class MaskQuery : public Query {
 public:
  MaskQuery(const BodyLevels& body, std::vector<LevelledPoint> points)
      : body_(body), points_(std::move(points)) {}

  std::vector<int> columns(const Setting& setting) const override {
    if (setting.allColumns) return body_.conditions(setting.level).freeNodes();
    std::set<int> nodes;
    for (const Load& load : loads(setting)) nodes.insert(load.nodes.begin(), load.nodes.end());
    return {nodes.begin(), nodes.end()};
  }

 protected:
  std::vector<Load> loads(const Setting& setting) const {
    std::vector<Load> all;
    for (const LevelledPoint& point : points_)
      all.push_back(loadAt(body_, point[setting.level - 1], setting));
    return all;
  }

  const BodyLevels& body_;
  std::vector<LevelledPoint> points_;
};

class ComplianceQuery final : public MaskQuery {
 public:
  using MaskQuery::MaskQuery;
  std::unique_ptr<PreparedQuery> prepare(std::shared_ptr<const GreensFunctions> greens,
                                         const Setting& setting) const override {
    const std::vector<Load> loads = this->loads(setting);
    std::vector<std::vector<int>> rows;
    for (std::size_t i = 0; i < loads.size() && setting.rows != Rows::All; ++i) {
      std::set<int> nodes(loads[i].corners.begin(), loads[i].corners.end());
      if (setting.rows == Rows::Visible)
        for (int node : visibleNodes(body_.mesh(setting.level), points_[i][setting.level - 1]))
          nodes.insert(node);
      else
        nodes.insert(loads[i].nodes.begin(), loads[i].nodes.end());
      rows.emplace_back(nodes.begin(), nodes.end());
    }
    return std::make_unique<PreparedCompliance>(std::move(greens), loads, rows);
  }
  std::string description() const override {
    return "compliance under the mask, relative Frobenius norm, the worst of the points";
  }
};

class SurfaceQuery final : public MaskQuery {
 public:
  using MaskQuery::MaskQuery;
  std::unique_ptr<PreparedQuery> prepare(std::shared_ptr<const GreensFunctions> greens,
                                         const Setting& setting) const override {
    return std::make_unique<PreparedSurface>(std::move(greens), loads(setting),
                                             body_.conditions(1).freeNodes(),
                                             body_.mesh(1).vertexAreas());
  }
  std::string description() const override {
    return "displacement of the free surface under masked forces, relative L2 norm";
  }
};

}  // namespace

double relativeError(const Answer& answer, const Eigen::VectorXd& values,
                     const Eigen::VectorXd& reference) {
  const Eigen::VectorXd difference = values - reference;
  double worst = 0;
  for (Eigen::Index first = 0; first < values.size(); first += answer.group) {
    const auto squares = [&](const Eigen::VectorXd& v) {
      return answer.weights.segment(first, answer.group)
          .dot(v.segment(first, answer.group).cwiseAbs2());
    };
    const double error = std::sqrt(squares(difference) / squares(reference));
    if (std::isnan(error)) return error;
    worst = std::max(worst, error);
  }
  return worst;
}

std::unique_ptr<const Query> complianceQuery(const BodyLevels& body,
                                             const std::vector<LevelledPoint>& points) {
  return std::make_unique<ComplianceQuery>(body, points);
}

std::unique_ptr<const Query> surfaceQuery(const BodyLevels& body,
                                          const std::vector<LevelledPoint>& points) {
  return std::make_unique<SurfaceQuery>(body, points);
}

}  // namespace palpate::app
