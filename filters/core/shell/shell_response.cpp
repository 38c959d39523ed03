// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shell/shell_response.h"

#include <algorithm>
#include <utility>

#include "model/support.h"

namespace palpate::shell {
namespace {

constexpr Eigen::Index kColumnsAtOnce = 96;

class Response {
 public:
  Response(ShellSystem system, const ElasticModel& model)
      : system_(std::move(system)),
        model_(model),
        factored_(std::move(system_.entries), 0, true),
        freeCount_(static_cast<int>(system_.heldFree.cols())) {}

  std::size_t peakBytes() const {
    return factored_.peakBytes() + sizeof(double) * std::size_t(freeCount_) * kColumnsAtOnce;
  }

  /// Columns of three components each, from the first-th node on.
  void solve(const std::vector<int>& nodes, Eigen::Index first, Eigen::Index count,
             Eigen::Ref<Eigen::MatrixXd> out) const {
    std::vector<int> forces;  // places of the unit ones, -1 for none
    Eigen::MatrixXd held = Eigen::MatrixXd::Zero(system_.heldCount(), 3 * count);
    for (Eigen::Index i = 0; i < count; ++i)
      for (int k = 0; k < 3; ++k) {
        const int place = system_.place(k, nodes[first + i]);
        forces.push_back(std::max(place, -1));
        if (place < 0 && model_.conditions().isFixed(nodes[first + i]))
          held(-1 - place, 3 * i + k) = 1;
      }
    Eigen::MatrixXd free(freeCount_, 3 * count);
    factored_.solveUnits(forces, free);
    if (!held.isZero(0)) {
      Eigen::MatrixXd moved = -(system_.heldFree.transpose() * held);
      factored_.solve(moved);
      free += moved;
    }
    Eigen::MatrixXd reactions = system_.heldFree * free;
    if (!held.isZero(0)) reactions += system_.heldHeld * held;
    spread(free, reactions, out);
  }

  Eigen::MatrixXd ofWeight() const {
    Eigen::MatrixXd free = Eigen::MatrixXd::Zero(freeCount_, 3);
    Eigen::MatrixXd carried = Eigen::MatrixXd::Zero(system_.heldCount(), 3);
    const int count = model_.mesh().vertexCount();
    for (int v = 0; v < count; ++v)
      for (int k = 0; k < 3; ++k) {
        const int place = system_.place(k, v);
        (place >= 0 ? free(place, k) : carried(-1 - place, k)) = system_.volumes[v];
      }
    factored_.solve(free);
    Eigen::MatrixXd out(3 * count, 3);
    spread(free, system_.heldFree * free - carried, out);
    return out;
  }

  double rigidMotionDefect() const {
    const Eigen::MatrixXd all = motionsOfAll();
    Eigen::MatrixXd held(system_.heldCount(), 6), free(freeCount_, 6);
    for (Eigen::Index i = 0; i < all.rows(); ++i) {
      const int place = system_.place(i % 6, i / 6);
      if (place >= 0)
        free.row(place) = all.row(i);
      else
        held.row(-1 - place) = all.row(i);
    }
    Eigen::MatrixXd found = -(system_.heldFree.transpose() * held);
    factored_.solve(found);
    double largest = 0;
    for (Eigen::Index i = 0; i < all.rows(); ++i)
      if (const int place = system_.place(i % 6, i / 6); place >= 0 && i % 6 < 3)
        largest = std::max(largest, (found.row(place) - free.row(place)).cwiseAbs().maxCoeff());
    return largest;
  }

 private:
  /// To vertices: displacements of what is free, reactions of fixed vertices.
  void spread(const Eigen::MatrixXd& free, const Eigen::MatrixXd& reactions,
              Eigen::Ref<Eigen::MatrixXd> out) const {
    for (Eigen::Index c = 0; c < out.cols(); ++c)
      for (int v = 0; v < model_.mesh().vertexCount(); ++v)
        for (int k = 0; k < 3; ++k) {
          const int place = system_.place(k, v);
          out(3 * v + k, c) = place >= 0                       ? free(place, c)
                              : model_.conditions().isFixed(v) ? reactions(-1 - place, c)
                                                               : 0;
        }
  }

  /// 6 #V by 6: displacements and rotations, about the middle of the mesh.
  Eigen::MatrixXd motionsOfAll() const {
    const Eigen::Matrix3Xd& points = model_.mesh().points();
    const Eigen::MatrixXd moved = rigidMotions(points, points.rowwise().mean(), system_.length);
    Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(6 * points.cols(), 6);
    for (Eigen::Index v = 0; v < points.cols(); ++v) {
      motions.middleRows<3>(6 * v) = moved.middleRows<3>(3 * v);
      motions.block<3, 3>(6 * v + 3, 3).setIdentity();
    }
    return motions;
  }

  ShellSystem system_;
  const ElasticModel& model_;
  SparseFactorization factored_;
  int freeCount_;
};

}  // namespace

ShellResponse shellResponse(ShellSystem system, const ElasticModel& model,
                            const std::vector<int>& nodes, Eigen::Ref<Eigen::MatrixXd> out,
                            const Progress& progress) {
  progress.report(0, "factor");
  const Response response(std::move(system), model);
  ShellResponse result;
  result.peakBytes = response.peakBytes();
  result.rigidMotionDefect = response.rigidMotionDefect();
  result.ofWeight = response.ofWeight();
  const auto all = static_cast<Eigen::Index>(nodes.size());
  for (Eigen::Index first = 0; first < all; first += kColumnsAtOnce / 3) {
    progress.report(0.2 + 0.8 * double(first) / all, "solve");
    const Eigen::Index count = std::min(kColumnsAtOnce / 3, all - first);
    response.solve(nodes, first, count, out.middleCols(3 * first, 3 * count));
  }
  return result;
}

}  // namespace palpate::shell
