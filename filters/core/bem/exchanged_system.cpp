// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bem/exchanged_system.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <memory>

#include "bem/betti_identities.h"
#include "bem/influence_panels.h"
#include "linear_algebra/dense_lu.h"
#include "linear_algebra/lapack.h"
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
  double factor;
};

std::vector<ColumnBlock> columnBlocks(const BodySurface& body, const CollocationScheme& scheme,
                                      const SystemColumns& wanted) {
  std::vector<ColumnBlock> blocks;
  for (int v = 0; v < body.vertexCount(); ++v)
    if (!body.fixed[v]) blocks.push_back({false, v, v, {}, 1});
  for (std::size_t i = 0; i < scheme.tractions.size(); ++i)
    blocks.push_back({false, scheme.tractions[i].column, -1, scheme.tractions[i].nodes,
                      -scheme.tractions[i].scale});
  int column = 0;
  for (int v : wanted.vertices) {
    if (body.fixed[v])
      blocks.push_back({true, column++, v, {}, -1});
    else
      blocks.push_back({true, column++, -1, body.nodes.ofVertex(v), 1});
  }
  for (int node : wanted.patchTractions) blocks.push_back({true, column++, -1, {node}, 1});
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
        panels_(body, scheme, tolerance),
        threads_(threads) {
    std::stable_sort(
        blocks_.begin(), blocks_.end(),
        [&](const ColumnBlock& a, const ColumnBlock& b) { return place(a) < place(b); });
    system_.size = 3 * scheme.equationCount();
    system_.stride = (system_.size + kLine<Scalar> - 1) / kLine<Scalar> * kLine<Scalar>;
    system_.columns = 3 * wanted.count();
    system_.matrix = AlignedBuffer<Scalar>(std::size_t(system_.stride) * system_.size);
    system_.right = AlignedBuffer<Scalar>(std::size_t(system_.stride) * system_.columns);
  }

  ExchangedSystem<Scalar> run(const Progress& progress) {
    std::vector<std::unique_ptr<InfluencePanels::Workspace>> work(threads_);
    std::vector<double> rotation(threads_, 0);
    parallelFor(
        panels_.panelCount(), threads_,
        [&](int panel, int thread) {
          if (!work[thread]) work[thread] = std::make_unique<InfluencePanels::Workspace>(panels_);
          panels_.compute(panel, *work[thread]);
          store(panel, *work[thread]);
          rotation[thread] =
              std::max(rotation[thread], panels_.rotationResidual(panel, *work[thread]));
        },
        [&](int begun) { progress.report(double(begun) / panels_.panelCount(), "assemble"); });
    const double size = body_.points.colwise().norm().maxCoeff();
    system_.rotationDefect = *std::max_element(rotation.begin(), rotation.end()) / size;
    replaceByIdentities();
    pairRows();
    return std::move(system_);
  }

 private:
  /// Gives each block of unknowns an equation of its vertex, in order where there are several.
  void pairRows() {
    std::vector<std::vector<int>> unknowns(body_.vertexCount());
    for (int v = 0; v < body_.vertexCount(); ++v) unknowns[v] = {v};
    for (const TractionUnknown& unknown : scheme_.tractions)
      if (unknown.column != unknown.vertex) unknowns[unknown.vertex].push_back(unknown.column);
    std::vector<std::size_t> used(body_.vertexCount(), 0);
    system_.diagonalRows.resize(system_.size);
    for (int e = 0; e < scheme_.equationCount(); ++e) {
      const int v = scheme_.equations[e].vertex, block = unknowns[v][used[v]++];
      const int panel = e / kLanes, lanes = panels_.laneCount(panel);
      for (int i = 0; i < 3; ++i)
        system_.diagonalRows[3 * block + i] =
            static_cast<int>(firstRow(panel)) + i * lanes + e % kLanes;
    }
  }

  /// Where a block's values stand in the panels' memory, which is read in that order.
  int place(const ColumnBlock& block) const {
    return panels_.placeOf(block.vertex >= 0 ? block.vertex
                                             : body_.nodes.vertex[block.nodes.front()]);
  }

  Scalar* column(const ColumnBlock& block, int component) const {
    const AlignedBuffer<Scalar>& target = block.isRight ? system_.right : system_.matrix;
    return target.data() + (3 * std::size_t(block.block) + component) * system_.stride;
  }

  /// First row of a panel; its rows follow as all x equations, all y, all z.
  static std::size_t firstRow(int panel) { return std::size_t(3 * kLanes) * panel; }

  /// Writes a panel's rows of every column.
  void store(int panel, const InfluencePanels::Workspace& work) const {
    const int lanes = panels_.laneCount(panel);
    for (const ColumnBlock& block : blocks_)
      for (int j = 0; j < 3; ++j) {
        alignas(64) double entries[3 * kLanes];
        gather(block, j, work, entries);
        Scalar* target = column(block, j) + firstRow(panel);
        if (lanes == kLanes)
          streamStore(entries, 3 * kLanes, target);
        else
          for (int i = 0; i < 3; ++i) std::copy_n(entries + i * kLanes, lanes, target + i * lanes);
      }
    finishStreaming();
  }

  static void gather(const ColumnBlock& block, int j, const InfluencePanels::Workspace& work,
                     double* entries) {
    for (int i = 0; i < 3; ++i) {
      const double* source =
          block.vertex >= 0 ? work.h(block.vertex, i, j) : work.g(block.nodes.front(), i, j);
      double* target = entries + i * kLanes;
      for (int lane = 0; lane < kLanes; ++lane) target[lane] = block.factor * source[lane];
      for (std::size_t k = 1; k < block.nodes.size(); ++k) {
        const double* more = work.g(block.nodes[k], i, j);
        for (int lane = 0; lane < kLanes; ++lane) target[lane] += block.factor * more[lane];
      }
    }
  }

  /// Replaces the combinations of equations along the identities' weights by the identities:
  /// columns += weights (identity - weights^T columns).
  void replaceByIdentities() {
    const std::vector<BettiIdentity> identities = bettiIdentities(body_, scheme_);
    const int count = static_cast<int>(identities.size());
    const Matrix weights = rowWeights(identities);
    Matrix matrixRows(count, system_.size), rightRows(count, system_.columns);
    for (const ColumnBlock& block : blocks_)
      for (int s = 0; s < count; ++s)
        for (int j = 0; j < 3; ++j) {
          double sum = block.vertex >= 0 ? identities[s].displacement(j, block.vertex) : 0;
          for (int node : block.nodes) sum += identities[s].traction(j, node);
          Matrix& rows = block.isRight ? rightRows : matrixRows;
          rows(s, 3 * block.block + j) = static_cast<Scalar>(block.factor * sum);
        }
    replaceColumns(weights, system_.matrix.data(), matrixRows);
    replaceColumns(weights, system_.right.data(), rightRows);
  }

  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  /// size by #identities, in the order of the rows as stored.
  Matrix rowWeights(const std::vector<BettiIdentity>& identities) const {
    Matrix weights(system_.size, identities.size());
    for (std::size_t s = 0; s < identities.size(); ++s)
      for (int e = 0; e < scheme_.equationCount(); ++e) {
        const int panel = e / kLanes, lanes = panels_.laneCount(panel);
        for (int i = 0; i < 3; ++i)
          weights(firstRow(panel) + i * lanes + e % kLanes, s) =
              static_cast<Scalar>(identities[s].weights(e, i));
      }
    return weights;
  }

  /// @param rows  #identities by #columns, overwritten.
  void replaceColumns(const Matrix& weights, Scalar* columns, Matrix& rows) const {
    constexpr int chunk = 12;  // columns that stay in cache between the two products
    const BlasThreads one(1);
    const int size = system_.size, stride = system_.stride;
    const int total = static_cast<int>(rows.cols()), count = static_cast<int>(rows.rows());
    parallelFor((total + chunk - 1) / chunk, threads_, [&](int c, int) {
      const int first = c * chunk, width = std::min(chunk, total - first);
      Scalar* target = columns + std::size_t(first) * stride;
      Scalar* difference = rows.data() + std::size_t(first) * count;
      lapack::gemm(true, count, width, size, Scalar(-1), weights.data(), size, target, stride,
                   Scalar(1), difference, count);
      lapack::gemm(false, size, width, count, Scalar(1), weights.data(), size, difference, count,
                   Scalar(1), target, stride);
    });
  }

  const BodySurface& body_;
  const CollocationScheme& scheme_;
  std::vector<ColumnBlock> blocks_;
  InfluencePanels panels_;
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
