// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/exchanged_system.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <memory>

#include "bem/influence_panels.h"
#include "bem/volume_identities.h"
#include "linear_algebra/streaming_store.h"
#include "parallel.h"

namespace palpate::bem {
namespace {

/// A column block of the system: what it is made of and where it goes.
struct ColumnBlock {
  bool isRight;            ///< in B, else in A
  int block;               ///< position there
  int vertex;              ///< H of this vertex, or -1
  std::vector<int> nodes;  ///< sum of G over these traction nodes where vertex < 0
  double sign;
};

std::vector<ColumnBlock> columnBlocks(const BodySurface& body, const CollocationScheme& scheme,
                                      const SystemColumns& wanted) {
  std::vector<ColumnBlock> blocks;
  for (int v = 0; v < body.vertexCount(); ++v)
    if (!body.fixed[v]) blocks.push_back({false, v, v, {}, 1});
  for (std::size_t i = 0; i < scheme.tractions.size(); ++i)
    blocks.push_back({false, scheme.columnOfTraction[i], -1, scheme.tractions[i].nodes, -1});
  int column = 0;
  for (int v : wanted.vertices) {
    std::vector<int> nodes;
    for (int node = body.nodes.first(v); node < body.nodes.end(v); ++node) nodes.push_back(node);
    if (body.fixed[v])
      blocks.push_back({true, column++, v, {}, -1});
    else
      blocks.push_back({true, column++, -1, nodes, 1});
  }
  for (int node : wanted.patchTractions) blocks.push_back({true, column++, -1, {node}, 1});
  // In the order of the vertices, as the panels' memory is.
  std::stable_sort(blocks.begin(), blocks.end(), [&](const ColumnBlock& a, const ColumnBlock& b) {
    const auto place = [&](const ColumnBlock& c) {
      return c.vertex >= 0 ? c.vertex : body.nodes.vertex[c.nodes.front()];
    };
    return place(a) < place(b);
  });
  return blocks;
}

template <class Scalar>
class Assembler {
 public:
  Assembler(const BodySurface& body, const CollocationScheme& scheme, const SystemColumns& wanted,
            double tolerance, int threads)
      : body_(body),
        scheme_(scheme),
        blocks_(columnBlocks(body, scheme, wanted)),
        panels_(body, scheme.points, tolerance),
        identities_(volumeIdentities(body, scheme)),
        threads_(threads) {
    system_.size = 3 * scheme.pointCount();
    system_.stride = (system_.size + kLine<Scalar> - 1) / kLine<Scalar> * kLine<Scalar>;
    system_.columns = 3 * wanted.count();
    system_.matrix = AlignedBuffer<Scalar>(std::size_t(system_.stride) * system_.size);
    system_.right = AlignedBuffer<Scalar>(std::size_t(system_.stride) * system_.columns);
    weights_ = rowWeights();
  }

  ExchangedSystem<Scalar> run(const Progress& progress) {
    std::vector<std::unique_ptr<InfluencePanels::Workspace>> work(threads_);
    std::vector<double> rotation(threads_, 0);
    std::vector<Eigen::MatrixXd> volumeSums(
        threads_, Eigen::MatrixXd::Zero(identities_.size(), 3 * blocks_.size()));
    parallelFor(
        panels_.panelCount(), threads_,
        [&](int panel, int thread) {
          if (!work[thread]) work[thread] = std::make_unique<InfluencePanels::Workspace>(panels_);
          panels_.compute(panel, *work[thread]);
          store(panel, *work[thread], volumeSums[thread]);
          rotation[thread] = std::max(rotation[thread], rotationResidual(panel, *work[thread]));
        },
        [&](int begun) { progress.report(double(begun) / panels_.panelCount(), "assemble"); });
    const double size = body_.points.colwise().norm().maxCoeff();
    system_.rotationDefect = *std::max_element(rotation.begin(), rotation.end()) / size;
    system_.closedFormShare = panels_.closedFormShare();
    for (int thread = 1; thread < threads_; ++thread) volumeSums[0] += volumeSums[thread];
    replaceVolumeEquations(volumeSums[0]);
    return std::move(system_);
  }

 private:
  Scalar* column(const ColumnBlock& block, int component) const {
    const AlignedBuffer<Scalar>& target = block.isRight ? system_.right : system_.matrix;
    return target.data() + (3 * std::size_t(block.block) + component) * system_.stride;
  }

  /// First row of a panel; its rows follow as all x equations, all y, all z.
  static std::size_t firstRow(int panel) { return std::size_t(3 * kLanes) * panel; }

  /// Writes a panel's rows of every column and adds their share of each shell's volume equation.
  void store(int panel, const InfluencePanels::Workspace& work, Eigen::MatrixXd& volumeSums) const {
    const int lanes = panels_.laneCount(panel);
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      for (int j = 0; j < 3; ++j) {
        alignas(64) double entries[3 * kLanes];
        gather(blocks_[b], j, work, entries);
        if (lanes < kLanes)
          for (int e = 0; e < 3 * lanes; ++e) entries[e] = entries[e / lanes * kLanes + e % lanes];
        const int rows = 3 * lanes;
        for (Eigen::Index s = 0; s < weights_.cols(); ++s) {
          const double* weight = weights_.data() + s * system_.stride + firstRow(panel);
          double sum = 0;
          for (int e = 0; e < rows; ++e) sum += weight[e] * entries[e];
          volumeSums(s, 3 * b + j) += sum;
        }
        Scalar* target = column(blocks_[b], j) + firstRow(panel);
        if (lanes == kLanes)
          streamStore(entries, rows, target);
        else
          std::copy_n(entries, rows, target);
      }
    finishStreaming();
  }

  static void gather(const ColumnBlock& block, int j, const InfluencePanels::Workspace& work,
                     double* entries) {
    for (int i = 0; i < 3; ++i) {
      const double* source =
          block.vertex >= 0 ? work.h(block.vertex, i, j) : work.g(block.nodes.front(), i, j);
      double* target = entries + i * kLanes;
      for (int lane = 0; lane < kLanes; ++lane) target[lane] = block.sign * source[lane];
      for (std::size_t k = 1; k < block.nodes.size(); ++k) {
        const double* more = work.g(block.nodes[k], i, j);
        for (int lane = 0; lane < kLanes; ++lane) target[lane] += block.sign * more[lane];
      }
    }
  }

  /// Largest component of H (omega x r) over the panel's points and three rotations: zero but for
  /// the error of integration. An exterior domain leaves the rotation itself.
  double rotationResidual(int panel, const InfluencePanels::Workspace& work) const {
    double largest = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 3; ++i) {
        double sum[kLanes] = {};
        for (int v = 0; v < body_.vertexCount(); ++v) {
          const Eigen::Vector3d turned = Eigen::Vector3d::Unit(axis).cross(body_.points.col(v));
          for (int j = 0; j < 3; ++j) {
            const double* h = work.h(v, i, j);
            for (int lane = 0; lane < kLanes; ++lane) sum[lane] += h[lane] * turned[j];
          }
        }
        for (int lane = 0; lane < panels_.laneCount(panel); ++lane) {
          const Eigen::Vector3d& x = scheme_.points[panel * kLanes + lane].position;
          const double expected = body_.exterior ? Eigen::Vector3d::Unit(axis).cross(x)[i] : 0;
          largest = std::max(largest, std::abs(sum[lane] - expected));
        }
      }
    return largest;
  }

  /// The weights of the shells' volume identities over the rows as they are stored.
  Eigen::MatrixXd rowWeights() const {
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(system_.stride, identities_.size());
    for (std::size_t s = 0; s < identities_.size(); ++s)
      for (int p = 0; p < scheme_.pointCount(); ++p) {
        const int panel = p / kLanes, lanes = panels_.laneCount(panel);
        for (int i = 0; i < 3; ++i)
          weights(firstRow(panel) + i * lanes + p % kLanes, s) = identities_[s].weights(p, i);
      }
    return weights;
  }

  /// Replaces, shell by shell, the equations' combination along the weights by the volume identity.
  /// @param present  #shells by 3 #blocks, that combination of each column.
  void replaceVolumeEquations(const Eigen::MatrixXd& present) {
    using Column = Eigen::Map<Eigen::Matrix<Scalar, Eigen::Dynamic, 1>>;
    const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> weights = weights_.cast<Scalar>();
    parallelFor(static_cast<int>(blocks_.size()), threads_, [&](int b, int) {
      const ColumnBlock& block = blocks_[b];
      for (int j = 0; j < 3; ++j) {
        Column entries(column(block, j), system_.size);
        for (std::size_t s = 0; s < identities_.size(); ++s) {
          double wanted = 0;
          if (block.vertex >= 0) wanted = identities_[s].displacement(j, block.vertex);
          for (int node : block.nodes) wanted += identities_[s].traction(j, node);
          entries += Scalar(block.sign * wanted - present(s, 3 * b + j)) *
                     weights.col(s).head(system_.size);
        }
      }
    });
  }

  const BodySurface& body_;
  const CollocationScheme& scheme_;
  std::vector<ColumnBlock> blocks_;
  InfluencePanels panels_;
  std::vector<VolumeIdentity> identities_;
  Eigen::MatrixXd weights_;  ///< stride by #shells
  int threads_;
  ExchangedSystem<Scalar> system_;
};

}  // namespace

template <class Scalar>
ExchangedSystem<Scalar> assembleSystem(const BodySurface& body, const CollocationScheme& scheme,
                                       const SystemColumns& wanted, double tolerance, int threads,
                                       const Progress& progress) {
  return Assembler<Scalar>(body, scheme, wanted, tolerance, threads).run(progress);
}

template ExchangedSystem<double> assembleSystem(const BodySurface&, const CollocationScheme&,
                                                const SystemColumns&, double, int, const Progress&);
template ExchangedSystem<float> assembleSystem(const BodySurface&, const CollocationScheme&,
                                               const SystemColumns&, double, int, const Progress&);

}  // namespace palpate::bem
